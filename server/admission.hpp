// Bounds the work of the service: so many jobs run, so many wait, the next is refused.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <stdexcept>

namespace viaface {

class ServiceFull : public std::runtime_error {
  public:
    ServiceFull() : std::runtime_error("as many jobs run and wait as the service allows") {}
};

// Thread-safe; outlives its places.
class Admission {
  public:
    Admission(int running, int waiting) : most_running_(running), most_waiting_(waiting) {}

    // A job's place in the queue, then its leave to run; given back by its destruction, in any thread.
    class Place {
      public:
        explicit Place(Admission& admission, std::uint64_t ticket) : admission_(admission), ticket_(ticket) {}
        ~Place() { admission_.leave(*this); }
        Place(const Place&) = delete;
        Place& operator=(const Place&) = delete;

        // Blocks until it may run, first come first served. `still_wanted` is asked every tenth of a second;
        // false when it says no.
        bool wait_for_turn(const std::function<bool()>& still_wanted) {
            return admission_.wait(*this, still_wanted);
        }

      private:
        friend class Admission;
        Admission& admission_;
        const std::uint64_t ticket_;
        bool running_ = false;
    };

    std::unique_ptr<Place> reserve();  // ServiceFull when the queue is full

    int running() const;
    int waiting() const;

  private:
    bool wait(Place& place, const std::function<bool()>& still_wanted);
    void leave(const Place& place);

    const int most_running_, most_waiting_;
    mutable std::mutex mutex_;
    std::condition_variable turn_;
    int running_ = 0;
    std::deque<std::uint64_t> queue_;  // tickets of those that wait
    std::uint64_t next_ticket_ = 0;
};

}  // namespace viaface

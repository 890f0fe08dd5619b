// A few threads that share numbered work; the caller is one of them. Who has nothing to do looks for work a
// little while before he sleeps, as one piece of work mostly follows upon another, and to be woken takes
// longer than most pieces.
#pragma once

#include <atomic>
#include <functional>
#include <thread>
#include <vector>

namespace viaface {

class WorkPool {
  public:
    using Work = std::function<void(int item, int thread)>;            // may not throw
    using Rows = std::function<void(int first, int end, int thread)>;  // may not throw

    explicit WorkPool(int threads);
    ~WorkPool();
    WorkPool(const WorkPool&) = delete;
    WorkPool& operator=(const WorkPool&) = delete;

    int threads() const { return static_cast<int>(workers_.size()) + 1; }
    // Does items 0 to `items` - 1, each once; returns when all are done.
    void share(int items, const Work& work);
    // Does rows 0 to `rows` - 1, each once, kRowsAtOnce at a time.
    void share_rows(int rows, const Rows& work);
    static constexpr int kRowsAtOnce = 512;
    static int pieces(int rows) { return (rows + kRowsAtOnce - 1) / kRowsAtOnce; }

  private:
    void serve(int thread);
    void take_items(int thread);

    // Written by the caller while nothing is left to take, read by who has taken an item.
    const Work* work_ = nullptr;
    int items_ = 0;

    std::atomic<int> left_ = 0;        // items that nobody has taken
    std::atomic<int> unfinished_ = 0;  // items
    std::atomic<unsigned> calls_ = 0;
    std::atomic<bool> over_ = false;
    std::vector<std::thread> workers_;
};

}  // namespace viaface

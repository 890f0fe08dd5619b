#include "server/admission.hpp"

#include <chrono>

namespace viaface {

std::unique_ptr<Admission::Place> Admission::reserve() {
    const std::lock_guard lock(mutex_);
    if (running_ + static_cast<int>(queue_.size()) >= most_running_ + most_waiting_) throw ServiceFull();
    queue_.push_back(next_ticket_);
    return std::make_unique<Place>(*this, next_ticket_++);
}

bool Admission::wait(Place& place, const std::function<bool()>& still_wanted) {
    std::unique_lock lock(mutex_);
    const auto my_turn = [&] { return running_ < most_running_ && queue_.front() == place.ticket_; };
    while (!turn_.wait_for(lock, std::chrono::milliseconds(100), my_turn)) {
        lock.unlock();
        const bool wanted = still_wanted();
        lock.lock();
        if (!wanted) return false;
    }
    queue_.pop_front();
    ++running_;
    place.running_ = true;
    turn_.notify_all();
    return true;
}

void Admission::leave(const Place& place) {
    const std::lock_guard lock(mutex_);
    if (place.running_) {
        --running_;
    } else {
        std::erase(queue_, place.ticket_);
    }
    turn_.notify_all();
}

int Admission::running() const {
    const std::lock_guard lock(mutex_);
    return running_;
}

int Admission::waiting() const {
    const std::lock_guard lock(mutex_);
    return static_cast<int>(queue_.size());
}

}  // namespace viaface

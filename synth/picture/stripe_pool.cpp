#include "synth/picture/stripe_pool.hpp"

namespace viaface {

StripePool::StripePool(int threads) {
    for (int thread = 1; thread < threads; ++thread) workers_.emplace_back([this, thread] { serve(thread); });
}

StripePool::~StripePool() {
    {
        const std::lock_guard lock(mutex_);
        over_ = true;
    }
    called_.notify_all();
    for (std::thread& worker : workers_) worker.join();
}

void StripePool::share(int items, const Work& work) {
    std::unique_lock lock(mutex_);
    work_ = &work;
    next_ = 0;
    items_ = unfinished_ = items;
    if (items > 1) called_.notify_all();
    take_items(lock, 0);
    done_.wait(lock, [&] { return unfinished_ == 0; });
}

void StripePool::serve(int thread) {
    std::unique_lock lock(mutex_);
    while (true) {
        called_.wait(lock, [&] { return over_ || next_ < items_; });
        if (over_) return;
        take_items(lock, thread);
    }
}

void StripePool::take_items(std::unique_lock<std::mutex>& lock, int thread) {
    while (next_ < items_) {
        const int item = next_++;
        lock.unlock();
        (*work_)(item, thread);
        lock.lock();
        if (--unfinished_ == 0) done_.notify_one();
    }
}

}  // namespace viaface

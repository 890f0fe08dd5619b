#include "synth/picture/work_pool.hpp"

#include <algorithm>

namespace viaface {
namespace {

constexpr int kRowsAtOnce = 512;
constexpr int kLooks = 100;  // before sleep, some tens of microseconds

template <class Ready>
void look_for(const Ready& ready) {
    for (int i = 0; i < kLooks && !ready(); ++i) std::this_thread::yield();
}

}  // namespace

WorkPool::WorkPool(int threads) {
    for (int thread = 1; thread < threads; ++thread) workers_.emplace_back([this, thread] { serve(thread); });
}

WorkPool::~WorkPool() {
    {
        const std::lock_guard lock(mutex_);
        over_ = true;
    }
    called_.notify_all();
    for (std::thread& worker : workers_) worker.join();
}

void WorkPool::share(int items, const Work& work) {
    std::unique_lock lock(mutex_);
    work_ = &work;
    next_ = 0;
    items_ = unfinished_ = items;
    if (items > 1) {
        ++calls_;
        called_.notify_all();
    }
    take_items(lock, 0);
    lock.unlock();
    look_for([&] { return unfinished_ == 0; });
    lock.lock();
    done_.wait(lock, [&] { return unfinished_ == 0; });
}

void WorkPool::share_rows(int rows, const Rows& work) {
    share((rows + kRowsAtOnce - 1) / kRowsAtOnce,
          [&](int item, int) { work(item * kRowsAtOnce, std::min(rows, (item + 1) * kRowsAtOnce)); });
}

void WorkPool::serve(int thread) {
    std::unique_lock lock(mutex_);
    while (true) {
        called_.wait(lock, [&] { return over_ || next_ < items_; });
        if (over_) return;
        take_items(lock, thread);
        const unsigned calls = calls_;
        lock.unlock();
        look_for([&] { return calls_ != calls; });
        lock.lock();
    }
}

void WorkPool::take_items(std::unique_lock<std::mutex>& lock, int thread) {
    while (next_ < items_) {
        const int item = next_++;
        lock.unlock();
        (*work_)(item, thread);
        lock.lock();
        if (--unfinished_ == 0) done_.notify_one();
    }
}

}  // namespace viaface

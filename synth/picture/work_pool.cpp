#include "synth/picture/work_pool.hpp"

#include <algorithm>

namespace viaface {
namespace {

constexpr int kLooks = 500;  // before sleep, a few tenths of a millisecond

// Returns when the number is another.
template <class Number>
void wait_for_another(const std::atomic<Number>& number, Number old) {
    for (int i = 0; i < kLooks; ++i) {
        if (number.load(std::memory_order_acquire) != old) return;
        std::this_thread::yield();
    }
    number.wait(old, std::memory_order_acquire);
}

}  // namespace

WorkPool::WorkPool(int threads) {
    for (int thread = 1; thread < threads; ++thread) workers_.emplace_back([this, thread] { serve(thread); });
}

WorkPool::~WorkPool() {
    over_ = true;
    ++calls_;
    calls_.notify_all();
    for (std::thread& worker : workers_) worker.join();
}

void WorkPool::share(int items, const Work& work) {
    work_ = &work;
    items_ = items;
    unfinished_ = items;
    left_.store(items, std::memory_order_release);
    if (items > 1) {
        ++calls_;
        calls_.notify_all();
    }
    take_items(0);
    for (int left = unfinished_; left > 0; left = unfinished_) wait_for_another(unfinished_, left);
}

void WorkPool::share_rows(int rows, const Rows& work) {
    share(pieces(rows), [&](int item, int thread) {
        work(item * kRowsAtOnce, std::min(rows, (item + 1) * kRowsAtOnce), thread);
    });
}

void WorkPool::serve(int thread) {
    for (unsigned calls = 0; !over_; calls = calls_) {
        take_items(thread);
        wait_for_another(calls_, calls);
    }
}

void WorkPool::take_items(int thread) {
    for (int left = left_.load(std::memory_order_acquire); left > 0;) {
        if (!left_.compare_exchange_weak(left, left - 1, std::memory_order_acq_rel)) continue;
        (*work_)(items_ - left, thread);
        if (--unfinished_ == 0) unfinished_.notify_one();
        left = left_.load(std::memory_order_acquire);
    }
}

}  // namespace viaface

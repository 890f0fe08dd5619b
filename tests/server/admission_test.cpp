#include "server/admission.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

namespace viaface {
namespace {

const auto kWanted = [] { return true; };

TEST(Admission, RefusesOnceRunningAndWaitingAreFull) {
    Admission admission(1, 1);
    auto first = admission.reserve();
    EXPECT_TRUE(first->wait_for_turn(kWanted));
    auto second = admission.reserve();
    EXPECT_EQ(admission.running(), 1);
    EXPECT_EQ(admission.waiting(), 1);
    EXPECT_THROW(admission.reserve(), ServiceFull);
    first.reset();
    EXPECT_TRUE(second->wait_for_turn(kWanted));
    EXPECT_NO_THROW(admission.reserve());
}

TEST(Admission, NeverRunsMoreThanAllowedAndServesAll) {
    Admission admission(2, 64);
    std::atomic<int> inside = 0, most = 0, served = 0;
    std::vector<std::thread> jobs;
    for (int i = 0; i < 16; ++i) {
        jobs.emplace_back([&] {
            const auto place = admission.reserve();
            place->wait_for_turn(kWanted);
            const int now = ++inside;
            for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) {
            }
            std::this_thread::yield();
            --inside;
            ++served;
        });
    }
    for (auto& job : jobs) job.join();
    EXPECT_EQ(served, 16);
    EXPECT_LE(most, 2);
    EXPECT_EQ(admission.running(), 0);
    EXPECT_EQ(admission.waiting(), 0);
}

TEST(Admission, WhoNoLongerWantsLeavesTheQueueToOthers) {
    Admission admission(1, 4);
    auto first = admission.reserve();
    ASSERT_TRUE(first->wait_for_turn(kWanted));
    auto second = admission.reserve();
    EXPECT_FALSE(second->wait_for_turn([] { return false; }));
    second.reset();
    EXPECT_EQ(admission.waiting(), 0);
    auto third = admission.reserve();
    first.reset();
    EXPECT_TRUE(third->wait_for_turn(kWanted));
}

}  // namespace
}  // namespace viaface

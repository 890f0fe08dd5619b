#include <gtest/gtest.h>

#include <atomic>

#include "simple_faces.hpp"
#include "synth/picture/portrait.hpp"
#include "synth/picture/work_pool.hpp"

namespace viaface {
namespace {

TEST(Raster, AnyNumberOfThreadsGivesTheSameBytes) {
    const Face face = testing::painted_balls();
    for (const View& view : {View{.width = 201, .height = 150, .yaw = 20},
                             View{.width = 96, .height = 260, .tilt = 15, .background = Rgb{0, 177, 64}},
                             View{.width = 333, .height = 333, .roll = 30}}) {
        const auto drawn = [&](int threads) {
            return testing::bytes(
                Portrait(face, view, {.threads = threads}).draw(testing::wandering(face, 1)));
        };
        const auto alone = drawn(1);
        for (const int threads : {2, 4}) EXPECT_EQ(drawn(threads), alone);
    }
}

TEST(WorkPool, DoesEveryItemOnce) {
    for (const int threads : {1, 2, 5}) {
        WorkPool pool(threads);
        for (const int items : {0, 1, 3, 100}) {
            std::vector<std::atomic<int>> done(items);
            pool.share(items, [&](int item, int) { ++done[item]; });
            for (const auto& times : done) EXPECT_EQ(times, 1);
        }
    }
}

}  // namespace
}  // namespace viaface

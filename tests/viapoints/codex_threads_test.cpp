#include <gtest/gtest.h>

#include <thread>

#include "tests/viapoints/recited.hpp"
#include "viapoints/codex_speak.hpp"

namespace viaface {
namespace {

using namespace recited;

TEST(CodexSpeak, ThreadsSayTheSame) {
    const Codex codex = codex_of(20);
    const PhoneSequence phones = random_sentence(1001, 40);
    std::vector<ViaPointTrack> tracks(8);
    std::vector<std::thread> threads;
    for (ViaPointTrack& track : tracks) {
        threads.emplace_back([&] { track = speak(codex, phones, select_units(codex, phones)); });
    }
    for (std::thread& thread : threads) thread.join();
    for (const ViaPointTrack& track : tracks) {
        EXPECT_EQ(track.time_s, tracks[0].time_s);
        EXPECT_EQ(track.points, tracks[0].points);
    }
}

}  // namespace
}  // namespace viaface

#include <gtest/gtest.h>

#include <thread>

#include "synth/speech/flite_voice.hpp"
#include "tests/synth/speech/said.hpp"

namespace viaface {
namespace {

using test::kSentences;
using test::same;

TEST(FliteVoice, FourThreadsGiveTheBytesOfOne) {
    const auto names = FliteVoice::names();
    std::vector<Utterance> alone;
    for (const std::string& name : names) {
        for (const char* sentence : kSentences) alone.push_back(FliteVoice(name).speak(sentence));
    }
    std::vector<int> different(4, 0);
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < different.size(); ++t) {
        threads.emplace_back([&, t] {
            for (std::size_t k = 0; k < 2 * alone.size(); ++k) {
                const std::size_t i = (k + 3 * t) % alone.size();
                different[t] += !same(FliteVoice(names[i / 3]).speak(kSentences[i % 3]), alone[i]);
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(different, std::vector<int>(4, 0));
}

}  // namespace
}  // namespace viaface

// A sentence's frames, blinks among them, drawn where they changed and drawn whole: the same bytes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "synth/picture/portrait.hpp"
#include "synth/say/recital.hpp"
#include "synth/talker/talker.hpp"

namespace viaface {
namespace {

bool same(const FrameView& a, const FrameView& b) {
    for (int row = 0; row < a.height; ++row) {
        const std::uint8_t *one = a.top_row + row * a.stride, *other = b.top_row + row * b.stride;
        if (!std::equal(one, one + 4 * a.width, other)) return false;
    }
    return true;
}

TEST(Redraw, WhatMovedAloneEqualsTheWholeOverASentence) {
    const Talker talker = load_talker(std::filesystem::path(VIAFACE_SOURCE_DIR) / "talkers/momo");
    SpeechRequest request;
    request.text = "Five old men walked down to the river.";
    const Recital recital = recite(talker.codex, Script(request).utterance(0));
    const View view{.width = 200, .height = 200, .yaw = 15};
    Portrait moved(talker.face, view), whole(talker.face, view);
    for (int n = 0; n < 75; ++n) {
        const double shut = std::max(0.0, 1 - std::abs(n % 25 - 12) / 4.0);
        const Nodes posed = talker.poser.posed(recital.motion.at(n / 30.0), {shut, shut});
        ASSERT_TRUE(same(moved.draw(posed), whole.draw(posed, Portrait::Redraw::kAll))) << n;
    }
}

}  // namespace
}  // namespace viaface

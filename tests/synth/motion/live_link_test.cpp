#include "synth/motion/live_link.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"

namespace viaface {
namespace {

const std::string kHeader = "Timecode,BlendShapeCount,JawOpen,MouthClose,HeadYaw\n";

std::string field_of(const std::string& text) {
    try {
        parse_live_link(text, "take");
    } catch (const InputError& error) {
        return error.field();
    }
    return "accepted";
}

TEST(LiveLink, ReadsShapesAndKeepsTurnsApart) {
    const BlendRecording take = parse_live_link(kHeader +
                                                "09:00:00:10.5,3,0.25,0.125,-0.5\r\n"
                                                "09:00:00:12.5,3,0.5,,0\n");
    EXPECT_EQ(take.names, (std::vector<std::string>{"JawOpen", "MouthClose"}));
    EXPECT_EQ(take.weights(0, 1), 0.125);
    EXPECT_TRUE(std::isnan(take.weights(1, 1)));
    ASSERT_EQ(take.extra.size(), 1u);
    EXPECT_EQ(take.extra[0].name, "HeadYaw");
    EXPECT_EQ(take.extra[0].values, (std::vector<double>{-0.5, 0}));
    EXPECT_NEAR(take.time_s[1], 2.0 / 60, 1e-9);  // of day-long times
}

// The same second and a bit, counted at several rates: the time code alone tells which.
TEST(LiveLink, FindsTheRateOfTheTimeCode) {
    for (const int rate : {24, 25, 30, 50, 60, 120}) {
        std::string text = kHeader;
        for (int n = 0; n < 2 * rate; ++n) {
            const int frame = n + rate / 2;
            text += "10:59:" + std::to_string(58 + frame / rate) + ":" + std::to_string(frame % rate) +
                    ".25,3,0,0,0\n";
            if (58 + (frame + 1) / rate == 60) break;
        }
        const BlendRecording take = parse_live_link(text);
        for (std::size_t i = 0; i < take.time_s.size(); ++i)
            EXPECT_NEAR(take.time_s[i], static_cast<double>(i) / rate, 1e-9) << rate;
    }
}

TEST(LiveLink, GoesOnPastMidnight) {
    const BlendRecording take =
        parse_live_link(kHeader + "23:59:59:58.0,3,0,0,0\n00:00:00:00.0,3,0,0,0\n00:00:00:02.0,3,0,0,0\n");
    EXPECT_NEAR(take.time_s[1], 2.0 / 60, 1e-9);
    EXPECT_NEAR(take.time_s[2], 4.0 / 60, 1e-9);
}

TEST(LiveLink, ARowWithoutAFaceIsMissing) {
    const BlendRecording take =
        parse_live_link(kHeader + "10:00:00:00,3,0,0,0\n10:00:00:02,0\n10:00:00:04,0,,,\n");
    EXPECT_TRUE(take.weights.row(1).array().isNaN().all());
    EXPECT_TRUE(take.weights.row(2).array().isNaN().all());
    EXPECT_TRUE(std::isnan(take.extra[0].values[1]));
}

TEST(LiveLink, NamesThePlaceOfWhatIsWrong) {
    const std::string first = "10:00:00:00,3,0,0,0\n";
    EXPECT_EQ(field_of(""), "take line 0");
    EXPECT_EQ(field_of(kHeader), "take line 1");
    EXPECT_EQ(field_of("Timecode,Count,JawOpen\n"), "take line 1");
    EXPECT_EQ(field_of("Timecode,BlendShapeCount,JawOpen,JawOpen\n"), "take line 1, column JawOpen");
    EXPECT_EQ(field_of(kHeader + first + "10:00:61:00,3,0,0,0\n"), "take line 3, column Timecode");
    EXPECT_EQ(field_of(kHeader + first + "10:00:00;04,3,0,0,0\n"), "take line 3, column Timecode");
    EXPECT_EQ(field_of(kHeader + first + "10:00:00:00,3,0,0,0\n"), "take line 3, column Timecode");
    EXPECT_EQ(field_of(kHeader + first + "09:59:59:00,3,0,0,0\n"), "take line 3, column Timecode");
    EXPECT_EQ(field_of(kHeader + first + "10:00:00:04,2,0,0,0\n"), "take line 3, column BlendShapeCount");
    EXPECT_EQ(field_of(kHeader + first + "10:00:00:04,3,0,0\n"), "take line 3");
    EXPECT_EQ(field_of(kHeader + first + "10:00:00:04,3,0,inf,0\n"), "take line 3, column MouthClose");
    EXPECT_EQ(field_of(kHeader + first + "10:00:00:04,3,0,0,11\n"), "take line 3, column HeadYaw");
}

}  // namespace
}  // namespace viaface

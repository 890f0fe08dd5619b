#include <gtest/gtest.h>

#include <sstream>

#include "base/error.hpp"
#include "synth/render/live_via.hpp"
#include "tests/synth/render/reel.hpp"
#include "tests/synth/render/spoken_motion.hpp"
#include "viapoints/motion_at.hpp"
#include "viapoints/motion_csv.hpp"

namespace viaface {
namespace {

RenderRequest small() {
    RenderRequest request;
    request.view.width = request.view.height = 64;
    request.fps = {25, 1};
    return request;
}

TEST(Live, DrawsWhatAFileOfTheSameRowsDraws) {
    const Motion motion = opening_motion(40, 0.5);
    std::vector<Configuration> from_file, live;
    Reel reel, live_reel;
    render(small(), {.motion = motion, .head = {}, .report = {}}, {}, momo(), reel,
           [&](const DrawnFrame& frame) { from_file.push_back(frame.commanded); });
    std::istringstream in(format_motion_csv(motion));
    LiveCsv rows(in);
    render_live(
        small(), [&] { return rows.next(); }, momo(), live_reel,
        [&](const DrawnFrame& frame) { live.push_back(frame.commanded); });
    ASSERT_GE(live.size(), from_file.size());
    for (std::size_t n = 0; n < from_file.size(); ++n) EXPECT_LT((live[n] - from_file[n]).norm(), 1e-9) << n;
    EXPECT_TRUE(live_reel.finished);
    EXPECT_LE(live_reel.sound.size(), live.size() * 48000 / 25);
}

TEST(Live, DrawsAStreamAsItsFile) {
    const Motion motion = opening_motion(50, 1);
    const Bytes bytes = encode_stream(motion, nullptr, {.max_error_mm = 0.5, .sync_s = 0.4}).bytes;
    std::istringstream in(std::string(bytes.begin(), bytes.end()));
    ASSERT_TRUE(begins_via(in));
    LiveVia rows(in, {});
    Reel reel;
    std::vector<Configuration> drawn;
    render_live(
        small(), [&] { return rows.next(); }, momo(), reel,
        [&](const DrawnFrame& frame) { drawn.push_back(frame.commanded); });
    EXPECT_EQ(rows.describe_damage(), "");
    ASSERT_GE(drawn.size(), 25u);
    for (std::size_t n = 0; n < 25; ++n) {
        const Configuration off = drawn[n] - motion_at(motion, static_cast<double>(n) / 25);
        for (int p = 0; p < kPoints; ++p) EXPECT_LT(point_of(off, p).norm(), 0.55) << n;
    }
    std::istringstream rubbish(std::string("\x89VIA, and then something else that is none at all"));
    LiveVia none(rubbish, {});
    EXPECT_THROW(none.next(), InputError);
}

TEST(Live, AFrameWaitsForTheRowBehindTheOneAfterIt) {
    const Motion motion = opening_motion(50, 1);
    std::size_t row = 0;
    Reel reel;
    render_live(
        small(),
        [&]() -> std::optional<LiveRow> {
            if (row == motion.size()) return std::nullopt;
            // Rows 0 to row - 1 have come, which settles the time of row - 2.
            const double settled = (static_cast<double>(row) - 2) / 50;
            EXPECT_EQ(reel.frames.size(),
                      settled < 0 ? 0 : static_cast<std::size_t>(settled * 25 + 1e-9) + 1);
            const LiveRow now{motion.time_s[row], motion.at(row)};
            ++row;
            return now;
        },
        momo(), reel);
    EXPECT_GE(reel.frames.size(), 25u);
}

TEST(Live, NamesTheRowOfWhatIsWrong) {
    const auto field_of = [](const std::string& text) -> std::string {
        std::istringstream in(text);
        LiveCsv rows(in);
        try {
            while (rows.next()) {
            }
        } catch (const InputError& error) {
            return error.field();
        }
        return "accepted";
    };
    const std::string header = "# momo\ntime_s,chin_x_mm,chin_y_mm,chin_z_mm\n";
    EXPECT_EQ(field_of(header + "0,1,2,3\n0.1,1,2,3\n"), "accepted");
    EXPECT_EQ(field_of(header + "0,1,2,3\n0,1,2,3\n"), "motion row 2");
    EXPECT_EQ(field_of(header + "0,1,2,3\n0.1,1,2\n"), "motion row 2 line 2");
    EXPECT_EQ(field_of("t,chin_x_mm,chin_y_mm,chin_z_mm\n0,1,2,3\n"), "motion row 1");
    Reel reel;
    EXPECT_THROW(render_live(
                     small(), [] { return std::nullopt; }, momo(), reel),
                 InputError);
}

}  // namespace
}  // namespace viaface

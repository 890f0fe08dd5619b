#include "synth/track/film_track.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "hand_marks.hpp"
#include "synth/film/film_writer.hpp"
#include "synth/lips/learned_lips.hpp"
#include "synth/track/overlay.hpp"
#include "synth/track/small_picture.hpp"
#include "viapoints/point_csv.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;

const LipModel& recited() {
    static const LipModel model = learn_from(
        recited_lip_frames(load_talker(fs::path(VIAFACE_TALKERS_FOLDER) / "momo")), {.modes = 10}, {});
    return model;
}

fs::path clips() { return fs::path(VIAFACE_SOURCE_DIR) / "../shared/data/grid_s1/video"; }

const ExtraColumn& column(const Motion& motion, const std::string& name) {
    return *std::ranges::find(motion.extra, name, &ExtraColumn::name);
}

std::string refused(const TrackRequest& request) {
    try {
        track_film(recited(), request);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

fs::path plain_film(const std::string& name, std::uint8_t shade, int frames) {
    const fs::path path = fs::path(testing::TempDir()) / name;
    const auto film = open_film({64, 48, {25, 1}, FilmFormat::kMkv, 16000}, path);
    for (int i = 0; i < frames; ++i)
        film->add_frame(view(Frame{64, 48, std::vector<std::uint8_t>(4 * 64 * 48, shade)}));
    film->finish();
    return path;
}

// In every word with p, b or m the lips close to 15% of the widest.
void expect_closures(const fs::path& clip, const Motion& motion) {
    const auto& opening = column(motion, "opening_mm").values;
    EXPECT_GT(std::ranges::max(opening), 5);  // mm
    for (const auto& word : test::bilabials(fs::path(clip).replace_extension(".align"))) {
        const double least = *std::min_element(opening.begin() + word.first, opening.begin() + word.last);
        EXPECT_LT(least, 0.15 * std::ranges::max(opening)) << word.word;
    }
}

TEST(FilmTrack, LiesByTheMarksMadeByHand) {
    const fs::path clip = clips() / "sbwo2p.mpg";
    if (!fs::exists(clip)) GTEST_SKIP() << clip << " is not there";
    const auto marks = test::read_marks(fs::path(VIAFACE_SOURCE_DIR) / "tests/synth/track/grid_s1_marks.csv");
    std::vector<double> errors;
    int frame = 0;
    const FilmTrack track =
        track_film(recited(), {.video = clip}, [&](const TimedFrame&, const TrackedLips& lips) {
            const auto here = marks.at("sbwo2p").find(frame++);
            if (here == marks.at("sbwo2p").end()) return;
            ASSERT_TRUE(lips.found);
            for (const test::Mark& mark : here->second)
                errors.push_back(test::contour_error(mark, lips.pixels));
        });
    EXPECT_EQ(errors.size(), 45u);
    EXPECT_LT(test::median(errors), 2);  // px
    EXPECT_EQ(track.lost, 0);
    ASSERT_EQ(track.motion.size(), 75u);
    EXPECT_NEAR(track.motion.time_s[50], 2, 1e-9);
    EXPECT_EQ(track.comments.front(), kAnotherPerson);
    EXPECT_NE(track.comments[1].find("63 mm"), std::string::npos);
    for (const char* name : {"mode_1", "opening_mm", "width_mm", "protrusion_inferred_mm", "confidence"}) {
        for (const double value : column(track.motion, name).values)
            ASSERT_TRUE(std::isfinite(value)) << name;
    }
    expect_closures(clip, track.motion);
}

TEST(FilmTrack, SeesLipsShutWhoseSeamHasTheOpeningsColour) {
    const fs::path clip = clips() / "sgbp7a.mpg";
    if (!fs::exists(clip)) GTEST_SKIP() << clip << " is not there";
    expect_closures(clip, track_film(recited(), {.video = clip}).motion);
}

TEST(FilmTrack, RefusesFilmsWithoutAFace) {
    EXPECT_NE(refused({.video = plain_film("black.mkv", 0, 12)}).find("no face in its first 12 frames"),
              std::string::npos);
    EXPECT_NE(refused({.video = plain_film("one.mkv", 128, 1)}).find("no face in its first 1 frames"),
              std::string::npos);
    const fs::path nothing = fs::path(testing::TempDir()) / "nothing.mpg";
    write_whole(nothing, std::string("no film"));
    EXPECT_THROW(track_film(recited(), {.video = nothing}), InputError);
}

// The first 12 frames of a clip, each changed.
fs::path remade(const fs::path& clip, const std::string& name,
                const std::function<Frame(const Frame&)>& changed) {
    const fs::path path = fs::path(testing::TempDir()) / name;
    std::unique_ptr<FilmWriter> film;
    FrameReader reader(clip);
    for (int n = 0; n < 12; ++n) {
        const Frame frame = changed(reader.next()->frame);
        if (!film) film = open_film({frame.width, frame.height, {25, 1}, FilmFormat::kMkv, 16000}, path);
        film->add_frame(view(frame));
    }
    film->finish();
    return path;
}

Frame grey(Frame frame) {
    for (std::size_t i = 0; i < frame.rgba.size(); i += 4)
        frame.rgba[i] = frame.rgba[i + 2] = frame.rgba[i + 1];
    return frame;
}

// Every factor-th pixel.
Frame coarse(const Frame& frame, int factor) {
    Frame made{frame.width / factor / 2 * 2, frame.height / factor / 2 * 2, {}};
    const SmallPicture small = small_picture(frame, factor);
    for (int y = 0; y < made.height; ++y) {
        for (int x = 0; x < made.width; ++x) {
            for (const std::uint8_t value : small.picture().at(x, y)) made.rgba.push_back(value);
            made.rgba.push_back(255);
        }
    }
    return made;
}

Frame lying(const Frame& frame) {
    Frame made{frame.height, frame.width, std::vector<std::uint8_t>(frame.rgba.size())};
    for (int y = 0; y < frame.height; ++y) {
        for (int x = 0; x < frame.width; ++x)
            std::copy_n(&frame.rgba[4 * (std::size_t(y) * frame.width + x)], 4,
                        &made.rgba[4 * (std::size_t(x) * made.width + y)]);
    }
    return made;
}

// Twice, side by side.
Frame doubled(const Frame& frame) {
    Frame made{2 * frame.width, frame.height, {}};
    const std::size_t row = std::size_t{4} * frame.width;
    for (int y = 0; y < frame.height; ++y) {
        for (int i = 0; i < 2; ++i)
            made.rgba.insert(made.rgba.end(), &frame.rgba[y * row], &frame.rgba[y * row] + row);
    }
    return made;
}

TEST(FilmTrack, RefusesFilmsThatItCannotSeeLipsIn) {
    const fs::path clip = clips() / "sbwo2p.mpg";
    if (!fs::exists(clip)) GTEST_SKIP() << clip << " is not there";
    EXPECT_NE(refused({.video = remade(clip, "grey.mkv", grey)}).find("no lips that can be told"),
              std::string::npos);
    EXPECT_NE(refused({.video = remade(clip, "lying.mkv", lying)}).find("an upright face"),
              std::string::npos);
    const auto far = remade(clip, "far.mkv", [](const Frame& frame) { return coarse(frame, 5); });
    const std::string why = refused({.video = far});  // a mouth of 8 px
    EXPECT_TRUE(why.find("at least 12 px") != std::string::npos || why.find("no face") != std::string::npos)
        << why;
    const Hint outside{.face = {.left_eye = {-9, 100}, .right_eye = {60, 100}, .eyes_seen = true}};
    EXPECT_NE(refused({.video = clip, .hint = outside}).find("360 x 288 px"), std::string::npos);
}

TEST(FilmTrack, StaysWithOneOfTwoFaces) {
    const fs::path clip = clips() / "sbwo2p.mpg";
    if (!fs::exists(clip)) GTEST_SKIP() << clip << " is not there";
    const FilmTrack track = track_film(recited(), {.video = remade(clip, "two.mkv", doubled)});
    EXPECT_EQ(track.lost, 0);
    EXPECT_TRUE(std::ranges::any_of(
        track.report, [](const std::string& line) { return line.find("2 faces") != std::string::npos; }));
    const auto& u = column(track.motion, "border_top_u_px").values;
    EXPECT_LT(std::ranges::max(u) - std::ranges::min(u), 20);  // px; the faces are 360 apart
}

TEST(Hint, IsReadOrRefused) {
    const Hint hint = parse_hint(R"({"eyes": [[10, 20], [60, 22]], "mouth": [35, 80, 40, 16]})");
    EXPECT_NEAR(hint.face.eye_distance(), std::hypot(50, 2), 1e-12);
    EXPECT_EQ(hint.mouth->width, 40);
    EXPECT_FALSE(parse_hint(R"({"eyes": [[10, 20], [60, 22]]})").mouth.has_value());
    for (const char* bad : {"", "{}", "[]", R"({"eyes": [[1, 2]]})", R"({"eyes": [[60, 2], [10, 2]]})",
                            R"({"eyes": [[1e9, 2], [10, 2]]})", R"({"eyes": [["a", 2], [10, 2]]})",
                            R"({"eyes": [[10, 20], [60, 22]], "mouth": [1, 2, -3, 4]})"})
        EXPECT_THROW(parse_hint(bad), InputError) << bad;
}

TEST(SmallPicture, IsTheMeanOfSquares) {
    Frame frame{4, 2, {}};
    for (int i = 0; i < 8; ++i) frame.rgba.insert(frame.rgba.end(), {std::uint8_t(10 * i), 5, 200, 255});
    const SmallPicture whole = small_picture(frame, 1), half = small_picture(frame, 2);
    EXPECT_EQ(whole.picture().at(3, 1), (Rgb{70, 5, 200}));
    ASSERT_EQ(half.width, 2);
    ASSERT_EQ(half.height, 1);
    EXPECT_EQ(half.picture().at(1, 0), (Rgb{45, 5, 200}));  // 20, 30, 60, 70
    EXPECT_EQ(in_small(in_frame(7.25, 3), 3), 7.25);
}

TEST(Overlay, DrawsAFrameWhereTheTrackIsLost) {
    Frame frame{16, 16, std::vector<std::uint8_t>(4 * 16 * 16, 0)};
    draw_lips(frame, {});
    EXPECT_GT(frame.rgba[0], 0);
    EXPECT_EQ(frame.rgba[4 * (8 * 16 + 8)], 0);
}

}  // namespace
}  // namespace viaface

// The built program as its user meets it.
#include "tests/server/program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/whole_file.hpp"
#include "server/openapi.hpp"
#include "synth/film/media_reader.hpp"
#include "synth/speech/text_grid.hpp"
#include "tests/scratch_folder.hpp"
#include "tests/server/schema_check.hpp"
#include "viapoints/motion_csv.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Arguments = std::vector<std::string>;

constexpr const char* kText = "My mother bought a very big boat.";
constexpr int kFps = 25;

class Program : public testing::Test {
  protected:
    Outcome run(const Arguments& arguments, const std::string& input = "") const {
        return ProgramRun(folder_, arguments, input).outcome();
    }
    // A small film of kText.
    static Arguments say(const Arguments& more) {
        Arguments all = {"say", kText, "--size", "128x128", "--fps", std::to_string(kFps)};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    void make(const Arguments& more) const {
        const Outcome made = run(say(more));
        ASSERT_EQ(made.status, 0) << made.err;
    }
    std::string content(const std::string& name) const { return read_text(folder_ / name, name); }
    // Every name in the folder, hidden ones too.
    std::vector<std::string> names() const {
        std::vector<std::string> found;
        for (const auto& entry : fs::recursive_directory_iterator(folder_))
            found.push_back(entry.path().lexically_relative(folder_).string());
        std::sort(found.begin(), found.end());
        return found;
    }

    const test::ScratchFolder scratch_;
    const fs::path folder_ = scratch_.path();
};

struct Decoded {
    int frames = 0;
    double end_s = 0;  // of the last frame
};

Decoded decode(const MediaSource& film) {
    FrameReader reader(film);
    Decoded all;
    while (const auto frame = reader.next()) {
        EXPECT_EQ(frame->frame.width, 128);
        ++all.frames;
        all.end_s = frame->time_s + 1.0 / kFps;
    }
    return all;
}

// ---- equal bytes ----

TEST_F(Program, TwoRunsAndFourAtOnceGiveEqualBytes) {
    const auto wanted = [](const std::string& tag) {
        return say({"-o", tag + ".mp4", "--labels", tag + ".TextGrid", "--motion", tag + ".motion.csv",
                    "--commanded", tag + ".commanded.csv", "--json", tag + ".json"});
    };
    ASSERT_EQ(run(wanted("alone")).status, 0);
    std::vector<std::unique_ptr<ProgramRun>> together;
    for (int i = 0; i < 4; ++i)
        together.push_back(std::make_unique<ProgramRun>(folder_, wanted("t" + std::to_string(i))));
    for (const auto& one : together) ASSERT_EQ(one->outcome().status, 0);
    for (const char* ending : {".mp4", ".TextGrid", ".motion.csv", ".commanded.csv", ".json"}) {
        const std::string alone = content(std::string("alone") + ending);
        EXPECT_GT(alone.size(), 500u) << ending;
        for (int i = 0; i < 4; ++i)
            EXPECT_TRUE(content("t" + std::to_string(i) + ending) == alone) << i << ending;
    }
    EXPECT_EQ(names().size(), 25u);
}

TEST_F(Program, LosslessFilmsRepeatToo) {
    for (const std::string tag : {"a", "b"}) {
        make({"-o", tag + ".mkv"});
        make({"-o", tag});
    }
    EXPECT_TRUE(content("a.mkv") == content("b.mkv"));
    int files = 0;
    for (const auto& entry : fs::directory_iterator(folder_ / "a")) {
        const std::string name = entry.path().filename();
        EXPECT_TRUE(content("a/" + name) == content("b/" + name)) << name;
        ++files;
    }
    EXPECT_EQ(files, decode(folder_ / "a.mkv").frames + 1);  // and sound.wav
}

// ---- picture, sound, labels and motion belong together ----

TEST_F(Program, PictureAndSoundEndWithinAFrameInEveryFormat) {
    make({"-o", "x.mp4", "--json", "x.json"});
    make({"-o", "x.mkv"});
    const json report = json::parse(content("x.json"));
    for (const std::string name : {"x.mp4", "x.mkv"}) {
        const Decoded film = decode(folder_ / name);
        const double sound_s = static_cast<double>(read_sound(folder_ / name, 48000).size()) / 48000;
        EXPECT_EQ(film.frames, report["frames"]) << name;
        EXPECT_NEAR(film.end_s, sound_s, 1.0 / kFps) << name;
        EXPECT_NEAR(film.end_s, report["duration_s"].get<double>(), 1.0 / kFps) << name;
    }
}

// Normalised correlation of b, shifted to be `lag` samples late, with a.
double correlation(const std::vector<std::int16_t>& a, const std::vector<std::int16_t>& b, int lag) {
    double ab = 0, aa = 1e-9, bb = 1e-9;
    for (int k = std::max(0, -lag); k < static_cast<int>(std::min(a.size(), b.size())) - std::max(0, lag);
         ++k) {
        const double x = a[static_cast<std::size_t>(k)], y = b[static_cast<std::size_t>(k + lag)];
        ab += x * y;
        aa += x * x;
        bb += y * y;
    }
    return ab / std::sqrt(aa * bb);
}

TEST_F(Program, DecodedSoundLiesOnTheWaveform) {
    constexpr int kRate = 48000, kFurthest = kRate / 100;
    make({"-o", "x.mkv"});  // holds the waveform as it is
    make({"-o", "x.mp4"});
    const auto waveform = read_sound(folder_ / "x.mkv", kRate),
               decoded = read_sound(folder_ / "x.mp4", kRate);
    int best = 0;
    for (int lag = -kFurthest; lag <= kFurthest; ++lag) {
        if (correlation(waveform, decoded, lag) > correlation(waveform, decoded, best)) best = lag;
    }
    EXPECT_LE(std::abs(best), kRate / 1000);
    EXPECT_GT(correlation(waveform, decoded, best), 0.98);
}

TEST_F(Program, LabelsAreThePhonesThatDroveTheFace) {
    make({"-o", "x.mp4", "--json", "x.json", "--labels", "x.TextGrid"});
    const json report = json::parse(content("x.json"));
    const TextGrid labels = read_text_grid(content("x.TextGrid"));
    ASSERT_EQ(labels.tiers.size(), 2u);
    const auto& phones = labels.tiers[1].intervals;
    ASSERT_EQ(phones.size(), report["phones"].size());
    EXPECT_GT(phones.size(), 20u);
    for (std::size_t i = 0; i < phones.size(); ++i) {
        EXPECT_EQ(phones[i].begin, report["phones"][i]["begin_s"].get<double>()) << i;
        EXPECT_EQ(phones[i].end, report["phones"][i]["end_s"].get<double>()) << i;
        EXPECT_EQ(phone_info(parse_phone(phones[i].text).phone).name, report["phones"][i]["phone"]) << i;
    }
    EXPECT_EQ(labels.end, report["duration_s"].get<double>());
}

TEST_F(Program, TheReportIsAsTheServiceDescribesIt) {
    const Outcome made =
        run({"say", "--phones", "ax b aa1", "--size", "32x32", "-o", "x.mkv", "--json", "-"});
    ASSERT_EQ(made.status, 0) << made.err;
    const json described = openapi();
    const auto faults =
        SchemaCheck(described).faults(described["components"]["schemas"]["Report"], json::parse(made.out));
    EXPECT_EQ(faults, std::vector<std::string>{});
}

TEST_F(Program, ReportedDifferenceIsThatOfTheTwoMotionFiles) {
    make({"-o", "x.mp4", "--json", "x.json", "--motion", "drawn.csv", "--commanded", "commanded.csv"});
    const json report = json::parse(content("x.json"));
    const Motion drawn = read_motion_csv(folder_ / "drawn.csv").motion,
                 commanded = read_motion_csv(folder_ / "commanded.csv").motion;
    ASSERT_EQ(drawn.positions.rows(), report["frames"].get<int>());
    ASSERT_EQ(commanded.positions.rows(), drawn.positions.rows());
    double sum = 0, farthest = 0;
    for (Eigen::Index n = 0; n < drawn.positions.rows(); ++n) {
        EXPECT_EQ(drawn.time_s[static_cast<std::size_t>(n)], static_cast<double>(n) / kFps);
        for (int point = 0; point < kPoints; ++point) {
            const double apart =
                (drawn.positions.row(n) - commanded.positions.row(n)).segment<3>(3 * point).norm();
            sum += apart * apart;
            farthest = std::max(farthest, apart);
        }
    }
    // The files hold ten-thousandths of a mm, the report thousandths.
    const json& told = report["drawn_minus_commanded_mm"];
    EXPECT_NEAR(std::sqrt(sum / static_cast<double>(drawn.positions.rows() * kPoints)), told["rms"], 0.001);
    EXPECT_NEAR(farthest, told["max"], 0.001);
    EXPECT_GT(farthest, 0.01);  // contact holds the drawn lips where the spline goes past it
}

// ---- stdin and stdout ----

TEST_F(Program, ADashStreamsAFragmentedMp4) {
    const Outcome streamed = run(say({"-o", "-", "--json", "x.json"}));
    ASSERT_EQ(streamed.status, 0) << streamed.err;
    const std::span bytes(reinterpret_cast<const std::uint8_t*>(streamed.out.data()), streamed.out.size());
    EXPECT_NE(streamed.out.find("moof"), std::string::npos);
    const Decoded film = decode(bytes);
    EXPECT_EQ(film.frames, json::parse(content("x.json"))["frames"]);
    EXPECT_NEAR(film.end_s, static_cast<double>(read_sound(bytes, 48000).size()) / 48000, 1.0 / kFps);
    EXPECT_EQ(names(), Arguments{"x.json"});
}

TEST_F(Program, ReadsTextFromStdinAndReportsOnStdout) {
    Arguments asked = say({"-o", "x.mp4", "--json", "-"});
    asked[1] = "-";
    const Outcome made = run(asked, std::string(kText) + "\n");
    ASSERT_EQ(made.status, 0) << made.err;
    EXPECT_EQ(json::parse(made.out)["words"].size(), 7u);
    EXPECT_EQ(made.err, "");
}

TEST_F(Program, SaysPhonesForAsLongAsAsked) {
    const Outcome made =
        run({"say", "--phones", "ax b:90 aa1:220", "--size", "128x128", "-o", "x.mp4", "--json", "-"});
    ASSERT_EQ(made.status, 0) << made.err;
    std::vector<double> seconds;
    const json report = json::parse(made.out);
    for (const auto& phone : report["phones"]) {
        if (phone["phone"] == "b" || phone["phone"] == "aa")
            seconds.push_back(phone["end_s"].get<double>() - phone["begin_s"].get<double>());
    }
    ASSERT_EQ(seconds.size(), 2u);
    EXPECT_NEAR(seconds[0], 0.090, 1.0 / 16000);
    EXPECT_NEAR(seconds[1], 0.220, 1.0 / 16000);
}

TEST_F(Program, TakesATalkerByItsFolder) {
    make({"-o", "x.mp4"});
    make({"-o", "y.mp4", "--talker", std::string(VIAFACE_SOURCE_DIR) + "/talkers/momo"});
    EXPECT_TRUE(content("x.mp4") == content("y.mp4"));
}

// ---- help ----

TEST_F(Program, ExplainsItself) {
    EXPECT_EQ(run({"--version"}).out.rfind("viaface ", 0), 0u);
    for (const Arguments& command : std::vector<Arguments>{{},
                                                           {"say"},
                                                           {"serve"},
                                                           {"talker"},
                                                           {"talker", "list"},
                                                           {"talker", "make"},
                                                           {"compare"},
                                                           {"bench"}}) {
        Arguments asked = command;
        asked.push_back("--help");
        const Outcome help = run(asked);
        EXPECT_EQ(help.status, 0);
        EXPECT_EQ(help.err, "");
        EXPECT_GT(help.out.size(), 100u) << (command.empty() ? "viaface" : command[0]);
    }
    const std::string say_help = run({"say", "--help"}).out;
    for (const char* limit :
         {"raster", "60 s", "20000", "16 to 4096", "15 to 120", "-180 to 180", "0.5 to 2"})
        EXPECT_NE(say_help.find(limit), std::string::npos) << limit;
}

// ---- bad input ----

struct Refused {
    Arguments arguments;
    Arguments told;  // field, value and what is allowed, as the message must hold them
    std::string input = "";
};

std::vector<Refused> refused_texts() {
    return {
        {{"say", ""}, {"text", "not empty"}},
        {{"say"}, {"text", "not empty"}},
        {{"say", " \n "}, {"text"}},
        {{"say", "?!... --"}, {"text", "?!"}},
        {{"say", "\xf0\x9f\x98\x80\xf0\x9f\x8e\x89"}, {"text", "\xf0\x9f\x98\x80"}},
        {{"say", "caf\xe9"}, {"text", "UTF-8"}},
        {{"say", "-"}, {"text", "control"}, std::string("one\0two", 7)},
        {{"say", std::string(100 * 1024, 'a')}, {"text", "102400 bytes", "20000"}},
        {{"say", std::string(5000, 'a')}, {"text", "aaaa", "100"}},
        {{"say", "-"}, {"text", "20000"}, std::string(50000, 'a')},
        {{"say", "Hi.", "--phones", "aa1"}, {"phones", "aa1", "one of text and phones"}},
        {{"say", "--phones", "aa1 zz"}, {"phones", "zz"}},
        {{"say", "--phones", "aa1:99999"}, {"phones", "99999", "2000"}},
        {{"say", "--phones", " "}, {"phones"}},
    };
}

std::vector<Refused> refused_options() {
    const auto hi = [](const Arguments& more) {
        Arguments all = {"say", "Hi."};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    };
    return {
        {hi({"--voice", "nobody"}), {"voice", "nobody", "rms"}},
        {hi({"--talker", "nobody"}), {"talker", "nobody", "momo"}},
        {hi({"--talker", "./nowhere"}), {"talker", "nowhere"}},
        {hi({"-o", "x.gif"}), {"output", "x.gif", ".mp4"}},
        {hi({"-o", "/nowhere/at/all/x.mp4"}), {"output", "/nowhere/at/all/x.mp4", "folder"}},
        {hi({"-o", "/nowhere/at/all/x"}), {"output", "/nowhere/at/all/x", "folder"}},
        {hi({"--size", "0x0"}), {"size", "0x0", "4096"}},
        {hi({"--size", "100000x100000"}), {"size", "100000x100000", "4096"}},
        {hi({"--size", "99999999999x2"}), {"size", "99999999999x2"}},
        {hi({"--size", "big"}), {"size", "big", "WIDTHxHEIGHT"}},
        {hi({"--size", "129x129"}), {"size", "129x129", "even"}},
        {hi({"--fps", "0"}), {"fps", "0", "15 to 120"}},
        {hi({"--fps", "nan"}), {"fps", "nan", "15 to 120"}},
        {hi({"--fps", "1e9"}), {"fps", "15 to 120"}},
        {hi({"--fps", "many"}), {"fps", "many", "15 to 120"}},
        {hi({"--yaw", "1e9"}), {"yaw", "1000000000", "-180 to 180"}},
        {hi({"--tilt", "inf"}), {"tilt", "inf", "-180 to 180"}},
        {hi({"--roll", "nan"}), {"roll", "nan", "-180 to 180"}},
        {hi({"--yaw", "left"}), {"yaw", "left", "-180 to 180"}},
        {hi({"--rate", "9"}), {"rate", "9", "0.5 to 2"}},
        {hi({"--pitch", "0"}), {"pitch", "0", "0.5 to 2"}},
        {hi({"--rate", "nan"}), {"rate", "nan", "0.5 to 2"}},
        {hi({"--background", "plaid"}), {"background", "plaid", "#rrggbb"}},
        {hi({"--seed", "-1"}), {"seed", "-1"}},
        {hi({"--seed", "many"}), {"seed", "many", "whole number"}},
        {hi({"--renderer", "gl"}), {"renderer", "gl", "raster or osmesa"}},
        {hi({"--colour", "red"}), {"--colour"}},
        {hi({"--labels", "/nowhere/x.TextGrid"}), {"labels", "/nowhere/x.TextGrid", "folder"}},
        {hi({"--motion", "/nowhere/x.csv"}), {"motion", "/nowhere/x.csv", "folder"}},
        {hi({"--commanded", "/nowhere/x.csv"}), {"commanded", "/nowhere/x.csv", "folder"}},
        {hi({"--json", "/nowhere/x.json"}), {"json", "/nowhere/x.json", "folder"}},
        {hi({"--json", "/tmp"}), {"json", "/tmp"}},
        {hi({"-o", "x.mp4", "--json", "x.mp4"}), {"json", "x.mp4"}},
        {hi({"-o", "-", "--json", "-"}), {"json", "-", "a file"}},
        {{"serve", "--port", "99999"}, {"port", "99999", "65535"}},
        {{"serve", "--host", "256.1.1.1", "--port", "0"}, {"256.1.1.1"}},
        {{"fly"}, {"command", "fly", "say"}},
        {{}, {"command", "say"}},
    };
}

TEST_F(Program, RefusesBadInputByFieldValueAndWhatIsAllowedAndLeavesNothing) {
    auto cases = refused_texts();
    for (auto& refused : refused_options()) cases.push_back(std::move(refused));
    for (const Refused& refused : cases) {
        std::string shown;
        for (const auto& argument : refused.arguments) shown += argument.substr(0, 60) + " ";
        const Outcome outcome = run(refused.arguments, refused.input);
        EXPECT_EQ(outcome.status, 2) << shown << outcome.err;
        EXPECT_EQ(outcome.out, "") << shown;
        for (const auto& word : refused.told)
            EXPECT_NE(outcome.err.find(word), std::string::npos)
                << shown << "lacks " << word << ": " << outcome.err;
        EXPECT_EQ(names(), Arguments{}) << shown;
    }
}

TEST_F(Program, KeepsAFolderThatHoldsFiles) {
    fs::create_directory(folder_ / "frames");
    std::ofstream(folder_ / "frames" / "mine.txt") << "mine";
    const Outcome refused = run(say({"-o", "frames"}));
    EXPECT_EQ(refused.status, 2);
    EXPECT_NE(refused.err.find("output"), std::string::npos) << refused.err;
    EXPECT_EQ(names(), (Arguments{"frames", "frames/mine.txt"}));
}

}  // namespace
}  // namespace viaface

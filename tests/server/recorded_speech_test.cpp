// Recorded speech and recordings of motion, as the user of the program meets them.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/whole_file.hpp"
#include "synth/film/media_reader.hpp"
#include "synth/speech/flite_voice.hpp"
#include "synth/speech/text_grid.hpp"
#include "synth/speech/wav.hpp"
#include "tests/scratch_folder.hpp"
#include "tests/server/program.hpp"
#include "viapoints/motion_csv.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

constexpr const char* kText = "My mother bought a boat.";

class RecordedSpeechProgram : public testing::Test {
  protected:
    RecordedSpeechProgram() {
        said_ = FliteVoice("slt").speak(kText);
        const Bytes wave = write_wav(said_.sound);
        write_whole(folder_ / "speech.wav", std::span(wave));
    }

    Outcome run(const Arguments& arguments) const { return ProgramRun(folder_, arguments).outcome(); }
    Outcome say(const Arguments& more) const {
        Arguments all = {"say", "--audio", "speech.wav", "--size", "64x64", "--fps", "25"};
        all.insert(all.end(), more.begin(), more.end());
        return run(all);
    }
    TextGrid grid(const std::string& name) const { return read_text_grid(read_text(folder_ / name, name)); }

    const test::ScratchFolder scratch_;
    const fs::path folder_ = scratch_.path();
    Utterance said_;
};

TEST_F(RecordedSpeechProgram, TheFaceSpeaksTheRecordingItself) {
    const Outcome made = say({"--transcript", kText, "-o", "film.mkv", "--labels", "said.TextGrid",
                              "--motion", "m.csv", "--json", "said.json"});
    ASSERT_EQ(made.status, 0) << made.err;
    EXPECT_NE(made.err.find("confidence"), std::string::npos);
    const MonoSound heard = read_sound(folder_ / "film.mkv");
    EXPECT_EQ(heard.rate, said_.sound.sample_rate);
    ASSERT_GE(heard.samples.size(), said_.sound.samples.size());
    EXPECT_TRUE(std::equal(said_.sound.samples.begin(), said_.sound.samples.end(), heard.samples.begin()));
    const auto report = nlohmann::json::parse(read_text(folder_ / "said.json", "json"));
    EXPECT_EQ(report.at("voice"), "recorded");
    EXPECT_EQ(report.at("samples"), said_.sound.samples.size());
    // b closes the lips where the recording has it.
    const auto phones = phones_of(grid("said.TextGrid"), 16000);
    const Motion motion = read_motion_csv(folder_ / "m.csv").motion;
    int closed = 0;
    for (const TimedPhone& phone : phones.phones) {
        if (phone_info(phone.phone).viseme != VisemeClass::kBilabial) continue;
        double gap = 1e9;
        for (std::size_t i = 0; i < motion.size(); ++i) {
            if (motion.time_s[i] < phone.begin / 16000.0 - 0.02 ||
                motion.time_s[i] > phone.end / 16000.0 + 0.02)
                continue;
            gap = std::min(gap, motion.positions(static_cast<Eigen::Index>(i), 3 * kInnerTop + 1) -
                                    motion.positions(static_cast<Eigen::Index>(i), 3 * kInnerBottom + 1));
        }
        EXPECT_LT(gap, 1) << phone_info(phone.phone).name;
        ++closed;
    }
    EXPECT_EQ(closed, 4);  // m m b b
}

TEST_F(RecordedSpeechProgram, AlignWritesTheLabelsThatSayTakes) {
    write_whole(folder_ / "words.txt", std::string_view(kText));
    const Outcome aligned = run({"align", "speech.wav", "--transcript", "@words.txt", "-o", "x.TextGrid"});
    ASSERT_EQ(aligned.status, 0) << aligned.err;
    const Outcome made = say({"--textgrid", "x.TextGrid", "-o", "film.mp4", "--labels", "y.TextGrid"});
    ASSERT_EQ(made.status, 0) << made.err;
    EXPECT_EQ(read_text(folder_ / "x.TextGrid", "x"), read_text(folder_ / "y.TextGrid", "y"));
    const Outcome again = run({"align", "speech.wav", "--transcript", kText});
    EXPECT_EQ(again.out, read_text(folder_ / "x.TextGrid", "x"));
}

TEST_F(RecordedSpeechProgram, BadInputNamesItsOption) {
    const std::pair<Arguments, const char*> cases[] = {
        {{"--transcript", "Rice is often served in round bowls, and wheat is not."}, "--transcript"},
        {{"--transcript", "..."}, "--transcript"},
        {{"--transcript", "@none.txt"}, "--transcript"},
        {{}, "--transcript"},
        {{"--transcript", kText, "--textgrid", "x.TextGrid"}, "--transcript"},
        {{"--textgrid", "speech.wav"}, "--textgrid"},
        {{"--textgrid", "none.TextGrid"}, "--textgrid"},
        {{"words", "--transcript", kText}, "text"},
    };
    for (const auto& [more, option] : cases) {
        const Outcome made = say(more);
        EXPECT_EQ(made.status, 2) << option;
        EXPECT_NE(made.err.find(option), std::string::npos) << made.err;
    }
    const Outcome made = run({"say", "--audio", "none.wav", "--transcript", kText});
    EXPECT_EQ(made.status, 2);
    EXPECT_NE(made.err.find("--audio"), std::string::npos) << made.err;
    EXPECT_EQ(run({"say", "--transcript", kText}).status, 2);
}

TEST_F(RecordedSpeechProgram, ACodexIsLearnedFromExportedRecitations) {
    const Outcome exported = run({"codex", "export", "takes", "--count", "6", "--voice", "kal16"});
    ASSERT_EQ(exported.status, 0) << exported.err;
    const Outcome checked = run({"codex", "check", "takes", "--left-out", "20%"});
    ASSERT_EQ(checked.status, 0) << checked.err;
    EXPECT_NE(checked.out.find("inner_bottom"), std::string::npos) << checked.out;
    const Outcome learnt = run({"codex", "learn", "takes", "-o", "pupil"});
    ASSERT_EQ(learnt.status, 0) << learnt.err;
    EXPECT_NE(learnt.out.find("diphones"), std::string::npos);
    const Outcome made =
        run({"say", kText, "--talker", "./pupil", "--size", "64x64", "--fps", "15", "-o", "p.mp4"});
    EXPECT_EQ(made.status, 0) << made.err;
    EXPECT_EQ(run({"codex", "learn", "takes", "-o", "pupil"}).status, 2);  // it is there already
    fs::remove(folder_ / "takes" / "0003.wav");
    const Outcome broken = run({"codex", "check", "takes"});
    EXPECT_EQ(broken.status, 2);
    EXPECT_NE(broken.err.find("0003"), std::string::npos) << broken.err;
    EXPECT_EQ(run({"codex", "check", "takes", "--left-out", "many"}).status, 2);
}

}  // namespace
}  // namespace viaface

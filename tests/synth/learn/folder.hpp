// A folder of its own for a test, and small recordings to put into it.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "synth/learn/performed_takes.hpp"
#include "synth/speech/text_grid.hpp"
#include "synth/speech/wav.hpp"
#include "synth/talker/talker.hpp"
#include "tests/scratch_folder.hpp"
#include "viapoints/codex_file.hpp"
#include "viapoints/motion_csv.hpp"

namespace viaface::testing {

namespace fs = std::filesystem;

inline const fs::path kMomo = fs::path(VIAFACE_SOURCE_DIR) / "talkers" / "momo";

inline const Codex& momo_codex() {
    static const Codex codex = read_codex(read_bytes(kMomo / "codex.via", "codex"));
    return codex;
}

inline Motion csv_motion(const fs::path& file, const PhoneSequence&) { return read_motion_csv(file).motion; }

class InFolder : public ::testing::Test {
  protected:
    void put(const std::string& name, std::string_view text) const { write_whole(folder_ / name, text); }
    void put(const std::string& name, const Waveform& sound) const {
        const Bytes bytes = write_wav(sound);
        write_whole(folder_ / name, std::span(bytes));
    }
    void put(const std::string& name, const Motion& motion) const {
        write_motion_csv(folder_ / name, motion);
    }
    void put_labels(const std::string& name, const Utterance& said) const {
        TextGrid grid;
        append_to(grid, said, 0);
        put(name, write_text_grid(grid));
    }
    // Motion, sound and labels of one sentence.
    PerformedTake put_take(const std::string& name, const std::string& sentence) const {
        PerformedTake performed = perform(momo_codex(), name, sentence, "kal16");
        put(name + ".csv", performed.take.motion);
        put(name + ".wav", performed.utterance.sound);
        put_labels(name + ".TextGrid", performed.utterance);
        return performed;
    }

    const test::ScratchFolder scratch_;
    const fs::path folder_ = scratch_.path();
};

// The refusal of bad input; its message must hold every one of `parts`.
template <class Work>
void expect_refused(Work work, const std::vector<std::string>& parts) {
    try {
        work();
        ADD_FAILURE() << "accepted: " << parts.front();
    } catch (const InputError& error) {
        for (const std::string& part : parts)
            EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
}

}  // namespace viaface::testing

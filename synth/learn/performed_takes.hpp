// What a talker says, as takes: the material from which another codex can be learned, and against which the
// learning is checked.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "synth/learn/codex_learning.hpp"
#include "synth/speech/utterance.hpp"

namespace viaface {

inline constexpr int kPerformedRate = 100;  // Hz, of the motion

struct PerformedTake {
    Take take;  // the points as commanded
    Utterance utterance;
    std::string text;
};

// One sentence of sentences() in synth/speech/text.hpp, by a voice of synth/speech/flite_voice.hpp.
PerformedTake perform(const Codex& codex, const std::string& name, const std::string& sentence,
                      const std::string& voice);

// Motion (CSV), sound (WAV), phones (TextGrid) and words (.txt) of every text into a new folder, as
// "0001.csv" and so on. `progress` hears the share that is done.
void export_takes(const Codex& codex, const std::vector<std::string>& texts, const std::string& voice,
                  const std::filesystem::path& folder, const std::string& remark,
                  const std::function<void(double)>& progress = {});

}  // namespace viaface

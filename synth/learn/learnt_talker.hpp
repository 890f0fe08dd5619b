// A talker whose motion was learned from recordings: face and estimators of another talker, and a codex of
// its own.
#pragma once

#include <filesystem>
#include <string>

#include "synth/learn/recorded_takes.hpp"

namespace viaface {

struct LearntTalker {
    LearntCodex learnt;
    Coverage coverage;
    SpokenShares shares;  // of the takes' own phones, spoken from the units of the other takes
};

// Learns from the takes and writes the talker's folder, which must not be there yet, whole or not at all.
// `base` is the folder of the talker whose face it takes.
LearntTalker make_talker(const RecordedTakes& takes, const std::filesystem::path& base,
                         const std::filesystem::path& folder, const LearningOptions& options = {});

// How many phones, diphones and triphones there are, which are missing, and how its own sentences would be
// spoken by units of other takes.
std::string as_text(const LearntTalker& talker);

}  // namespace viaface

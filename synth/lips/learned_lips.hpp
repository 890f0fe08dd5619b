// A lip model from frames, and what it says about itself.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lipmodel/lip_file.hpp"
#include "synth/lips/lip_frames.hpp"

namespace viaface {

// The provenance names the files that the frames came from. InputError("motion", ...) when the points are no
// mouth, or nothing moves above the noise.
LipModel learn_from(const LipFrames& frames, const LipTraining& training,
                    const std::vector<std::filesystem::path>& sources);

// Training that goes on [Basu98, 6.3]: the frames beside what the model was learned from, about its rest.
LipModel learn_on(const LipModel& model, const LipFrames& frames, const LipTraining& training,
                  const std::vector<std::filesystem::path>& sources);

std::string model_text(const LipModel& model);  // modes with their variance, what is left over

LipModel load_lip_model(const std::filesystem::path& path);  // InputError("lips", ...)

}  // namespace viaface

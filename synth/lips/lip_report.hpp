// What the learned lips are worth, beside the paper's figures: variance by mode, and the whole shape
// reconstructed from two of three coordinates. [Basu98, section 4.2 and Table 1] The paper's data (150 frames
// of one talker, tracked) and ours differ, so its figures stand beside for scale only.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lipmodel/reconstruction.hpp"
#include "synth/lips/lip_frames.hpp"

namespace viaface {

inline constexpr double kPaperVarianceShare = 0.992;  // of ten modes
inline constexpr int kPaperModes = 10;

// One set of frames by itself.
struct LipFigures {
    int frames = 0;
    int carried = 0;                   // modes above the noise
    std::vector<double> variance;      // of each mode, mm^2
    double total_variance = 0;         // mm^2
    std::vector<ViewErrors> by_modes;  // cross-validated with 1, 2, ... modes
};

struct LipReport {
    double noise_mm = 0;
    double extent_mm = 0;  // of the mesh at rest: 2.83 of the paper's units
    LipFigures trained, recited;
    std::vector<ViewErrors>
        tried;  // learned from all of the training, tried on the test, by modes; may be empty
    int tried_frames = 0;
    double force_beside_energy_mm = 0,
           moved_mm = 0;  // rms over the mesh: least f'f to least u'Ku; how far from rest
};

LipReport report_lips(const LipFrames& train, const std::optional<LipFrames>& test, const LipFrames& recited,
                      const LipTraining& training);

double share_of(const LipFigures& figures, std::size_t modes);  // of the variance, in the first so many modes

std::string lip_report_text(const LipReport& report);

}  // namespace viaface

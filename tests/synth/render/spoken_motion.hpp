// A motion of the built-in talker's points made by hand: the jaw opens and shuts at 2 Hz.
#pragma once

#include <cmath>
#include <filesystem>

#include "synth/talker/talker.hpp"
#include "viapoints/motion.hpp"

namespace viaface {

inline const Talker& momo() {
    static const Talker talker = load_talker(std::filesystem::path(VIAFACE_SOURCE_DIR) / "talkers/momo");
    return talker;
}

inline Configuration momo_at_rest() { return momo().poser.drawn_points(momo().face.rest); }

// Shut until `still_s`; then the chin, the lower lip and the incisor go down by up to 10 mm.
inline Motion opening_motion(double rate, double seconds, double still_s = 0) {
    Motion motion;
    const auto samples = static_cast<Eigen::Index>(std::lround(rate * seconds)) + 1;
    motion.positions.resize(samples, kCoordinates);
    for (Eigen::Index i = 0; i < samples; ++i) {
        const double t = static_cast<double>(i) / rate;
        motion.time_s.push_back(t);
        Configuration c = momo_at_rest();
        const double down = t < still_s ? 0 : 5 * (1 - std::cos(4 * M_PI * (t - still_s)));
        for (const int point : {kChin, kChinLeft, kChinRight, kLipBottom, kLipBottomLeft, kLipBottomRight,
                                kBorderBottom, kBorderBottomLeft, kBorderBottomRight, kInnerBottom,
                                kInnerBottomLeft, kInnerBottomRight, kLowerIncisor, kTongueTip, kTongueBody})
            c[3 * point + 1] -= down;
        motion.positions.row(i) = c.transpose();
    }
    return motion;
}

}  // namespace viaface

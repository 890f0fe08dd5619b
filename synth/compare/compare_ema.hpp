// A motion beside the same sentence measured on a real talker by electromagnetic articulography (EMA):
// correlation and amplitude ratio of lip opening, lip protrusion and jaw height, and when each bilabial
// closes. The motion comes from anywhere, as long as it runs on the clock of the recording's phones.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viapoints/motion.hpp"
#include "viapoints/phones.hpp"

namespace viaface {

struct EmaRecording {
    PhoneSequence phones;
    std::vector<double> time_s;  // strictly rising
    RowMatrix upper_lip, lower_lip,
        jaw;  // [samples x 3], mm: forward, left, up; sensors on the vermilion border
};

// `motion` is CSV with t_s and UL, LL, JAW columns (NAME_x_mm, NAME_y_mm, NAME_z_mm); `phones` has one "begin
// end PHONE" in s per line, gapless. InputError("recording", ...) for what is not so.
EmaRecording read_ema(const std::filesystem::path& motion, const std::filesystem::path& phones);

struct Agreement {
    double correlation;  // Pearson's
    double ratio;        // standard deviation of the motion over that of the recording
};

struct ClosureTiming {
    PhoneId phone;
    double centre_s;             // of the phone
    double measured_s, moved_s;  // the least opening within 30 ms of the phone, on the recording's samples
};

struct EmaComparison {
    Agreement opening;     // distance of the lips' border, upper to lower
    Agreement protrusion;  // forward place of the border, mean of upper and lower
    Agreement jaw;         // height of the lower incisors
    std::vector<ClosureTiming> bilabials;
};

// Over the phones between the first and the last pause. std::invalid_argument when the motion does not cover
// them.
EmaComparison compare(const EmaRecording& recording, const Motion& motion);

// One line per figure.
std::string report(const EmaComparison& comparison);

}  // namespace viaface

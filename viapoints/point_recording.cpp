#include "viapoints/point_recording.hpp"

#include <algorithm>

#include "viapoints/cells.hpp"

namespace viaface {

std::optional<double> millimetres_per(std::string_view unit) {
    const std::string lower = in_lower_case(trimmed(unit));
    for (const char* name : {"mm", "millimeter", "millimeters", "millimetre", "millimetres"})
        if (lower == name) return 1;
    for (const char* name : {"cm", "centimeter", "centimeters", "centimetre", "centimetres"})
        if (lower == name) return 10;
    for (const char* name : {"m", "meter", "meters", "metre", "metres"})
        if (lower == name) return 1000;
    return std::nullopt;
}

std::string unused_label(const std::vector<std::string>& taken, std::string_view label) {
    const auto used = [&](const std::string& name) {
        return std::find(taken.begin(), taken.end(), name) != taken.end();
    };
    std::string name(label);
    for (int n = 2; used(name); ++n) name = std::string(label) + " (" + std::to_string(n) + ")";
    return name;
}

}  // namespace viaface

// Motion as text. '#' comments, one header, one line per sample, LF or CRLF, UTF-8:
//
//   # any metadata
//   time_s,lip_top_x_mm,lip_top_y_mm,lip_top_z_mm,...,any_other_column
//   0,0.5,12.25,8,...,1
//
// time_s comes first, finite and strictly rising. A point of the layout (LAYOUT.md) has its three columns
// side by side, in mm in the head frame, within 1e6 mm of the origin; any other column is kept as
// Motion::extra, its cells numbers too. A cell that is empty or nan (in any case) is NaN. Numbers are written
// the shortest way that reads back as the same double, whatever the locale, so that a motion written and read
// is equal bit by bit; points without any measured sample are not written.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "viapoints/motion.hpp"

namespace viaface {

inline constexpr std::size_t kMotionCsvBytes = 256u << 20;
inline constexpr std::size_t kMotionCsvSamples = 500'000;
inline constexpr std::size_t kMotionCsvColumns = 4096;

struct MotionCsv {
    std::vector<std::string> comments;  // without '#' and the space after it
    Motion motion;
};

// InputError names the line and the column in its field ("motion line 3, column chin_x_mm"), the cell and
// what is allowed.
MotionCsv parse_motion_csv(std::string_view text, const std::string& field = "motion");
MotionCsv read_motion_csv(const std::filesystem::path& path, const std::string& field = "motion");

// std::invalid_argument for a motion whose shapes disagree, and for comments or names that cannot be written
// as such.
std::string format_motion_csv(const Motion& motion, const std::vector<std::string>& comments = {});
void write_motion_csv(const std::filesystem::path& path, const Motion& motion,
                      const std::vector<std::string>& comments = {});  // appears whole

}  // namespace viaface

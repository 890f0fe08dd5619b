// One measured sentence (electromagnetic articulography, 100 Hz) as a Motion. Its axes are x forward, y to
// the talker's left, z up; ours are x to the left, y up, z forward. Lips and jaw fall on points of the layout
// that lie near its sensors.
#pragma once

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>

#include "viapoints/motion.hpp"

namespace viaface {

inline const std::string kHaskinsCsv =
    std::string(VIAFACE_SOURCE_DIR) + "/../shared/data/haskins_f01/F01_B01_S01_R01_N.csv";

// Sensors in the file's order: upper lip, lower lip, mouth corner, jaw, jaw left, tongue tip, tongue body,
// tongue rear.
inline constexpr Point kHaskinsSensors[] = {kBorderTop, kBorderBottom, kLipCornerLeft, kLowerIncisor,
                                            kJawLeft,   kTongueTip,    kTongueBody,    kTongueRear};

inline Motion haskins_motion() {
    std::ifstream in(kHaskinsCsv);
    std::string line;
    std::getline(in, line);
    std::vector<Configuration> rows;
    Motion motion;
    while (std::getline(in, line)) {
        std::istringstream cells(line);
        std::string cell;
        std::getline(cells, cell, ',');
        motion.time_s.push_back(std::stod(cell));
        Configuration row = Configuration::Constant(std::nan(""));
        for (const Point point : kHaskinsSensors) {
            for (const int ours : {2, 0, 1}) {
                std::getline(cells, cell, ',');
                row[3 * point + ours] = std::stod(cell);
            }
        }
        rows.push_back(row);
    }
    motion.positions.resize(static_cast<Eigen::Index>(rows.size()), kCoordinates);
    for (std::size_t i = 0; i < rows.size(); ++i)
        motion.positions.row(static_cast<Eigen::Index>(i)) = rows[i].transpose();
    return motion;
}

}  // namespace viaface

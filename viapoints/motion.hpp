// Measured or drawn motion of the layout's points: one configuration per sample.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "viapoints/layout.hpp"

namespace viaface {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// A column that a motion file holds beside the layout's; kept on the way through.
struct ExtraColumn {
    std::string name;
    std::vector<double> values;  // one per sample
};

struct Motion {
    std::vector<double> time_s;  // strictly rising
    RowMatrix positions;         // [samples x 114], mm, head frame; NaN where not measured
    std::vector<ExtraColumn> extra = {};

    std::size_t size() const { return time_s.size(); }
    Configuration at(std::size_t i) const { return positions.row(static_cast<Eigen::Index>(i)).transpose(); }
};

}  // namespace viaface

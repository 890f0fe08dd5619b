// What the estimators of a talker are trained on, one posture per column, and its file (estimators.bin).
// The file: "VIAE", u32 version 1, u32 modes, u32 postures, then the rest configuration (114), the
// configurations, the coefficients and the contours as little-endian doubles, column by column, and the
// CRC-32 of all before it.
#pragma once

#include <span>

#include "base/bytes.hpp"
#include "facemodel/lips.hpp"
#include "viapoints/layout.hpp"

namespace viaface {

struct PoseTraining {
    static constexpr int kContourNumbers = 2 * 3 * LipGrid::kColumns;

    Configuration rest;              // the points at Face::rest, mm
    Eigen::MatrixXd configurations;  // [114 x postures], mm
    Eigen::MatrixXd coefficients;    // [modes x postures], mm
    Eigen::MatrixXd contours;        // [240 x postures], mm: middle, then inner, x y z of column 0 first
};

Bytes write_training(const PoseTraining& training);
// InputError("talker", ...) for bytes that are not such a file.
PoseTraining read_training(std::span<const std::uint8_t> bytes);

}  // namespace viaface

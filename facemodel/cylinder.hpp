// Scans as a cylindrical range map, the form in which a laser scanner that turns round the head gives them.
// [ATR98, "Static face scans": 512 x 512; "converted from cylindrical (r, theta) to Cartesian 3D"]
// Departure: the map covers the face (+-110 degrees), not the full turn, so a face takes most of its samples.
#pragma once

#include <optional>
#include <vector>

#include "facemodel/mesh.hpp"

namespace viaface {

using Flat = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;  // [nodes x 2]: u, height, mm

// The vertical axis x = 0, z = axis_z of the head frame. Unrolled, a point is (u, height, r) with
// u = radius * theta, theta = 0 in front and rising towards the talker's left.
struct Cylinder {
    double axis_z = -75;  // mm
    double radius = 75;   // mm: only the scale of u

    Eigen::Vector3d unrolled(const Eigen::Vector3d& head) const;  // x, y, z -> u, height, r
    Eigen::Vector3d rolled(const Eigen::Vector3d& flat) const;    // u, height, r -> x, y, z
};

// Where the samples of a map lie: columns x rows cell centres.
struct RangeFrame {
    Cylinder cylinder;
    int columns = 512, rows = 512;
    double u_min = -144, u_max = 144;            // mm
    double height_min = -115, height_max = 160;  // mm

    Eigen::Vector2d place(int column, int row) const;          // of a sample: u, height
    Eigen::Vector2d cell(const Eigen::Vector2d& place) const;  // column, row; fractions between samples
};

class RangeMap {
  public:
    // The surface farthest from the axis along each sample's ray. Pits narrower than 5 mm and deeper than 2
    // mm (nostrils) are closed to their rim by a grey-scale closing: a laser seen from aside does not reach
    // into them.
    RangeMap(const RangeFrame& frame, const Nodes& nodes, const std::vector<Triangle>& triangles);

    const RangeFrame& frame() const { return frame_; }
    std::optional<double> sample(int column, int row) const;  // r, mm; none in a hole or outside
    // r between samples: bilinear over those that are there; beside a hole the nearest sample within `reach`
    // samples. None when there is none.
    std::optional<double> range(const Eigen::Vector2d& place, int reach = 8) const;
    int samples() const;  // not holes

  private:
    void draw(const Nodes& nodes, const Triangle& triangle);
    void close_pits();
    std::optional<double> nearest(const Eigen::Vector2d& cell, int reach) const;

    RangeFrame frame_;
    std::vector<double> range_;  // [rows x columns], mm; NaN in holes
};

}  // namespace viaface

// The turn, scale and shift that carry one set of places onto another. [Horn87; Umeyama91]
#pragma once

#include <Eigen/Geometry>

#include "facemodel/nearest_surface.hpp"

namespace viaface {

struct Similarity {
    double scale = 1;
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();

    Eigen::Vector3d operator()(const Eigen::Vector3d& p) const { return scale * (turn * p) + shift; }
    Nodes carried(const Nodes& nodes) const {
        return (scale * nodes * turn.transpose()).rowwise() + shift.transpose();
    }
    Similarity inverse() const;
};

enum class Size { kFree, kKept };

Similarity similarity_between(const Nodes& from, const Nodes& to,
                              Size size = Size::kFree);  // least squares; row by row

struct Alignment {
    Similarity to_scan;  // from the places to the scan
    double rms = 0;      // of the places that were kept, in the scan's unit
};

// Iterated closest points [BeslMcKay92] with the worst third left out each time, until nothing
// moves or for so many rounds. normals: of the places.
Alignment aligned(const Nodes& places, const Nodes& normals, const NearestSurface& scan, Similarity start,
                  int rounds, Size size = Size::kFree);

}  // namespace viaface

// Heads and scans of them that the tests of scans share.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "synth/scans/feature_pins.hpp"
#include "synth/scans/scan_folder.hpp"

namespace viaface {

inline const GenericHead& momo() {
    static const GenericHead head = generic_head(std::filesystem::path(VIAFACE_SOURCE_DIR) / "talkers/momo");
    return head;
}

// Another head: the generic one, wider, with a longer nose, turned and in metres; without colours.
inline Nodes other_head() {
    Nodes nodes = momo().face.rest;
    for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
        const Eigen::Vector3d p = nodes.row(i);
        nodes(i, 0) *= 1.06;
        nodes(i, 2) += 3 * std::exp(-(p - Eigen::Vector3d(0, 35, 20)).squaredNorm() / 400);
    }
    return nodes;
}

inline const Eigen::Matrix3d kTurn =
    Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, 2, 0.5).normalized()).toRotationMatrix();

inline Eigen::Vector3d in_scan(const Eigen::Vector3d& head) {
    return kTurn * head / 1000 + Eigen::Vector3d(1, 2, 3);
}

inline ScanFolder scan_of(const Nodes& nodes) {
    ScanFolder scans;
    PaintedSurface surface;
    surface.mesh.nodes = nodes;
    for (Eigen::Index i = 0; i < nodes.rows(); ++i)
        surface.mesh.nodes.row(i) = in_scan(nodes.row(i).transpose()).transpose();
    surface.mesh.triangles = momo().surface;
    scans.postures["neutral"] = surface;
    scans.files["neutral"] = "head.ply";
    for (const char* name :
         {"nose", "eye_left_outer", "eye_right_outer", "lip_corner_left", "lip_corner_right"}) {
        Eigen::Index nearest = 0;
        (momo().face.rest.rowwise() - generic_landmark(momo(), name).transpose())
            .rowwise()
            .squaredNorm()
            .minCoeff(&nearest);
        scans.landmarks[name] = in_scan(nodes.row(nearest).transpose());
    }
    return scans;
}

}  // namespace viaface

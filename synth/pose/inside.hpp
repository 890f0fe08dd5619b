// What moves inside the mouth: the jaw with its teeth, the lining between the lips and the throat, the
// tongue. Departure from [ATR98], whose face ends at the lips.
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "facemodel/lips.hpp"
#include "viapoints/layout.hpp"

namespace viaface {

// The lower teeth's rigid motion: a turn about an axis along x through the hinge, then a shift, so that the
// lower incisor goes where its point goes.
struct JawMotion {
    Eigen::Vector3d hinge = Eigen::Vector3d::Zero();  // mm
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();  // mm

    Eigen::Vector3d operator()(const Eigen::Vector3d& rest) const {
        return hinge + turn * (rest - hinge) + shift;
    }
};
JawMotion jaw_motion(const Eigen::Vector3d& hinge, const Eigen::Vector3d& incisor_rest,
                     const Eigen::Vector3d& incisor);

// The mouth's lining: rings of 40 nodes from the inner lip contour (ring 0) backwards, and one node in the
// throat.
struct MouthLining {
    static constexpr int kRings = 9, kColumns = LipGrid::kColumns, kNodes = kRings * kColumns + 1;

    static Nodes rest(const Contour& inner);            // [361 x 3], mm
    static std::vector<Triangle> triangles(int first);  // seen from inside the mouth
    static Nodes posed(const Nodes& rest, const Contour& inner, const JawMotion& jaw);
};

// The tongue: sections from the tip to the root, each a closed ring; the tip and the root are closed by a
// node.
struct TongueSweep {
    static constexpr int kSections = 18, kAround = 20, kNodes = kSections * kAround + 2;

    static Nodes rest();  // [kNodes x 3], mm
    static std::vector<Triangle> triangles(int first);
    // points: the tip, body and rear at rest and now; the underside rides on the jaw.
    static Nodes posed(const Nodes& rest, const std::array<Eigen::Vector3d, 3>& points_rest,
                       const std::array<Eigen::Vector3d, 3>& points, const JawMotion& jaw);
};

}  // namespace viaface

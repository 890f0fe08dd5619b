#include "lipmodel/lip_thickness.hpp"

#include <algorithm>

namespace viaface {
namespace {

// 1 mm at the middle of the border and on the skin beyond it, none at the inner edge and the corners.
Eigen::VectorXd thicker(bool upper) {
    Eigen::VectorXd moved = Eigen::VectorXd::Zero(LipMesh::kFreedoms);
    for (int ring = 0; ring < LipMesh::kInnerRing; ++ring) {
        const double share = std::min(1.0, static_cast<double>(LipMesh::kInnerRing - ring) /
                                               (LipMesh::kInnerRing - LipMesh::kBorderRing));
        for (int i = -LipMesh::kLeftCorner; i <= LipMesh::kLeftCorner; ++i) {
            const double t = static_cast<double>(i) / LipMesh::kLeftCorner;
            const int column = upper ? i : LipMesh::kBottom - i;
            moved[3 * LipMesh::node(ring, column) + 1] = (upper ? 1 : -1) * share * (1 - t * t);
        }
    }
    return moved;
}

}  // namespace

LipModel with_thickness(const LipModel& model, double sd_mm) {
    LipModel made = model;
    for (const bool upper : {true, false}) {
        const Eigen::VectorXd shape = thicker(upper);
        const Eigen::VectorXd apart = shape - made.modes * (made.modes.transpose() * shape);
        const Eigen::Index last = made.modes.cols();
        made.modes.conservativeResize(Eigen::NoChange, last + 1);
        made.modes.col(last) = apart.normalized();
        made.variance.conservativeResize(last + 1);
        made.variance[last] = sd_mm * sd_mm * shape.squaredNorm();
    }
    return made;
}

}  // namespace viaface

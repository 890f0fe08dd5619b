// A scanned face on the generic mesh. [ATR98, "Face and lip mesh adaptation", Figure 3]
// Nodes on feature contours go to the same steps along the scan's contours, the markers' nodes to the scan's
// markers, the others by field morphing between them in the unrolled plane; then all onto the scanned
// surface. Departure: where morphing folds a polygon over, its free nodes are relaxed until none is.
#pragma once

#include "facemodel/generic_mesh.hpp"

namespace viaface {

struct AdaptedFace {
    Nodes nodes;       // [576 x 3], mm, head frame, on the scanned surface
    Flat flat;         // [576 x 2], mm: the same, unrolled
    int unfolded = 0;  // nodes that had to be relaxed
};

// std::runtime_error naming the node when the scan has no surface near it or a polygon stays folded.
AdaptedFace adapt(const GenericMesh& mesh, const FeaturePoints& features, const RangeMap& scan);

// How far the fitted mesh lies from the scan: the distance in space from scan samples within the mesh's
// outline and outside its holes (every `stride`-th column and row) to the mesh's nearest triangle.
struct FitSample {
    Eigen::Vector3d place;  // on the scan, mm, head frame
    double distance;        // mm
};
std::vector<FitSample> fit_samples(const GenericMesh& mesh, const AdaptedFace& face, const RangeMap& scan,
                                   int stride = 3);

// [3 x 576]: x y z of node 0 first, as the columns of F (eq. 1).
Eigen::VectorXd as_shape(const Nodes& nodes);
Nodes as_nodes(const Eigen::VectorXd& shape);
// The markers' rows of a shape (eq. 9): [3 x 18].
Eigen::VectorXd marker_positions(const GenericMesh& mesh, const Eigen::VectorXd& shape);

}  // namespace viaface

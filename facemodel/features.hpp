// Feature contours of a face in the unrolled plane of a cylinder: eyes, nose, jaw line, outer lip contour and
// a line over the forehead that closes the mesh. [ATR98, "Face and lip mesh adaptation", Figure 3b] A contour
// is a Catmull-Rom curve through named feature points; the nodes of the generic mesh that lie on it are the
// same in every scan: so many steps to each span.
#pragma once

#include <string>
#include <vector>

#include "facemodel/cylinder.hpp"

namespace viaface {

// Feature points [91 x 2], mm: the 68 landmarks of the usual annotation, then the 18 markers in the order of
// the marker layout, then five places over the forehead.
inline constexpr int kLandmarks = 68, kMarkers = 18, kFirstMarker = 68, kFirstForehead = 86, kForehead = 5;
inline constexpr int kFeaturePoints = kFirstForehead + kForehead;
using FeaturePoints = Eigen::Matrix<double, kFeaturePoints, 2, Eigen::RowMajor>;

// The forehead's places are not seen on a scan: they lie on a half ellipse over the ends of the jaw line.
void place_forehead(FeaturePoints& points);

// From positions in the head frame: landmarks [68 x 3], markers [18 x 3], mm.
FeaturePoints unrolled_features(const Cylinder& cylinder, const Nodes& landmarks, const Nodes& markers);

// The proportions of the generic mesh: an average face in round figures, the same left and right.
FeaturePoints generic_features();

struct FeatureContour {
    std::string name;
    std::vector<int> through;  // feature points
    std::vector<int> steps;    // nodes per span; a closed contour has as many spans as points
    bool closed = false;
};
// Those that bound the mesh come first: the outline (jaw line and forehead), mouth, eyes; then the nose.
const std::vector<FeatureContour>& feature_contours();
inline constexpr int kBoundaries = 4, kOutline = 0, kMouthContour = 1;

// The nodes on a contour, in order; feature points among them are exact. [steps x 2]; one more when open.
Flat contour_nodes(const FeatureContour& contour, const FeaturePoints& points);

}  // namespace viaface

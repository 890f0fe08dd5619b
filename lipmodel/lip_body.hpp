// The lips of one talker as an elastic body at rest, and how the sixteen marked points move it.
// [Basu98, sections 2.1 and 4.1]: the physics of the generic shape take the mesh to a frame with the lips at
// rest; there they are linearised again. Departure: the generic mesh is first laid over the points by a shift
// and three scales, so that the physics have only the difference to make up.
#pragma once

#include "lipmodel/lip_mesh.hpp"

namespace viaface {

struct LipBody {
    LipMesh mesh;            // at rest
    Eigen::MatrixXd spread;  // S [612 x 48], eqs. 2-4: displacement of all nodes out of that of the points
};

// rest: the marked points with closed lips, mm. std::runtime_error when they do not look like a mouth: no
// extent, or the mesh folds over itself.
LipBody lip_body(const MarkedPoints& rest);

// Among frames [48 x frames] of finite points: the one nearest to the mean of those whose lips are least
// open (a tenth of them). std::invalid_argument without frames.
Eigen::Index rest_frame(const Eigen::MatrixXd& frames);

double lip_opening(const MarkedPoints& points);  // mean distance of the inner edges, three pairs, mm

}  // namespace viaface

// The generic head that is adapted to a scan: a talker's face at rest as one welded surface, with the
// features that a scan's are matched with.
#pragma once

#include <array>
#include <filesystem>

#include "facemodel/face.hpp"
#include "synth/pose/training.hpp"
#include "synth/scans/painted_surface.hpp"

namespace viaface {

using NodeLoop = std::vector<int>;  // nodes of Face::rest, in order

struct GenericHead {
    Face face;
    PoseTraining training;
    std::vector<Triangle> surface;      // skin, back of the head and lips; welded nodes of face.rest
    std::array<NodeLoop, 2> lids;       // round the left and the right eye
    NodeLoop lip_border;                // 40, as LipGrid's row 0, welded to the skin
    NodeLoop lip_inner;                 // 40, LipGrid's last row
    std::vector<PaintedSurface> drawn;  // skin, lips and eyes with their textures

    // Where the face is: 1 within, falling to 0 towards ears, hair and throat. [nodes]
    Eigen::VectorXd face_share() const;
    // Skin and lips in the k-th posture of the training; the rest as at rest. [nodes of the face x 3]
    Nodes posture(Eigen::Index k) const;
};

Eigen::Vector3d middle_of(const Nodes& nodes, const NodeLoop& loop);

// `nodes` with the generic eyes moved and sized with the lids' openings.
Nodes eyes_seated(const GenericHead& generic, Nodes nodes);
// How much larger the opening of the lids is than the generic one, and their middles there and here.
struct LidSeat {
    double size = 1;
    Eigen::RowVector3d from, to;  // mm
};
LidSeat lid_seat(const GenericHead& generic, const Nodes& nodes, std::size_t side);

GenericHead generic_head(const std::filesystem::path& talker);

}  // namespace viaface

// A talker out of a fitted head and a talker who speaks already: what the scans do not show of modes and
// named shapes, and teeth, tongue, eyes, lashes and the codex are borrowed.
//  - Skin and lips: every posture and every named shape of the lender by deformation transfer
//    (deformation_transfer.hpp), so that they fit the new face; modes are then its own components.
//  - Postures that were scanned take the place of the lender's of that name (synth/training/postures.hpp) or
//    are added; a scanned named shape takes the lender's place, and its share in every posture that it is
//    mixed into.
//  - Eyes: the lender's, moved and sized with the lids' openings; lashes with the lids' edges; teeth and
//  tongue
//    stand behind the lips as the lender's do.
//  - Points: read off the new face at the seats they have on the lender's.
//  - Codex: p(t) = rest + S (p_lender(t) - rest_lender), S = diag(sx, sy, sz) the least-squares ratio of the
//    points' ways in the transferred postures to their ways in the lender's.
#pragma once

#include "synth/scans/generic_head.hpp"
#include "synth/scans/own_postures.hpp"
#include "viapoints/codex.hpp"

namespace viaface {

struct BorrowedTalker {
    Face face;  // no textures
    PoseTraining training;
    Codex codex;
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();  // face = size * (nodes + shift)
    double size = 1;
    Eigen::Vector3d motion_scale = Eigen::Vector3d::Ones();  // S
    std::vector<std::string> own;                            // postures and shapes that are the scans'
};

// nodes: of skin, back and lips, in the lender's head frame and millimetres [nodes of the face x 3]; size:
// true millimetres to one of these.
BorrowedTalker with_borrowed_motion(const GenericHead& lender, const Codex& codex, Nodes nodes, double size,
                                    const std::vector<OwnPosture>& own = {});

}  // namespace viaface

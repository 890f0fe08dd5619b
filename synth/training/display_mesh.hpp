// The talker's display mesh: about 4,000 nodes of our own topology on the blend-shape head's surface, sampled
// densely round the mouth and the eyes. [ATR98, "Face and lip mesh adaptation"]
#pragma once

#include <array>
#include <vector>

#include "facemodel/lips.hpp"
#include "facemodel/remesh.hpp"
#include "synth/training/blend_head.hpp"

namespace viaface {

// Where the nodes of the display mesh sit on the scan; every posed scan gives them anew.
struct DisplayAnchors {
    std::vector<Anchor> front;  // the face's chart: first the ring shared with the back, then the lid
                                // margins, the lips' border, the rest
    std::vector<Anchor> back;   // the back of the head and the shoulders; first the shared ring again
    int ring = 0;               // nodes of the shared ring
    int lid_first[2] = {0, 0}, lid_nodes = 0;  // left, right eye: the margin's loop in `front`
    int border_first = 0;                      // 40 nodes in `front`: the lips' outer contour
    std::vector<Triangle> front_triangles, back_triangles;
    std::vector<Vector2d> front_places, back_places;  // in the unit discs of the charts
    std::vector<Anchor> lip_middle, lip_inner;        // 40 each
    // Where lashes grow, nose to temple: upper and lower lid of the left eye, then of the right.
    std::array<std::vector<Anchor>, 4> lash_roots;
};

DisplayAnchors remesh_head(const BlendHead& head);

// The three contours of the lips on a posed scan.
LipContours lip_contours(const DisplayAnchors& anchors, const Nodes& scan);

}  // namespace viaface

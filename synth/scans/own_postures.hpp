// Postures that were scanned beside the neutral one, on the generic head's nodes: they give a talker modes of
// its own. [ATR98, "Static face scans"]
//  - The brow is laid on the neutral one's first: what the head moved between two scans is no expression.
//  - A scan with the neutral one's triangles, node by node, carries every fitted node along with its place on
//    them.
//  - To another one the nearest of the lender's postures, on the fitted head, is pulled as the neutral head
//  was.
// What no scan shows (the lips' inside, ears that are not there) goes on smoothly.
#pragma once

#include <string>
#include <vector>

#include "synth/scans/adaptation_to_scan.hpp"

namespace viaface {

struct OwnPosture {
    std::string name;
    Nodes nodes;  // [nodes of the face x 3]: skin, back and lips, in the frame of AdaptedHead::nodes
};

// Those of `scans` but "neutral", sorted by name; says what became of each. A posture that is not this head's
// is left out.
std::vector<OwnPosture> own_postures(const GenericHead& generic, const ScanFolder& scans,
                                     const AdaptedHead& head, std::vector<std::string>& remarks);

}  // namespace viaface

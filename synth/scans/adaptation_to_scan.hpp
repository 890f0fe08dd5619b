// The generic head on a scan. [ATR98, "Face and lip mesh adaptation"]
//  1. The face is found (face_finder.hpp), the generic head aligned with it (iterated closest points).
//  2. Feature contours of eyes and lips are found in a front view (contour_search.hpp), or given.
//  3. Field morphing [BeierNeely92] in the unrolled plane of the scan's cylinder carries the generic contours
//  to
//     them, and all nodes with them.
//  4. Nodes are pulled to the surface, smoothly (smooth_fit.hpp); where there is no scan the generic head
//     goes on smoothly.
#pragma once

#include <string>
#include <vector>

#include "synth/scans/face_finder.hpp"
#include "synth/scans/generic_head.hpp"
#include "synth/scans/scan_folder.hpp"
#include "synth/scans/similarity.hpp"

namespace viaface {

inline constexpr double kSmile = 2;  // mm: corners that stand so much higher make a smile

struct FitDistances {
    double mean = 0, p95 = 0, largest = 0;  // mm
    std::size_t samples = 0;
};

struct AdaptedHead {
    PaintedSurface scan;        // carried to the generic head's frame, in millimetres of the generic head
    Similarity from_scan;       // what carried it
    double mm_per_generic = 1;  // true millimetres to one of the generic head; 1 where the unit is unknown
    std::string unit;           // "m", "cm", "mm", "inch", or empty: unknown
    Nodes nodes;                // [nodes of the face x 3]: skin, back and lips fitted; the rest generic
    std::vector<bool> covered;  // [nodes]: held by the scan
    int flipped = 0;            // triangles that face away from the scan or fold over, within the face
    FitDistances to_scan,
        from_surface;  // true mm: drawn surface to scan, scan to drawn surface, within the face
    FitDistances lips_to_scan, lips_from_surface;  // within 6 mm of the lips
    std::vector<std::string> remarks;
    std::vector<std::string> completed;  // parts of the head that the scan lacks
    double smile = 0;                    // mm: how far the lips' corners stand above their generic place
};

// Triangles that faced inwards face outwards.
void turn_round(ScanMesh& mesh);

// Left and right exchanged where `scans` says that they are: along the axis stated to be theirs, or any.
ScanFolder mirrored_back(ScanFolder scans);

// InputError("scans", ...) when no face, or more than one, is found, or a stated unit cannot be.
AdaptedHead adapt_head(const GenericHead& generic, const ScanFolder& scans);

}  // namespace viaface

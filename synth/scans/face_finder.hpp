// Finds the face in a scan of unknown axes and unit: the scan is drawn from the 24 ways in which axes may
// stand and, upright along each, along its mean normal (a sector of a face looks out of it), a cascade of
// boosted features looks for a frontal face in each picture, and the firmest detections are tried.
// [ViolaJones01], the cascades of OpenCV (frontalface_alt2, eye) as Debian packs them. The same detector
// looks at the generic head; from the two boxes follow turn, scale and shift, so that what the detector
// favours cancels out.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "synth/scans/painted_surface.hpp"

namespace viaface {

struct FaceBox {
    double x = 0, y = 0, side = 0;  // middle and side, in the unit of the surface as it was turned
    double front = 0;               // median z within the middle of the box
    int votes = 0;                  // of the detector
    int eyes = 0;                   // found in its upper part
};

struct FoundFace {
    Eigen::Matrix3d view_from_scan = Eigen::Matrix3d::Identity();
    FaceBox box;
    std::vector<FaceBox> others;  // beside it in the same picture, with at least half its votes
};

// In a view along -z as the nodes stand; none where no face is seen.
std::vector<FaceBox> frontal_faces(std::span<const PaintedSurface* const> surfaces);

// axes: the turn where it is known. The firmest first, at most ten; the shape has to decide between them.
std::vector<FoundFace> find_faces(const PaintedSurface& scan, const std::optional<Eigen::Matrix3d>& axes);

// The middle of the eye that the detector sees nearest to `about`, within 15 mm, in a view in mm.
std::optional<Eigen::Vector2d> eye_near(const SurfaceView& view, const Eigen::Vector2d& about);

}  // namespace viaface

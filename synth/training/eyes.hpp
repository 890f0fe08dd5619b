// Procedural eyes and lashes. An eye is a sphere with a cornea's bulge; its texture place is
// 0.5 + a / (2 pi) (cos b, sin b), with a the angle from straight ahead and b round the axis from the
// temple's side up, so that the iris is a disc in the middle and both eyes share one picture. Lashes are
// strips that stand on the lids: u along the lid, v from the root (0) to the tip (1).
#pragma once

#include "synth/pose/eye_ball.hpp"
#include "synth/training/part_mesh.hpp"

namespace viaface {

PartMesh eye(double side, const EyeBall& ball);

// roots: the lid's upper or lower edge, nose to temple; the strip leaves the eyeball and curls up or down.
Nodes lash_strip(const Nodes& roots, const EyeBall& ball, bool upper);
PartMesh lashes(std::string name, const Nodes& strip, int roots, bool upper, bool mirrored);

}  // namespace viaface

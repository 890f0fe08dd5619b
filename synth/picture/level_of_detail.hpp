// Level of detail: a face's triangles, as few as a picture of its size needs. Nodes are taken out one by one,
// each into a neighbour (half-edge collapses: H. Hoppe, "Progressive meshes", SIGGRAPH 1996), as long as the
// texture stays where it was (texture deviation: J. Cohen, M. Olano, D. Manocha, "Appearance-preserving
// simplification", SIGGRAPH 1998): a node that was taken out lies near the point of the drawn triangles that
// has its texture coordinates. Departures: this is asked of the nodes alone; not at rest alone, but also of
// the ways that modes and shapes make; and of the normals, by which the face is shaded.
#pragma once

#include <vector>

#include "facemodel/face.hpp"
#include "synth/picture/work_pool.hpp"

namespace viaface {

// How far a node that was taken out may be off what is drawn there.
struct Coarseness {
    double way;   // mm: its place at rest; its way by all modes at three standard deviations; by each shape
    double bend;  // its unit normal at rest
};
Coarseness coarseness_for(double pixel);  // mm

// The parts of the face with fewer triangles, whose corners are some of the same nodes. Nodes at the edges of
// parts and at seams stay, and with them the contours of the lips; so does the tongue, whose bends are in no
// mode.
std::vector<FacePart> coarser_parts(const Face& face, const Coarseness& most, WorkPool& pool);

}  // namespace viaface

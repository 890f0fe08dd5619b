// How far a fitted head lies from its scan, both ways, within the face.
#pragma once

#include "synth/scans/adaptation_to_scan.hpp"

namespace viaface {

FitDistances distances_of(std::vector<double> values);

// Triangles within the face that are turned over: their normal is more than 90 degrees from the generic
// one's.
std::vector<Triangle> turned_triangles(const GenericHead& generic, const Nodes& nodes);

// Which nodes of a surface lie open to a viewer in front, or at 45 degrees to any side.
std::vector<bool> seen_nodes(const Nodes& nodes, const std::vector<Triangle>& triangles);

// Fills the distances and the count of flipped triangles. From the drawn surface: its triangles' middles and
// nodes that are seen; from the scan: its nodes that are
// seen from in front or from within 45 degrees of it, to the drawn surface with its eyes. What lies over a
// hole or beyond the edge of the other surface (the lips' inside, the end of the scan) has no distance.
void measure_fit(const GenericHead& generic, const NearestSurface& scan, AdaptedHead& head);

}  // namespace viaface

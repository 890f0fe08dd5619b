// The lip mesh from three contours of 40 nodes, and what stops lips: each other and the teeth.
// [ATR98, "Face and lip mesh adaptation"]: a cubic spline through the triplet of control points across each
// column. Departure: contact. The report's lips pass through each other.
#pragma once

#include <array>
#include <vector>

#include "facemodel/face.hpp"
#include "facemodel/mesh.hpp"

namespace viaface {

// [40 x 3], mm, head frame; column 0 at the middle of the upper lip, then towards the talker's left and
// round.
using Contour = Eigen::Matrix<double, LipGrid::kColumns, 3, Eigen::RowMajor>;

struct LipContours {
    Contour outer, middle, inner;
};

inline constexpr int kLeftCorner = LipGrid::kColumns / 4, kRightCorner = 3 * LipGrid::kColumns / 4;

// The column of the other lip that meets this one; corners meet themselves.
constexpr int facing_column(int column) { return (3 * LipGrid::kColumns / 2 - column) % LipGrid::kColumns; }
constexpr bool upper_lip(int column) { return column < kLeftCorner || column > kRightCorner; }

// Natural cubic splines across, parametrised by chord, at equal steps on either side of the middle. [600 x 3]
Nodes lip_rows(const LipContours& contours);

std::vector<Triangle> lip_triangles(const LipGrid& grid);

// The front of a row of teeth seen from above: z of the surface at x, and the height of the edges.
struct TeethFront {
    double front_z = 0, curvature = 0;  // z = front_z - curvature x^2, mm and 1/mm
    double edge_y = 0;                  // mm
    double side = 1;                    // +1: the teeth stand above the edge, -1: below
    double thickness = 4;               // mm, front to back at the edge

    double z(double x) const { return front_z - curvature * x * x; }
};

// Moves the lips out of the teeth, whichever way is shorter: in front of them or past their edges.
void keep_off_teeth(Nodes& rows, const TeethFront& teeth);

// Where the lips would cross they meet halfway, and within half a millimetre they cling; what lies outwards
// follows, falling off towards the border.
void keep_lips_apart(Nodes& rows);

// Height of the opening at a column of the upper lip, mm: inner contour to inner contour.
double lip_gap(const Nodes& rows, int column);

}  // namespace viaface

// A cylindrical range map, the form that a laser scanner gives which turns round the head (Cyberware): r over
// angle (columns) and height (rows, the topmost first). The container is a binary 16-bit PGM ("P5", greatest
// value up to 65535, high byte first): r = step * value, 0 is a hole. What PGM has no place for stands in
// scans.json: see RangeLayout. The colour map is any picture with the same layout.
// [ATR98, "Static face scans": "converted from cylindrical (r, theta) to Cartesian 3D"]
#pragma once

#include <span>

#include "facemodel/scan_mesh.hpp"

namespace viaface {

struct RangePicture {
    int columns = 0, rows = 0;
    std::vector<std::uint16_t> values;  // [rows x columns], the topmost row first
};

inline constexpr int kLargestRangeSide = 8192;

// InputError("scan", ...) naming what is wrong.
RangePicture parse_pgm(std::span<const std::uint8_t> bytes);

struct RangeLayout {
    double step = 0;                                // unit of r per unit of value
    double angle_from_deg = 0, angle_to_deg = 360;  // of the first column's and past the last one's left
                                                    // edge; x = r sin(angle), z = r cos(angle)
    double bottom = 0, top = 0;                     // lower edge of the lowest row, upper of the topmost
    double largest_jump = 0.1;                      // of r, between neighbours: beyond it the surface is torn
};

// Triangles between samples that are there. A map of the full turn is closed.
ScanMesh range_surface(const RangePicture& picture, const RangeLayout& layout);

}  // namespace viaface

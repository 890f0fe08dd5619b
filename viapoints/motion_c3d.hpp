// Motion in the C3D format (c3d.org, The C3D File Format User Guide): blocks of 512 bytes; a header that
// points to the parameters and to the data; parameters (c3d_parameters.hpp); frames of points, each followed
// by its analog samples, which are skipped.
//
// Read are files of the three processors (c3d_bytes.hpp), points as integers times POINT:SCALE (positive) or
// as floats (negative). A point's fourth word is its residual (low byte, times |POINT:SCALE|) and a mask of
// cameras; below 0 the point was not measured. The number of frames is POINT:FRAMES (as words or as a float);
// where that has run over, POINT:LONG_FRAMES or TRIAL:ACTUAL_START_FIELD and ACTUAL_END_FIELD; without it the
// header's. Labels beyond 255 stand in POINT:LABELS2 and so on; points without a label are called "point 7".
// Frame k is at k / POINT:RATE seconds.
//
// Where header and parameters contradict each other about the layout of the data, the file is refused; where
// they do about its start, the header's holds unless it lies in front of the parameters' end, and a remark is
// made.
//
// Written are Intel files with points as floats in mm. Times must be even, to a tenth of a step.
#pragma once

#include <span>
#include <string>

#include "base/bytes.hpp"
#include "viapoints/point_recording.hpp"

namespace viaface {

bool is_c3d(std::span<const std::uint8_t> bytes);

// unit: what holds where the file names none; empty: such a file is refused. InputError(field, ...) with the
// place of what is wrong.
PointRecording parse_c3d(std::span<const std::uint8_t> bytes, const std::string& field = "motion",
                         const std::string& unit = "");

// InputError("motion", ...) for uneven times; std::invalid_argument for shapes that disagree.
Bytes format_c3d(const PointRecording& recording);

}  // namespace viaface

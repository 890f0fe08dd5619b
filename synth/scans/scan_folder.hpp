// A folder of scans that nobody prepared. With scans.json:
//   {"postures": {"neutral": "face.ply", "a": "a.ply", ...},  names of files; one has to be "neutral"
//    "units": "m" | "cm" | "mm" | "inch" | millimetres to the unit,
//    "axes": {"up": "+y", "forward": "-z"},
//    "mirrored": true,                                       left and right are exchanged
//    "colour": "face.png",
//    "landmarks": {"nose": [x, y, z], ...},                  names of generic_landmarks(), the file's units
//    "cylinder": {"step": 0.1, "angle_from_deg": 0, "angle_to_deg": 360, "bottom": 0, "top": 300}}  of .pgm
// Everything may be left out. Without it the finest mesh is the one neutral posture, and its colour map is
// the picture that its file names, else the one that shows most skin at the mesh's texture places; a normal
// map is known by its colours being unit vectors, most of them straight out, and left.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "synth/scans/painted_surface.hpp"

namespace viaface {

struct ScanFolder {
    std::map<std::string, PaintedSurface> postures;  // "neutral" and others
    std::map<std::string, std::string> files;        // posture -> file
    double mm_per_unit = 0;                          // 0: not stated
    std::optional<Eigen::Matrix3d> view_from_scan;   // x left, y up, z forward; where axes are stated
    bool mirrored = false;
    std::map<std::string, Eigen::Vector3d> landmarks;  // the file's units
    std::vector<std::string> remarks;                  // what was decided and repaired, for the reader
};

// InputError("scans", ...) naming file and value.
ScanFolder read_scan_folder(const std::filesystem::path& folder);

// Share of pixels that are unit vectors as a normal map keeps them, near 1 for a normal map.
double normal_map_share(const Texture& picture);
// Share of the mesh's texture places at which the picture has the hue of skin.
double skin_share(const ScanMesh& mesh, const Texture& picture);

// One surface out of what a file holds: scraps left out, inside-out triangles turned round, too many nodes
// thinned; says what it did. InputError for what is no surface.
ScanMesh mended(ScanMesh mesh, std::vector<std::string>& remarks);

}  // namespace viaface

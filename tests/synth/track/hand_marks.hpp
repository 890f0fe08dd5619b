// Lips marked by hand in single frames of clips, and how far tracked contours lie from them.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "lipmodel/lip_tracker.hpp"

namespace viaface::test {

struct Mark {
    std::string point;
    Eigen::RowVector2d place;  // px

    bool inside() const { return point.starts_with("inner") || point == "seam"; }
};
using FrameMarks = std::map<int, std::vector<Mark>>;  // by frame
using ClipMarks = std::map<std::string, FrameMarks>;  // by clip

inline ClipMarks read_marks(const std::filesystem::path& file) {
    std::ifstream in(file);
    ClipMarks marks;
    for (std::string line; std::getline(in, line);) {
        if (line.empty() || line.front() == '#' || line.starts_with("clip,")) continue;
        std::ranges::replace(line, ',', ' ');
        std::istringstream cells(line);
        std::string clip;
        int frame = 0;
        Mark mark;
        if (!(cells >> clip >> frame >> mark.point >> mark.place.x() >> mark.place.y()))
            throw std::runtime_error(file.string() + ": " + line);
        marks[clip][frame].push_back(mark);
    }
    return marks;
}

inline double from_segment(const Eigen::RowVector2d& p, const Eigen::RowVector2d& a,
                           const Eigen::RowVector2d& b) {
    const Eigen::RowVector2d way = b - a;
    const double along = way.squaredNorm() > 0 ? (p - a).dot(way) / way.squaredNorm() : 0;
    return (p - a - std::clamp(along, 0.0, 1.0) * way).norm();
}

// px from the tracked border, or from the tracked inner edge.
inline double contour_error(const Mark& mark, const Pixels& lips) {
    const int ring = mark.inside() ? LipMesh::kInnerRing : LipMesh::kBorderRing;
    double least = 1e9;
    for (int column = 0; column < LipMesh::kColumns; ++column) {
        least = std::min(least, from_segment(mark.place, lips.row(LipMesh::node(ring, column)),
                                             lips.row(LipMesh::node(ring, column + 1))));
    }
    return least;
}

inline double median(std::vector<double> values) {
    if (values.empty()) return NAN;
    std::ranges::sort(values);
    return values[values.size() / 2];
}

// Frames of words that hold p, b or m, as far as a GRID alignment tells them: 1/25000 s, 25 frames a second.
struct Bilabial {
    std::string word;
    int first = 0, last = 0;  // frames
};
inline std::vector<Bilabial> bilabials(const std::filesystem::path& alignment) {
    static const std::vector<std::string> kWords = {"bin", "blue", "by", "place", "please", "b", "p", "m"};
    std::ifstream in(alignment);
    std::vector<Bilabial> found;
    double from = 0, to = 0;
    for (std::string word; in >> from >> to >> word;) {
        if (std::ranges::find(kWords, word) != kWords.end())
            found.push_back({word, static_cast<int>(from / 1000) - 1, static_cast<int>(to / 1000) + 1});
    }
    return found;
}

}  // namespace viaface::test

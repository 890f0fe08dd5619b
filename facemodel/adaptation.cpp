#include "facemodel/adaptation.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "facemodel/field_morph.hpp"
#include "facemodel/triangulation.hpp"

namespace viaface {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

// Lines that only guide the morph: the brows, and between markers that no contour joins.
constexpr int M = kFirstMarker;
constexpr std::array<int, 2> kGuides[] = {
    {17, 18},         {18, 19},         {19, 20},         {20, 21},        {22, 23},
    {23, 24},         {24, 25},         {25, 26},         {M + 10, M + 8}, {M + 8, M + 9},
    {M + 13, M + 15}, {M + 14, M + 16}, {M + 13, M + 11}, {M + 14, M + 12}};

std::vector<MorphLine> lines_of(const FeaturePoints& features) {
    std::vector<MorphLine> lines;
    for (const FeatureContour& contour : feature_contours()) {
        const Flat nodes = contour_nodes(contour, features);
        const Eigen::Index n = nodes.rows();
        for (Eigen::Index i = 0; i < (contour.closed ? n : n - 1); ++i) {
            lines.push_back({nodes.row(i), nodes.row((i + 1) % n)});
        }
    }
    for (const auto& [from, to] : kGuides) lines.push_back({features.row(from), features.row(to)});
    return lines;
}

// Contour and marker nodes in place; returns which nodes are bound so.
std::vector<bool> bind(const GenericMesh& mesh, const FeaturePoints& features, Flat& flat) {
    std::vector<bool> bound(static_cast<std::size_t>(flat.rows()), false);
    for (std::size_t c = 0; c < mesh.contours.size(); ++c) {
        const Flat nodes = contour_nodes(feature_contours()[c], features);
        for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
            flat.row(mesh.contours[c][i]) = nodes.row(i);
            bound[mesh.contours[c][i]] = true;
        }
    }
    for (int i = 0; i < kMarkers; ++i) {
        flat.row(mesh.markers[i]) = features.row(kFirstMarker + i);
        bound[mesh.markers[i]] = true;
    }
    return bound;
}

std::vector<std::vector<int>> neighbours_of(const std::vector<Triangle>& triangles, Eigen::Index nodes) {
    std::vector<std::vector<int>> found(static_cast<std::size_t>(nodes));
    for (const Triangle& t : triangles) {
        for (int k = 0; k < 3; ++k) {
            for (const int other : {t[(k + 1) % 3], t[(k + 2) % 3]}) {
                auto& list = found[t[k]];
                if (std::ranges::find(list, other) == list.end()) list.push_back(other);
            }
        }
    }
    return found;
}

std::vector<bool> folded_nodes(const std::vector<Triangle>& triangles, const Flat& flat) {
    std::vector<bool> folded(static_cast<std::size_t>(flat.rows()), false);
    for (const Triangle& t : triangles) {
        if (turn(flat.row(t[0]), flat.row(t[1]), flat.row(t[2])) > 0) continue;
        for (const int i : t) folded[i] = true;
    }
    return folded;
}

// Moves free nodes of folded triangles, and after a while those round them, to the middle of their
// neighbours.
int relax_folds(const GenericMesh& mesh, const std::vector<bool>& bound, Flat& flat) {
    constexpr int kRounds = 200;
    const std::vector<Triangle> triangles = triangles_of(mesh.polygons);
    const auto neighbours = neighbours_of(triangles, flat.rows());
    std::vector<bool> moved(static_cast<std::size_t>(flat.rows()), false);
    for (int round = 0; round < kRounds; ++round) {
        std::vector<bool> folded = folded_nodes(triangles, flat);
        if (std::ranges::none_of(folded, [](bool f) { return f; })) break;
        for (std::size_t i = 0; i < moved.size(); ++i) {
            if (folded[i]) moved[i] = true;
            if (folded[i] && round % 10 == 9) {
                for (const int other : neighbours[i]) moved[other] = true;
            }
        }
        for (std::size_t i = 0; i < moved.size(); ++i) {
            if (!moved[i] || bound[i]) continue;
            Eigen::RowVector2d sum(0, 0);
            for (const int other : neighbours[i]) sum += flat.row(other);
            flat.row(i) = sum / static_cast<double>(neighbours[i].size());
        }
    }
    int count = 0;
    for (std::size_t i = 0; i < moved.size(); ++i) count += moved[i] && !bound[i];
    return count;
}

// The nearest place to p on a triangle. [Ericson 2005, section 5.1.5]
Vector3d nearest_on(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& p) {
    const Vector3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp),
                 d6 = ac.dot(cp);
    if (d1 <= 0 && d2 <= 0) return a;
    if (d3 >= 0 && d4 <= d3) return b;
    if (d6 >= 0 && d5 <= d6) return c;
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
    if (va <= 0 && d4 >= d3 && d5 >= d6) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
    const double sum = va + vb + vc;
    return a + vb / sum * ab + vc / sum * ac;
}

struct Solid {
    Vector3d a, b, c, centre;
    double radius;
    Vector2d fa, fb, fc;
    bool covers(const Vector2d& p) const {
        return turn(fa, fb, p) >= 0 && turn(fb, fc, p) >= 0 && turn(fc, fa, p) >= 0;
    }
};

std::vector<Solid> solids_of(const GenericMesh& mesh, const AdaptedFace& face) {
    std::vector<Solid> solids;
    for (const Triangle& t : triangles_of(mesh.polygons)) {
        Solid s{face.nodes.row(t[0]), face.nodes.row(t[1]), face.nodes.row(t[2]), {}, 0,
                face.flat.row(t[0]),  face.flat.row(t[1]),  face.flat.row(t[2])};
        s.centre = (s.a + s.b + s.c) / 3;
        s.radius = std::max({(s.a - s.centre).norm(), (s.b - s.centre).norm(), (s.c - s.centre).norm()});
        solids.push_back(s);
    }
    return solids;
}

double distance_to(const std::vector<Solid>& solids, const Vector3d& p) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Solid& s : solids) {
        const double reach = nearest + s.radius;
        if ((s.centre - p).squaredNorm() > reach * reach) continue;
        nearest = std::min(nearest, (nearest_on(s.a, s.b, s.c, p) - p).norm());
    }
    return nearest;
}

}  // namespace

AdaptedFace adapt(const GenericMesh& mesh, const FeaturePoints& features, const RangeMap& scan) {
    const FieldMorph morph(lines_of(generic_features()), lines_of(features));
    AdaptedFace face;
    face.flat.resize(mesh.flat.rows(), 2);
    for (Eigen::Index i = 0; i < mesh.flat.rows(); ++i) face.flat.row(i) = morph(mesh.flat.row(i));
    face.unfolded = relax_folds(mesh, bind(mesh, features, face.flat), face.flat);
    if (std::ranges::any_of(folded_nodes(triangles_of(mesh.polygons), face.flat), [](bool f) { return f; })) {
        throw std::runtime_error("adapting the generic mesh: a polygon stays folded");
    }
    face.nodes.resize(mesh.flat.rows(), 3);
    for (Eigen::Index i = 0; i < mesh.flat.rows(); ++i) {
        const auto range = scan.range(face.flat.row(i));
        if (!range)
            throw std::runtime_error("adapting the generic mesh: no surface at node " + std::to_string(i));
        face.nodes.row(i) = scan.frame().cylinder.rolled({face.flat(i, 0), face.flat(i, 1), *range});
    }
    return face;
}

std::vector<FitSample> fit_samples(const GenericMesh& mesh, const AdaptedFace& face, const RangeMap& scan,
                                   int stride) {
    const std::vector<Solid> solids = solids_of(mesh, face);
    std::vector<FitSample> samples;
    for (int row = 0; row < scan.frame().rows; row += stride) {
        for (int column = 0; column < scan.frame().columns; column += stride) {
            const auto range = scan.sample(column, row);
            if (!range) continue;
            const Vector2d flat = scan.frame().place(column, row);
            if (std::ranges::none_of(solids, [&](const Solid& s) { return s.covers(flat); })) continue;
            const Vector3d place = scan.frame().cylinder.rolled({flat.x(), flat.y(), *range});
            samples.push_back({place, distance_to(solids, place)});
        }
    }
    return samples;
}

Eigen::VectorXd as_shape(const Nodes& nodes) {
    return Eigen::Map<const Eigen::VectorXd>(nodes.data(), nodes.size());
}

Nodes as_nodes(const Eigen::VectorXd& shape) {
    return Eigen::Map<const Nodes>(shape.data(), shape.size() / 3, 3);
}

Eigen::VectorXd marker_positions(const GenericMesh& mesh, const Eigen::VectorXd& shape) {
    Eigen::VectorXd positions(3 * kMarkers);
    for (int i = 0; i < kMarkers; ++i) positions.segment<3>(3 * i) = shape.segment<3>(3 * mesh.markers[i]);
    return positions;
}

}  // namespace viaface

#include "facemodel/generic_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>

#include "facemodel/triangulation.hpp"

namespace viaface {
namespace {

using Eigen::Vector2d;
using Places = std::vector<Vector2d>;

Places rows_of(const Flat& flat) {
    Places places;
    for (Eigen::Index i = 0; i < flat.rows(); ++i) places.emplace_back(flat.row(i));
    return places;
}

// Even-odd rule.
bool inside(const Places& outline, const Vector2d& p) {
    bool in = false;
    for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
        const Vector2d &a = outline[i], &b = outline[j];
        if ((a.y() > p.y()) != (b.y() > p.y()) &&
            p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x()) {
            in = !in;
        }
    }
    return in;
}

double distance_to(const Places& places, const Vector2d& p) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vector2d& q : places) nearest = std::min(nearest, (q - p).norm());
    return nearest;
}

// The contours' nodes in the generic proportions, and what lies between them.
struct Plan {
    std::vector<Places> contours;

    bool on_mesh(const Vector2d& p) const {
        for (int hole = kOutline + 1; hole < kBoundaries; ++hole) {
            if (inside(contours[hole], p)) return false;
        }
        return inside(contours[kOutline], p);
    }
    // Under the nose's wings the scan steps back by a centimetre within a millimetre: a free node there would
    // jump.
    static bool below_the_wings(const Vector2d& p) {
        return std::abs(p.x()) > 2 && std::abs(p.x()) < 13 && p.y() > 24.5 && p.y() < 35.5;
    }
    // How far apart nodes should lie, up to one factor for all: close by a feature, growing with distance.
    double spacing(const Vector2d& p) const {
        constexpr double kAtFeature = 3.0, kAtOutline = 9.0, kGrowth = 0.3;
        double spacing = kAtOutline + kGrowth * distance_to(contours[kOutline], p);
        for (std::size_t i = kOutline + 1; i < contours.size(); ++i) {
            spacing = std::min(spacing, kAtFeature + kGrowth * distance_to(contours[i], p));
        }
        return spacing;
    }
};

Plan make_plan(const FeaturePoints& features) {
    Plan plan;
    for (const FeatureContour& contour : feature_contours()) {
        plan.contours.push_back(rows_of(contour_nodes(contour, features)));
    }
    return plan;
}

// A place that may become a node, and its mirror image with it.
struct Candidate {
    Vector2d place;
    double spacing;
    double room;  // to the nearest node or to its own mirror image, in spacings
    bool middle() const { return place.x() == 0; }
};

class Filling {
  public:
    Filling(const Plan& plan, const Places& nodes) : nodes_(nodes) {
        constexpr double kStep = 1.5;
        for (double height = -60; height <= 160; height += kStep) {
            for (double u = 0; u <= 130; u += kStep) {
                const Vector2d place(u, height);
                if (!plan.on_mesh(place) || Plan::below_the_wings(place)) continue;
                const double spacing = plan.spacing(place);
                const double mirror = u == 0 ? std::numeric_limits<double>::infinity() : 2 * u;
                candidates_.push_back(
                    {place, spacing, std::min(mirror, distance_to(nodes, place)) / spacing});
            }
        }
    }

    void fill_to(int count) {
        while (static_cast<int>(nodes_.size()) < count) {
            const bool only_one = static_cast<int>(nodes_.size()) + 1 == count;
            add(roomiest(only_one));
        }
    }
    const Places& nodes() const { return nodes_; }

  private:
    Candidate roomiest(bool on_the_middle) const {
        const Candidate* best = nullptr;
        for (const Candidate& c : candidates_) {
            if ((!on_the_middle || c.middle()) && (!best || c.room > best->room)) best = &c;
        }
        if (!best || best->room <= 0) throw std::logic_error("generic mesh: no room for a node");
        return *best;
    }
    void add(const Candidate& chosen) {
        insert(chosen.place);
        if (!chosen.middle()) insert({-chosen.place.x(), chosen.place.y()});
    }
    void insert(const Vector2d& place) {
        nodes_.push_back(place);
        for (Candidate& c : candidates_) c.room = std::min(c.room, (c.place - place).norm() / c.spacing);
    }

    Places nodes_;
    std::vector<Candidate> candidates_;
};

// Contours and markers first; a place that two of them share is one node.
int node_at(Places& nodes, const Vector2d& place) {
    constexpr double kSame = 1e-6;
    const auto found =
        std::ranges::find_if(nodes, [&](const Vector2d& n) { return (n - place).norm() < kSame; });
    if (found != nodes.end()) return static_cast<int>(found - nodes.begin());
    nodes.push_back(place);
    return static_cast<int>(nodes.size()) - 1;
}

Places place_features(GenericMesh& mesh, const Plan& plan, const FeaturePoints& features) {
    Places nodes;
    for (const Places& contour : plan.contours) {
        mesh.contours.emplace_back();
        for (const Vector2d& place : contour) mesh.contours.back().push_back(node_at(nodes, place));
    }
    for (int i = 0; i < kMarkers; ++i) mesh.markers[i] = node_at(nodes, features.row(kFirstMarker + i));
    return nodes;
}

// A pair of triangles over a common edge, as a quad cut from corner 0 to 2.
struct Pair {
    int first, second;  // triangles
    Polygon quad;
    double worst;  // how far its worst angle is from a right one, radians
};

double worst_angle(const Flat& flat, const Polygon& quad) {
    double worst = 0;
    for (int k = 0; k < 4; ++k) {
        const Vector2d before = flat.row(quad[(k + 3) % 4]) - flat.row(quad[k]);
        const Vector2d after = flat.row(quad[(k + 1) % 4]) - flat.row(quad[k]);
        const double angle = std::atan2(after.x() * before.y() - after.y() * before.x(), after.dot(before));
        worst = std::max(worst, std::abs(angle - std::numbers::pi / 2));
    }
    return worst;
}

std::vector<Pair> pairs_of(const Flat& flat, const std::vector<Triangle>& triangles) {
    std::map<std::array<int, 2>, std::array<int, 2>>
        half_edges;  // directed edge -> triangle, corner opposite
    for (int t = 0; t < static_cast<int>(triangles.size()); ++t) {
        for (int k = 0; k < 3; ++k) {
            half_edges[{triangles[t][k], triangles[t][(k + 1) % 3]}] = {t, triangles[t][(k + 2) % 3]};
        }
    }
    std::vector<Pair> pairs;
    for (const auto& [edge, side] : half_edges) {
        const auto other = half_edges.find({edge[1], edge[0]});
        if (edge[0] > edge[1] || other == half_edges.end()) continue;
        const Polygon quad{edge[0], other->second[1], edge[1], side[1]};
        pairs.push_back({side[0], other->second[0], quad, worst_angle(flat, quad)});
    }
    return pairs;
}

std::vector<Polygon> merged(const Flat& flat, const std::vector<Triangle>& triangles, int polygons) {
    std::vector<Pair> pairs = pairs_of(flat, triangles);
    std::ranges::stable_sort(pairs, {}, &Pair::worst);
    std::vector<bool> used(triangles.size(), false);
    std::vector<Polygon> made;
    for (const Pair& pair : pairs) {
        if (triangles.size() - made.size() == static_cast<std::size_t>(polygons)) break;
        if (used[pair.first] || used[pair.second]) continue;
        used[pair.first] = used[pair.second] = true;
        made.push_back(pair.quad);
    }
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        if (!used[t]) made.push_back({triangles[t][0], triangles[t][1], triangles[t][2], -1});
    }
    return made;
}

}  // namespace

std::vector<Triangle> triangles_of(const std::vector<Polygon>& polygons) {
    std::vector<Triangle> triangles;
    for (const Polygon& p : polygons) {
        triangles.push_back({p[0], p[1], p[2]});
        if (p[3] >= 0) triangles.push_back({p[0], p[2], p[3]});
    }
    return triangles;
}

GenericMesh generic_mesh() {
    GenericMesh mesh;
    const FeaturePoints features = generic_features();
    const Plan plan = make_plan(features);
    Filling filling(plan, place_features(mesh, plan, features));
    filling.fill_to(GenericMesh::kNodes);
    mesh.flat.resize(GenericMesh::kNodes, 2);
    for (int i = 0; i < GenericMesh::kNodes; ++i) mesh.flat.row(i) = filling.nodes()[i];

    std::vector<Triangle> triangles = delaunay(mesh.flat);
    std::erase_if(triangles, [&](const Triangle& t) {
        const Vector2d centre = (mesh.flat.row(t[0]) + mesh.flat.row(t[1]) + mesh.flat.row(t[2])) / 3;
        return !plan.on_mesh(centre);
    });
    mesh.polygons = merged(mesh.flat, triangles, GenericMesh::kPolygons);
    if (mesh.polygons.size() != GenericMesh::kPolygons) {
        throw std::logic_error("generic mesh: " + std::to_string(mesh.polygons.size()) + " polygons");
    }
    return mesh;
}

}  // namespace viaface

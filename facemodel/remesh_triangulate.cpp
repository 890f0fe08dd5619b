#include <algorithm>

#include "facemodel/remesh.hpp"
#include "facemodel/triangulation.hpp"

namespace viaface {
namespace {

std::vector<Vector2d> corners_of(const Loop& loop, const std::vector<Vector2d>& places) {
    std::vector<Vector2d> corners;
    for (const int i : loop) corners.push_back(places[static_cast<std::size_t>(i)]);
    return corners;
}

// The triangles within the first loop and outside the others.
std::vector<Triangle> within(const std::vector<Loop>& loops, const std::vector<Vector2d>& places,
                             const std::vector<Triangle>& triangles) {
    std::vector<std::vector<Vector2d>> outlines;
    for (const Loop& loop : loops) outlines.push_back(corners_of(loop, places));
    const auto place = [&](int i) -> const Vector2d& { return places[static_cast<std::size_t>(i)]; };
    std::vector<Triangle> domain;
    for (const Triangle& t : triangles) {
        const Vector2d centre = (place(t[0]) + place(t[1]) + place(t[2])) / 3;
        bool in = outlines.empty() || inside(outlines[0], centre);
        for (std::size_t k = 1; k < outlines.size(); ++k) in = in && !inside(outlines[k], centre);
        if (in) domain.push_back(t);
    }
    return domain;
}

}  // namespace

std::vector<Triangle> triangulate(const std::vector<Vector2d>& places, const Nodes& nodes,
                                  const std::vector<Loop>& loops) {
    Triangulation mesh(places);
    std::set<Triangulation::Edge> kept;
    for (const Loop& loop : loops) {
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const int a = loop[k], b = loop[(k + 1) % loop.size()];
            mesh.insert(a, b);
            kept.insert(Triangulation::edge_of(a, b));
        }
    }
    mesh.restrict_to(within(loops, places, mesh.triangles()));
    const auto node = [&](int i) -> Vector3d { return nodes.row(i).transpose(); };
    mesh.flip_while(kept, [&](int a, int b, int c, int d) {
        return obtuse_opposite(node(a), node(b), node(c), node(d));
    });
    return mesh.triangles();
}

}  // namespace viaface

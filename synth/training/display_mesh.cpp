#include "synth/training/display_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "synth/training/collar.hpp"
#include "synth/training/display_curves.hpp"

namespace viaface {
namespace {

constexpr int kColumns = LipGrid::kColumns;
constexpr int kRingNodes = 132, kBottomNodes = 36;
constexpr std::uint64_t kSeed = 1998;

using Landmarks = std::initializer_list<int>;  // of the 68

// Inner to outer corner, then back.
constexpr Landmarks kLeftUpperLid = {42, 43, 44, 45}, kLeftLowerLid = {45, 46, 47, 42},
                    kRightUpperLid = {39, 38, 37, 36}, kRightLowerLid = {36, 41, 40, 39};
constexpr Landmarks kLipBorder = {51, 52, 53, 54, 55, 56, 57, 58, 59, 48, 49, 50},
                    kLipInner = {62, 63, 64, 65, 66, 67, 60, 61}, kUnderNose = {31, 32, 33, 34, 35};

void append(Curve& to, const Curve& more) { to.insert(to.end(), more.begin(), more.end()); }

std::vector<Triangle> triangles_of(const ObjScan& scan, const std::string& material, int last_node) {
    const auto found = std::find(scan.materials.begin(), scan.materials.end(), material);
    if (found == scan.materials.end()) throw std::invalid_argument("the scan has no material " + material);
    const int index = static_cast<int>(found - scan.materials.begin());
    std::vector<Triangle> triangles;
    for (const ObjFace& face : scan.faces) {
        const auto& n = face.nodes;
        if (face.material != index || *std::max_element(n.begin(), n.end()) >= last_node) continue;
        triangles.push_back({n[0], n[1], n[2]});
        if (n[3] >= 0) triangles.push_back({n[0], n[2], n[3]});
    }
    return triangles;
}

std::vector<int> landmark_ring(const BlendHead& head, Landmarks landmarks) {
    std::vector<int> nodes;
    for (const int k : landmarks) nodes.push_back(head.landmarks().at(static_cast<std::size_t>(k)));
    return nodes;
}

double distance_to(const std::vector<Vector3d>& places, const Vector3d& from) {
    double least = 1e300;
    for (const Vector3d& p : places) least = std::min(least, (p - from).squaredNorm());
    return std::sqrt(least);
}

// mm from the box about the nearer ear, with where it grows from the head.
double to_ear(const Vector3d& place) {
    const Vector3d low(68, 0, -124), high(92, 84, -92), at(std::abs(place.x()), place.y(), place.z());
    return (at - at.cwiseMax(low).cwiseMin(high)).norm();
}

// So that the collar's edge, which the mesh crosses, is round.
double collar_spacing(const Vector3d& place) {
    constexpr double kAtCollar = 4.5, kGrowth = 0.45;
    return kAtCollar + kGrowth * std::abs(above_collar(place));
}

// Wanted edge length over the face: fine at the lips, the lids and the nostrils, coarse far from them.
Spacing face_spacing(std::vector<Vector3d> features, std::vector<Vector3d> nose) {
    static constexpr double kFinest = 2.0, kGrowth = 0.16, kCoarsest = 9, kEar = 2.7, kEarGrowth = 0.5,
                            kNoseFiner = 3;
    return [features = std::move(features), nose = std::move(nose)](const Vector3d& place) {
        const double near = std::min(distance_to(features, place), distance_to(nose, place) - kNoseFiner);
        return std::min(
            {kFinest + kGrowth * near, kEar + kEarGrowth * to_ear(place), collar_spacing(place), kCoarsest});
    };
}

Loop counted(int first, int count) {
    Loop loop(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) loop[static_cast<std::size_t>(i)] = first + i;
    return loop;
}

// What has been gathered of the front: curves that the mesh keeps, and where it is to be fine.
struct FrontCurves {
    std::vector<Loop> loops;
    Curve border;    // of the lips
    Curve lids;      // edges of the lids and loops round them
    Curve features;  // near which the mesh is fine
};

void add_eye(DisplayAnchors& mesh, FrontCurves& curves, const Loop& hole, const Chart& chart,
             const BlendHead& head) {
    const Nodes& scan = head.generic();
    const bool left = scan(hole.front(), 0) > 0;
    const auto first = static_cast<int>(mesh.front.size());
    mesh.lid_first[left ? 0 : 1] = first;
    curves.loops.push_back(counted(first, kLidNodes));
    const Curve lid = resample_loop(hole, scan, kLidNodes);
    append(mesh.front, lid);
    const LidEdge edge = lid_edge(landmark_ring(head, left ? kLeftUpperLid : kRightUpperLid),
                                  landmark_ring(head, left ? kLeftLowerLid : kRightLowerLid), chart, scan);
    append(curves.lids, edge.ring);
    append(curves.features, lid);
    append(curves.features, edge.ring);
    for (const double out : {1.5, 3.4}) append(curves.lids, offset_loop(edge.ring, out, chart, scan));
    mesh.lash_roots[left ? 0 : 2] = lash_roots(edge.upper, false, chart, scan);
    mesh.lash_roots[left ? 1 : 3] = lash_roots(edge.lower, true, chart, scan);
}

void add_lips(DisplayAnchors& mesh, FrontCurves& curves, const Chart& chart, const BlendHead& head) {
    const Nodes& scan = head.generic();
    curves.border = lip_contour(landmark_ring(head, kLipBorder), 3, 6, 9, chart, scan);
    mesh.lip_inner = lip_contour(landmark_ring(head, kLipInner), 2, 4, 6, chart, scan);
    mesh.lip_middle = midway(curves.border, mesh.lip_inner, chart, scan);
    append(curves.features, curves.border);
}

void mesh_front(DisplayAnchors& mesh, const Chart& chart, const BlendHead& head) {
    const Nodes& scan = head.generic();
    FrontCurves curves;
    curves.loops = {counted(0, kRingNodes)};
    add_lips(mesh, curves, chart, head);
    for (const Loop& hole : chart.holes()) {
        const bool mouth = std::abs(scan(hole.front(), 0)) < 10;  // it lies inside the lips
        if (!mouth) add_eye(mesh, curves, hole, chart, head);
    }
    mesh.border_first = static_cast<int>(mesh.front.size());
    curves.loops.push_back(counted(mesh.border_first, kColumns));
    append(mesh.front, curves.border);
    append(mesh.front, curves.lids);
    for (const double side : {1.0, -1.0}) append(mesh.front, ear_rim(side, chart, scan));

    std::vector<Vector3d> nose;
    for (const int node : landmark_ring(head, kUnderNose)) nose.push_back(scan.row(node));
    const auto border = places_of(curves.border, chart);
    const Keep on_face = [&](const Anchor& anchor) { return !inside(border, chart.uv(anchor)); };
    append(mesh.front, sample_surface(scan, chart, mesh.front,
                                      face_spacing(spatial(curves.features, scan), nose), on_face, kSeed));
    mesh.front_places = places_of(mesh.front, chart);
    mesh.front_triangles = triangulate(mesh.front_places, nodes_at(mesh.front, scan), curves.loops);
}

void mesh_back(DisplayAnchors& mesh, const Chart& chart, const Nodes& scan) {
    static constexpr double kSpacing = 12;  // mm
    const Curve bottom = resample_loop(chart.holes().at(0), scan, kBottomNodes);
    append(mesh.back, bottom);
    const auto border = places_of(bottom, chart);
    append(mesh.back,
           sample_surface(
               scan, chart, mesh.back,
               [](const Vector3d& place) { return std::min(kSpacing, collar_spacing(place)); },
               [&](const Anchor& anchor) { return !inside(border, chart.uv(anchor)); }, kSeed + 1));
    mesh.back_places = places_of(mesh.back, chart);
    mesh.back_triangles = triangulate(mesh.back_places, nodes_at(mesh.back, scan),
                                      {counted(0, kRingNodes), counted(kRingNodes, kBottomNodes)});
}

}  // namespace

DisplayAnchors remesh_head(const BlendHead& head) {
    const Nodes& scan = head.generic();
    const Chart face(scan, triangles_of(head.neutral(), "M_Face", BlendHead::kFace.last));
    const Chart back(scan, triangles_of(head.neutral(), "M_BackHead", BlendHead::kHeadAndNeck.last));
    DisplayAnchors mesh;
    mesh.ring = kRingNodes;
    mesh.lid_nodes = kLidNodes;
    mesh.front = mesh.back = resample_loop(face.outer(), scan, kRingNodes);
    mesh_front(mesh, face, head);
    mesh_back(mesh, back, scan);
    return mesh;
}

LipContours lip_contours(const DisplayAnchors& anchors, const Nodes& scan) {
    LipContours contours;
    for (int c = 0; c < kColumns; ++c) {
        contours.outer.row(c) =
            anchors.front[static_cast<std::size_t>(anchors.border_first + c)].at(scan).transpose();
        contours.middle.row(c) = anchors.lip_middle[static_cast<std::size_t>(c)].at(scan).transpose();
        contours.inner.row(c) = anchors.lip_inner[static_cast<std::size_t>(c)].at(scan).transpose();
    }
    return contours;
}

}  // namespace viaface

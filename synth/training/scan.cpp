#include "synth/training/scan.hpp"

#include <algorithm>

namespace viaface {
namespace {

// A scanner sees neither teeth nor eyeballs of this head: its face alone is scanned.
std::vector<Triangle> face_triangles(const ObjScan& scan) {
    std::vector<Polygon> polygons;
    for (const ObjFace& face : scan.faces) {
        if (std::ranges::max(face.nodes) < BlendHead::kFace.last) polygons.push_back(face.nodes);
    }
    return triangles_of(polygons);
}

}  // namespace

FaceScan scan(const BlendHead& head, const ShapeWeights& weights) {
    static_assert(kMarkers == kFaceMarkers);
    const RangeFrame frame;
    const Nodes posed = head.pose(weights);
    const Configuration points = head.points(posed);
    Nodes landmarks(kLandmarks, 3), markers(kMarkers, 3);
    for (int i = 0; i < kLandmarks; ++i) landmarks.row(i) = posed.row(head.landmarks().at(i));
    for (int i = 0; i < kMarkers; ++i) markers.row(i) = point_of(points, i);
    return {RangeMap(frame, posed, face_triangles(head.neutral())),
            unrolled_features(frame.cylinder, landmarks, markers), points};
}

FittedPosture fit(const BlendHead& head, const GenericMesh& mesh, const Posture& posture) {
    FaceScan scanned = scan(head, posture.weights);
    AdaptedFace face = adapt(mesh, scanned.features, scanned.range);
    return {posture.name, std::move(scanned), std::move(face)};
}

}  // namespace viaface

#include "synth/scans/feature_pins.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.hpp"
#include "facemodel/cylinder.hpp"
#include "facemodel/field_morph.hpp"
#include "facemodel/lips.hpp"
#include "synth/scans/contour_search.hpp"
#include "synth/scans/face_finder.hpp"

namespace viaface {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

constexpr double kLeastContrast = 0.25;
constexpr double kBehindLine = 0.8;  // mm: the lips meet so far behind the line that is seen

PlaneLoop front_of(const Nodes& nodes, const NodeLoop& loop) {
    PlaneLoop plane;
    for (const int node : loop) plane.push_back(nodes.row(node).head<2>().transpose());
    return plane;
}

int corner(const Nodes& nodes, const NodeLoop& loop, double way) {
    return *std::ranges::max_element(loop, {}, [&](int node) { return way * nodes(node, 0); });
}

void pin_loop(const NodeLoop& loop, const PlaneLoop& places, const SurfaceView& view, double weight,
              std::vector<Pin>& pins) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const float z = view.depth_at(places[i].x(), places[i].y());
        if (!std::isnan(z)) pins.push_back({loop[i], {places[i].x(), places[i].y(), z}, weight});
    }
}

double height_on(const PlaneLoop& line, double x) {
    for (std::size_t i = 1; i < line.size(); ++i) {
        if (x > line[i].x() && i + 1 < line.size()) continue;
        const double share = std::clamp((x - line[i - 1].x()) / (line[i].x() - line[i - 1].x()), 0.0, 1.0);
        return line[i - 1].y() + share * (line[i].y() - line[i - 1].y());
    }
    return line.front().y();
}

void pin_lips(const GenericHead& generic, const SurfaceView& view, bool painted, std::vector<Pin>& pins,
              std::vector<std::string>& remarks) {
    const Nodes& rest = generic.face.rest;
    const PlaneLoop known = front_of(rest, generic.lip_border), inner = front_of(rest, generic.lip_inner);
    const PlaneLoop line = lip_line(view, known[kRightCorner], known[kLeftCorner]);
    const double width = line.back().x() - line.front().x(),
                 usual = known[kLeftCorner].x() - known[kRightCorner].x();
    if (width < 0.6 * usual || width > 1.6 * usual) {
        remarks.push_back("the line between the lips is not told: found by shape alone");
        return;
    }
    // The border's corners stand a little outside the line's ends.
    const double beyond = (usual - (inner[kLeftCorner].x() - inner[kRightCorner].x())) / 2 * width / usual;
    const Vector2d out(0.5 * beyond, 0);
    PlaneLoop border = between_corners(known, line.front() - out, line.back() + out);
    if (painted) {
        const ShapedContour found = shaped_contour(view, border, Within::kLips, 0.5);
        if (found.contrast > kLeastContrast) {
            border = found.loop;
            pin_loop(generic.lip_border, border, view, 1.5, pins);
        } else {
            remarks.push_back("the lips' border is not told by colour: found by shape alone");
        }
    }
    const PlaneLoop meeting = between_corners(inner, line.front() + out, line.back() - out);
    for (std::size_t c = 0; c < meeting.size(); ++c) {
        const double x = meeting[c].x(), y = height_on(line, x);
        const float z = view.depth_at(x, y);
        if (!std::isnan(z)) pins.push_back({generic.lip_inner[c], {x, y, z - kBehindLine}, 2});
    }
}

// Eyes as the detector sees them in the scan and in the generic head: the one's place over the other's.
void pin_lids(const GenericHead& generic, const SurfaceView& view, std::vector<Pin>& pins,
              std::vector<std::string>& remarks) {
    std::vector<const PaintedSurface*> drawn;
    for (const PaintedSurface& part : generic.drawn) drawn.push_back(&part);
    const SurfaceView known = look(drawn, view.window);
    std::array<std::optional<Vector2d>, 2> offset;
    std::array<PlaneLoop, 2> lids;
    for (std::size_t side = 0; side < 2; ++side) {
        lids[side] = front_of(generic.face.rest, generic.lids[side]);
        Vector2d middle = Vector2d::Zero();
        for (const Vector2d& p : lids[side]) middle += p / static_cast<double>(lids[side].size());
        const auto seen = eye_near(view, middle), usual = eye_near(known, middle);
        if (seen && usual) offset[side] = *seen - *usual;
    }
    if (!offset[0] && !offset[1]) {
        remarks.push_back("the eyes are shut or not told: lids by shape alone");
        return;
    }
    // Faces are nearly symmetric: what is found for one eye counts half for the other.
    ContourNumbers numbers[2];
    for (std::size_t side = 0; side < 2; ++side) {
        const Vector2d by =
            offset[side] ? *offset[side] : Vector2d(-offset[1 - side]->x(), offset[1 - side]->y());
        for (Vector2d& p : lids[side]) p += by;
        numbers[side] = shaped_contour(view, lids[side], Within::kEye, 0.7).numbers;
    }
    for (std::size_t side = 0; side < 2; ++side) {
        ContourNumbers both = numbers[side];
        for (std::size_t k = 0; k < both.size(); ++k)
            both[k] = (numbers[side][k] + (k == 0 ? -1 : 1) * numbers[1 - side][k]) / 2;
        pin_loop(generic.lids[side], shaped_by(lids[side], both), view, 1.5, pins);
    }
}

}  // namespace

Vector3d generic_landmark(const GenericHead& generic, const std::string& name) {
    if (const auto point = point_index(name); point && *point < kLowerIncisor)
        return point_of(generic.training.rest, *point);
    const Nodes& rest = generic.face.rest;
    if (name == "eye_left_outer") return rest.row(corner(rest, generic.lids[0], +1)).transpose();
    if (name == "eye_left_inner") return rest.row(corner(rest, generic.lids[0], -1)).transpose();
    if (name == "eye_right_outer") return rest.row(corner(rest, generic.lids[1], -1)).transpose();
    if (name == "eye_right_inner") return rest.row(corner(rest, generic.lids[1], +1)).transpose();
    throw InputError("landmarks", name,
                     "a point of viapoints/LAYOUT.md or eye_left_inner, eye_left_outer, ...");
}

std::vector<Pin> feature_pins(const GenericHead& generic, const PaintedSurface& scan,
                              const std::map<std::string, Vector3d>& landmarks, const Similarity& from_scan,
                              std::vector<std::string>& remarks) {
    constexpr ViewWindow kFront{-65, 120, 4, 520, 760};
    const PaintedSurface* surfaces[] = {&scan};
    const SurfaceView view = look(surfaces, kFront);
    std::vector<Pin> pins;
    if (scan.painted()) pin_lids(generic, view, pins, remarks);
    pin_lips(generic, view, scan.painted(), pins, remarks);
    for (const auto& [name, place] : landmarks) {
        const Vector3d generic_place = generic_landmark(generic, name);
        Eigen::Index nearest = 0;
        (generic.face.rest.rowwise() - generic_place.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
        pins.push_back({generic.face.weld[static_cast<std::size_t>(nearest)], from_scan(place), 5});
    }
    return pins;
}

Nodes field_morphed(const GenericHead& generic, const std::vector<Pin>& pins) {
    const Cylinder cylinder;
    const Nodes& rest = generic.face.rest;
    const auto flat = [&](const Vector3d& p) -> Vector2d { return cylinder.unrolled(p).head<2>(); };
    std::vector<MorphLine> from, to;
    const auto add = [&](const Vector3d& a, const Vector3d& b, const Vector3d& a_to, const Vector3d& b_to) {
        const MorphLine source{flat(a), flat(b)}, target{flat(a_to), flat(b_to)};
        if ((source.from - source.to).norm() < 0.2 || (target.from - target.to).norm() < 0.2) return;
        from.push_back(source);
        to.push_back(target);
    };
    for (std::size_t k = 1; k < pins.size(); ++k) {
        const Vector3d a = rest.row(pins[k - 1].node), b = rest.row(pins[k].node);
        if ((a - b).norm() < 8) add(a, b, pins[k - 1].place, pins[k].place);
    }
    const Configuration& points = generic.training.rest;
    for (const auto& [a, b] : {std::pair{kJawLeft, kChinLeft},
                               {kChinLeft, kChin},
                               {kChin, kChinRight},
                               {kChinRight, kJawRight},
                               {kCheekUpperLeft, kCheekLowerLeft},
                               {kCheekUpperRight, kCheekLowerRight}})
        add(point_of(points, a), point_of(points, b), point_of(points, a), point_of(points, b));
    const Vector3d nose = point_of(points, kNose), bridge = nose + Vector3d(0, 35, -14);
    add(nose, bridge, nose, bridge);
    const FieldMorph morph(from, to);
    const Eigen::VectorXd share = generic.face_share();
    Nodes moved = rest;
    for (Eigen::Index i = 0; i < rest.rows(); ++i) {
        if (share[i] <= 0) continue;
        const Vector3d unrolled = cylinder.unrolled(rest.row(i));
        const Vector2d place = morph(unrolled.head<2>());
        const Vector3d there = cylinder.rolled({place.x(), place.y(), unrolled.z()});
        moved.row(i) += share[i] * (there.transpose() - rest.row(i));
    }
    constexpr double kSmoother = 5;  // mm
    return smoothed(rest, generic.surface, moved, kSmoother);
}

}  // namespace viaface

#include "synth/scans/adaptation_to_scan.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "synth/scans/feature_pins.hpp"
#include "synth/scans/fit_distances.hpp"
#include "synth/scans/surface_fit.hpp"

namespace viaface {
namespace {

using Eigen::Vector3d;

constexpr double kFaceLike = 4;  // mm: farther off it is no face
constexpr const char* kTurnedRound =
    "triangles face inwards: turned round, left stays left (a mirror image needs \"mirrored\" in scans.json)";

[[noreturn]] void refuse(const std::string& value, const std::string& allowed) {
    throw InputError("scans", value, allowed);
}

std::string with_digits(double value, int digits) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    return text;
}

Similarity then(const Similarity& first, const Similarity& second) {
    return {second.scale * first.scale, second.turn * first.turn, second(first.shift)};
}

Similarity by_boxes(const FoundFace& found, const FaceBox& wanted) {
    const FaceBox& box = found.box;
    Similarity start;
    start.scale = wanted.side / box.side;
    start.turn = found.view_from_scan;
    start.shift =
        Vector3d(wanted.x, wanted.y, wanted.front) - start.scale * Vector3d(box.x, box.y, box.front);
    return start;
}

Similarity by_landmarks(const GenericHead& generic, const ScanFolder& scans) {
    Nodes from(static_cast<Eigen::Index>(scans.landmarks.size()), 3), to(from.rows(), 3);
    Eigen::Index row = 0;
    for (const auto& [name, place] : scans.landmarks) {
        from.row(row) = place.transpose();
        to.row(row++) = generic_landmark(generic, name).transpose();
    }
    return similarity_between(from, to);
}

// The generic face, by every `step`-th of its nodes.
struct FacePlaces {
    Nodes places, normals;
};
FacePlaces face_places(const GenericHead& generic, int step) {
    const Eigen::VectorXd share = generic.face_share();
    const Nodes normals = node_normals(generic.face.rest, generic.surface);
    std::vector<Eigen::Index> kept;
    for (Eigen::Index i = 0; i < share.size(); i += step) {
        if (share[i] > 0.6 && normals.row(i).allFinite() && normals.row(i).z() > 0.25) kept.push_back(i);
    }
    return {generic.face.rest(kept, Eigen::all), normals(kept, Eigen::all)};
}

// Mean distance of the nearer four fifths of what the scan has in front of the face to the generic head, mm.
double scan_off_face(const Nodes& scan, const NearestSurface& face) {
    std::vector<double> distances;
    const Eigen::Index step = std::max<Eigen::Index>(1, scan.rows() / 6000);
    for (Eigen::Index i = 0; i < scan.rows(); i += step) {
        const Vector3d p = scan.row(i);
        if (std::abs(p.x()) < 60 && p.y() > -55 && p.y() < 105 && p.z() > -60)
            distances.push_back(face(p).distance);
    }
    if (distances.size() < 60) return 1e9;
    std::ranges::sort(distances);
    distances.resize(distances.size() * 4 / 5);
    double sum = 0;
    for (const double d : distances) sum += d;
    return sum / static_cast<double>(distances.size());
}

// Iterated closest points of the generic face on the scan as `start` carries it: start, then the inverse.
struct Trial {
    Similarity from_scan;
    double off = 1e9;  // mm, both ways
};
Trial tried(const FacePlaces& face, const NearestSurface& generic, const PaintedSurface& scan,
            const Similarity& start, int rounds) {
    const Nodes carried = start.carried(scan.mesh.nodes);
    const NearestSurface surface(carried, scan.mesh.triangles);
    const Alignment alignment = aligned(face.places, face.normals, surface, {}, rounds);
    if (alignment.rms > 20) return {};
    const Similarity from_scan = then(start, alignment.to_scan.inverse());
    return {from_scan, alignment.rms + scan_off_face(from_scan.carried(scan.mesh.nodes), generic)};
}

// The starts: by landmarks, or by the detector; the shape decides between them.
Similarity aligned_with(const GenericHead& generic, const ScanFolder& scans, PaintedSurface& scan,
                        AdaptedHead& head) {
    const NearestSurface whole(generic.face.rest, generic.surface);
    const FacePlaces few = face_places(generic, 5), all = face_places(generic, 1);
    std::vector<Similarity> starts;
    std::vector<std::size_t> others;
    if (scans.landmarks.size() >= 4) {
        starts.push_back(by_landmarks(generic, scans));
        others.push_back(0);
    } else {
        std::vector<const PaintedSurface*> drawn;
        for (const PaintedSurface& part : generic.drawn) drawn.push_back(&part);
        const auto known = frontal_faces(drawn);
        if (known.empty()) throw std::runtime_error("the detector does not know the generic head");
        for (const FoundFace& found : find_faces(scan, scans.view_from_scan)) {
            starts.push_back(by_boxes(found, known[0]));
            others.push_back(found.others.size());
        }
    }
    if (starts.empty()) refuse("no face", "a scan in which a face is seen from one of its axes");
    Trial best;
    std::size_t chosen = 0;
    for (const bool turned : {false, true}) {
        if (turned) turn_round(scan.mesh);
        for (std::size_t k = 0; k < starts.size(); ++k) {
            const Trial trial = tried(few, whole, scan, starts[k], 15);
            if (trial.off >= best.off) continue;
            best = trial;
            chosen = k;
        }
        if (best.off < 2 * kFaceLike) {
            if (turned) head.remarks.push_back(kTurnedRound);
            break;
        }
    }
    if (best.off > 2 * kFaceLike)
        refuse("nothing shaped like a face (" + with_digits(best.off, 1) + " mm off)", "a scan of a face");
    if (others[chosen] > 0) refuse(std::to_string(others[chosen] + 1) + " faces", "one head to a scan");
    best = tried(all, whole, scan, best.from_scan, 300);
    head.remarks.push_back("aligned with the generic head, " + with_digits(best.off / 2, 2) + " mm off");
    return best.from_scan;
}

// Some programs count v downwards: of the two ways the one in which the face looks more like a face.
void settle_picture(const GenericHead& generic, PaintedSurface& scan, std::vector<std::string>& remarks) {
    if (scan.picture.pixels.empty()) return;
    std::vector<const PaintedSurface*> drawn;
    for (const PaintedSurface& part : generic.drawn) drawn.push_back(&part);
    constexpr ViewWindow kWindow{-60, 110, 1, 120, 165};
    const SurfaceView known = look(drawn, kWindow);
    PaintedSurface other = scan;
    other.mesh.uvs.col(1) = 1 - other.mesh.uvs.col(1).array();
    const PaintedSurface *as_is[] = {&scan}, *flipped[] = {&other};
    const double here = likeness(known, look(as_is, kWindow)),
                 there = likeness(known, look(flipped, kWindow));
    if (there <= here) return;
    scan.mesh.uvs = other.mesh.uvs;
    remarks.push_back("the colour map's rows are counted from the top: likeness " + with_digits(there, 2) +
                      " instead of " + with_digits(here, 2));
}

void find_unit(AdaptedHead& head, double stated) {
    const std::pair<const char*, double> units[] = {{"m", 1000}, {"cm", 10}, {"mm", 1}, {"inch", 25.4}};
    const double scale = head.from_scan.scale;
    if (stated > 0) {
        head.mm_per_generic = stated / scale;
        if (head.mm_per_generic > 0.72 && head.mm_per_generic < 1.4) return;
        std::string fitting = "a number near " + with_digits(scale, 3);
        for (const auto& [name, mm] : units) {
            if (mm / scale > 0.72 && mm / scale < 1.4) fitting = name;
        }
        throw InputError("units",
                         with_digits(stated, 3) + " mm makes a head " + with_digits(head.mm_per_generic, 3) +
                             " times a usual one's size",
                         fitting);
    }
    for (const auto& [name, mm] : units) {
        if (mm / scale < 0.82 || mm / scale > 1.22) continue;
        head.unit = name;
        head.mm_per_generic = mm / scale;
    }
    head.remarks.push_back(head.unit.empty()
                               ? "no unit: made of the generic head's size"
                               : "unit found: " + head.unit + ", the head is " +
                                     with_digits(head.mm_per_generic, 3) + " times the generic one's size");
}

struct Region {
    const char* name;
    bool (*holds)(const Vector3d&);
};
constexpr Region kRegions[] = {
    {"left ear", [](const Vector3d& p) { return p.x() > 78 && p.y() > 20 && p.y() < 95 && p.z() > -130; }},
    {"right ear", [](const Vector3d& p) { return p.x() < -78 && p.y() > 20 && p.y() < 95 && p.z() > -130; }},
    {"back of the head", [](const Vector3d& p) { return p.z() < -135 && p.y() > 0; }},
    {"crown", [](const Vector3d& p) { return p.y() > 140; }},
    {"neck", [](const Vector3d& p) { return p.y() < -70 && p.y() > -85; }},
    {"left jaw line",
     [](const Vector3d& p) { return p.x() > 50 && p.x() < 75 && p.y() > -45 && p.y() < 10 && p.z() > -90; }},
    {"right jaw line",
     [](const Vector3d& p) {
         return p.x() < -50 && p.x() > -75 && p.y() > -45 && p.y() < 10 && p.z() > -90;
     }},
    {"forehead",
     [](const Vector3d& p) { return std::abs(p.x()) < 45 && p.y() > 95 && p.y() < 115 && p.z() > -60; }}};

void list_completed(const GenericHead& generic, AdaptedHead& head) {
    for (const Region& region : kRegions) {
        int held = 0, all = 0;
        for (Eigen::Index i = 0; i < generic.face.rest.rows(); ++i) {
            if (generic.face.weld[static_cast<std::size_t>(i)] != i ||
                !region.holds(generic.face.rest.row(i)))
                continue;
            ++all;
            held += head.covered[static_cast<std::size_t>(i)] ? 1 : 0;
        }
        if (all > 0 && held < 0.6 * all) head.completed.push_back(region.name);
    }
    head.completed.push_back("teeth, tongue, eyes, lashes, inside of the mouth, clothing");
}

void check_coverage(const GenericHead& generic, AdaptedHead& head) {
    const Eigen::VectorXd share = generic.face_share();
    int held = 0, all = 0;
    for (const Triangle& t : generic.surface) {
        const int node = t[0];
        if (share[node] < 0.9) continue;
        ++all;
        held += head.covered[static_cast<std::size_t>(node)] ? 1 : 0;
    }
    const double missing = 100.0 * (all - held) / std::max(all, 1);
    if (missing > 50)
        refuse(with_digits(missing, 0) + " percent of the face are holes", "a scan of most of the face");
    if (missing > 12)
        head.remarks.push_back(with_digits(missing, 0) +
                               " percent of the face are holes or hidden, continued smoothly");
}

double corner_rise(const GenericHead& generic, const Nodes& nodes) {
    const auto y = [&](int column) { return nodes(generic.lip_border[static_cast<std::size_t>(column)], 1); };
    return (y(kLeftCorner) + y(kRightCorner)) / 2 - (y(0) + y(LipGrid::kColumns / 2)) / 2;
}

}  // namespace

void turn_round(ScanMesh& mesh) {
    for (auto* triangles : {&mesh.triangles, &mesh.uv_triangles}) {
        for (Triangle& t : *triangles) std::swap(t[1], t[2]);
    }
}

ScanFolder mirrored_back(ScanFolder scans) {
    if (!scans.mirrored) return scans;
    const Vector3d across = scans.view_from_scan ? Vector3d(scans.view_from_scan->row(0)) : Vector3d::UnitX();
    const Eigen::Matrix3d mirror = Eigen::Matrix3d::Identity() - 2 * across * across.transpose();
    for (auto& [name, scan] : scans.postures) {
        turn_round(scan.mesh);
        scan.mesh.nodes *= mirror;
    }
    for (auto& [name, place] : scans.landmarks) place = mirror * place;
    scans.mirrored = false;
    scans.remarks.push_back("mirrored back, as scans.json says");
    return scans;
}

AdaptedHead adapt_head(const GenericHead& generic, const ScanFolder& scans) {
    if (scans.mirrored) return adapt_head(generic, mirrored_back(scans));
    AdaptedHead head;
    head.remarks = scans.remarks;
    head.scan = scans.postures.at("neutral");
    const Nodes upright = head.scan.mesh.nodes;
    head.from_scan = aligned_with(generic, scans, head.scan, head);
    head.scan.mesh.nodes = head.from_scan.carried(upright);
    settle_picture(generic, head.scan, head.remarks);
    find_unit(head, scans.mm_per_unit);

    const NearestSurface surface(head.scan.mesh.nodes, head.scan.mesh.triangles);
    const std::vector<Pin> pins =
        feature_pins(generic, head.scan, scans.landmarks, head.from_scan, head.remarks);
    const Nodes morphed = field_morphed(generic, pins);
    const SmoothFit fit = fitted(generic, surface, morphed, pins);
    head.nodes = fit.nodes;
    head.covered = fit.covered;
    weld_nodes(generic.face, head.nodes);
    check_coverage(generic, head);
    measure_fit(generic, surface, head);
    list_completed(generic, head);
    head.smile = corner_rise(generic, head.nodes) - corner_rise(generic, generic.face.rest);
    return head;
}

}  // namespace viaface

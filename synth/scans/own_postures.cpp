#include "synth/scans/own_postures.hpp"

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <optional>

#include "synth/scans/fit_distances.hpp"
#include "synth/scans/surface_fit.hpp"

namespace viaface {
namespace {

using Eigen::Vector3d;

constexpr double kOtherHead = 2.5;  // mm: brows that lie so far apart are not one person's

bool on_brow(const Vector3d& p) { return p.y() > 55 && p.y() < 110 && std::abs(p.x()) < 65 && p.z() > -70; }

std::vector<Eigen::Index> brow_nodes(const Nodes& nodes) {
    std::vector<Eigen::Index> found;
    for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
        if (on_brow(nodes.row(i))) found.push_back(i);
    }
    return found;
}

struct Laid {
    Nodes nodes;     // of the posture's scan
    double off = 0;  // mm, rms over the brow
};

// Node by node, with the worst third left out.
Laid laid_by_nodes(const Nodes& neutral, const Nodes& posture) {
    std::vector<Eigen::Index> kept = brow_nodes(neutral);
    if (kept.size() < 30) return {posture, 1e9};
    Laid laid{posture, 0};
    for (int round = 0; round < 8; ++round) {
        const auto off = [&](Eigen::Index i) { return (laid.nodes.row(i) - neutral.row(i)).norm(); };
        std::vector<Eigen::Index> near = kept;
        std::ranges::stable_sort(near, {}, off);
        near.resize(std::max<std::size_t>(30, near.size() * 2 / 3));
        double sum = 0;
        for (const Eigen::Index i : near) sum += off(i) * off(i);
        laid.off = std::sqrt(sum / static_cast<double>(near.size()));
        const Nodes from = laid.nodes(near, Eigen::all), to = neutral(near, Eigen::all);
        laid.nodes = similarity_between(from, to, Size::kKept).carried(laid.nodes);
    }
    return laid;
}

// By what the jaw does not move: brow, cheekbones and nose.
Laid laid_by_surface(const GenericHead& generic, const Nodes& head, const ScanMesh& scan) {
    constexpr Eigen::Index kEvery = 4;
    const Eigen::VectorXd share = generic.face_share();
    const Nodes normals = node_normals(head, generic.surface);
    std::vector<Eigen::Index> kept;
    for (Eigen::Index i = 0; i < head.rows(); i += kEvery) {
        if (share[i] > 0.6 && head(i, 1) > 25 && normals.row(i).allFinite() && normals(i, 2) > 0.25)
            kept.push_back(i);
    }
    const Nodes places = head(kept, Eigen::all), there = normals(kept, Eigen::all);
    const NearestSurface surface(scan.nodes, scan.triangles);
    const Alignment alignment = aligned(places, there, surface, {}, 200, Size::kKept);
    return {alignment.to_scan.inverse().carried(scan.nodes), alignment.rms};
}

bool same_triangles(const ScanMesh& a, const ScanMesh& b) {
    return a.nodes.rows() == b.nodes.rows() && a.triangles == b.triangles;
}

// Held nodes at their places, the others as smoothly as `head` goes on between them.
Nodes continued(const GenericHead& generic, const NearestSurface& scan, const Nodes& head,
                const std::vector<Pin>& pins) {
    constexpr FitStage kThrough[] = {{1, 0, 1}};
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(head.rows());
    return fit_smoothly(head, generic.surface, scan, none, pins, kThrough).nodes;
}

class Postures {
  public:
    Postures(const GenericHead& generic, const ScanMesh& as_read, const AdaptedHead& head)
        : generic_(generic),
          as_read_(as_read),
          head_(head),
          neutral_(head.scan.mesh.nodes, head.scan.mesh.triangles) {
        const Nodes normals = node_normals(head.nodes, generic.surface);
        for (Eigen::Index i = 0; i < head.nodes.rows(); ++i) {
            if (!head.covered[static_cast<std::size_t>(i)]) continue;
            const SurfacePlace seat = neutral_(head.nodes.row(i).transpose());
            if (seat.distance < kSeated && neutral_.normal(seat).dot(normals.row(i).transpose()) > 0.4)
                seats_.push_back({static_cast<int>(i), seat});
        }
    }

    std::optional<Nodes> fitted_to(ScanMesh mesh, std::string& remark) const {
        const bool seated = same_triangles(as_read_, mesh);
        mesh.nodes = head_.from_scan.carried(mesh.nodes);
        if (as_read_.triangles != head_.scan.mesh.triangles && !seated) turn_round(mesh);
        const Laid laid = seated ? laid_by_nodes(head_.scan.mesh.nodes, mesh.nodes)
                                 : laid_by_surface(generic_, head_.nodes, mesh);
        if (laid.off > kOtherHead) {
            remark = "not used: its brow is not that of the neutral scan";
            return std::nullopt;
        }
        mesh.nodes = laid.nodes;
        if (seated) mesh.triangles = head_.scan.mesh.triangles;
        Nodes nodes = seated ? carried_along(mesh) : pulled(mesh);
        weld_nodes(generic_.face, nodes);
        remark = said(nodes, mesh);
        return nodes;
    }

  private:
    static constexpr double kSeated = 1.5;  // mm: farther off the scan a node has no place on it
    struct Seated {
        int node;
        SurfacePlace on_neutral;
    };

    Nodes carried_along(const ScanMesh& mesh) const {
        constexpr double kHeld = 1e4;  // mm^2: as good as fixed
        std::vector<Pin> pins;
        for (const auto& [node, seat] : seats_) {
            Vector3d way = Vector3d::Zero();
            for (int k = 0; k < 3; ++k) {
                const int corner = mesh.triangles[static_cast<std::size_t>(seat.triangle)][k];
                way +=
                    seat.shares[k] * (mesh.nodes.row(corner) - head_.scan.mesh.nodes.row(corner)).transpose();
            }
            pins.push_back({node, head_.nodes.row(node).transpose() + way, kHeld});
        }
        return continued(generic_, neutral_, head_.nodes, pins);
    }

    Nodes pulled(const ScanMesh& scan) const {
        const NearestSurface surface(scan.nodes, scan.triangles);
        GenericHead start = generic_;
        start.face.rest = nearest_posture(surface);
        return fitted(start, surface, start.face.rest, {}).nodes;
    }

    // Of rest and the lender's postures, on the fitted head.
    Nodes nearest_posture(const NearestSurface& scan) const {
        Nodes best = head_.nodes;
        double least = off_lower_face(best, scan);
        for (Eigen::Index k = 0; k < generic_.training.coefficients.cols(); ++k) {
            Nodes nodes = head_.nodes + generic_.posture(k) - generic_.face.rest;
            const double off = off_lower_face(nodes, scan);
            if (off >= least) continue;
            least = off;
            best = std::move(nodes);
        }
        return best;
    }

    double off_lower_face(const Nodes& nodes, const NearestSurface& scan) const {
        constexpr double kFar = 6;  // mm
        constexpr std::size_t kEvery = 5;
        double sum = 0;
        for (std::size_t i = 0; i < seats_.size(); i += kEvery) {
            const int node = seats_[i].node;
            const Vector3d rest = head_.nodes.row(node);
            if (rest.y() > 35 || std::abs(rest.x()) > 50) continue;
            sum += std::min(kFar, scan(nodes.row(node).transpose(), kFar).distance);
        }
        return sum;
    }

    std::string said(const Nodes& nodes, const ScanMesh& mesh) const {
        const NearestSurface surface(mesh.nodes, mesh.triangles);
        std::vector<double> off;
        double most = 0;
        for (const auto& [node, seat] : seats_) {
            most = std::max(most, (nodes.row(node) - head_.nodes.row(node)).norm());
            off.push_back(surface(nodes.row(node).transpose()).distance * head_.mm_per_generic);
        }
        char text[120];
        std::snprintf(text, sizeof text,
                      "used: moves by up to %.1f mm, lies on its scan within %.2f mm (95%%)",
                      most * head_.mm_per_generic, distances_of(std::move(off)).p95);
        return text;
    }

    const GenericHead& generic_;
    const ScanMesh& as_read_;
    const AdaptedHead& head_;
    NearestSurface neutral_;
    std::vector<Seated> seats_;
};

}  // namespace

std::vector<OwnPosture> own_postures(const GenericHead& generic, const ScanFolder& scans,
                                     const AdaptedHead& head, std::vector<std::string>& remarks) {
    if (scans.postures.size() < 2) return {};
    const Postures postures(generic, scans.postures.at("neutral").mesh, head);
    std::vector<OwnPosture> found;
    for (const auto& [name, scan] : scans.postures) {
        if (name == "neutral") continue;
        std::string remark;
        if (auto nodes = postures.fitted_to(scan.mesh, remark)) found.push_back({name, std::move(*nodes)});
        remarks.push_back("posture " + name + ": " + remark);
    }
    return found;
}

}  // namespace viaface

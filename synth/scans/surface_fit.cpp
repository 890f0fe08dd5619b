#include "synth/scans/surface_fit.hpp"

#include <algorithm>

#include "synth/scans/fit_distances.hpp"

namespace viaface {
namespace {

// How far the scan is trusted: not where the generic head is hidden from a scanner (nostrils, behind
// the lids' edges). [nodes]
Eigen::VectorXd trust_in_scan(const GenericHead& generic) {
    const Face& face = generic.face;
    Eigen::VectorXd trust = Eigen::VectorXd::Zero(face.rest.rows());
    for (const Triangle& t : generic.surface) {
        for (const int node : t) {
            const double y = face.rest(node, 1);
            trust[node] = std::clamp((y + 100) / 20, 0.0, 1.0);  // the collar is the generic head's
        }
    }
    constexpr int kSeenRows = 10;
    for (int row = kSeenRows; row < LipGrid::kRows; ++row) {
        for (int c = 0; c < LipGrid::kColumns; ++c) trust[face.lips.node(row, c)] = 0;
    }
    const auto seen = seen_nodes(face.rest, generic.surface);
    for (Eigen::Index i = 0; i < trust.size(); ++i) trust[i] *= seen[static_cast<std::size_t>(i)];
    return trust;
}

std::vector<bool> with_neighbours(const GenericHead& generic, const std::vector<bool>& nodes) {
    std::vector<bool> more = nodes;
    for (const Triangle& t : generic.surface) {
        if (std::ranges::none_of(t, [&](int node) { return nodes[static_cast<std::size_t>(node)]; }))
            continue;
        for (const int node : t) more[static_cast<std::size_t>(node)] = true;
    }
    return more;
}

// Where each node would be if it stood to its neighbours as in `like`: amid them where that is all zero.
Nodes amid_neighbours(const GenericHead& generic, const Nodes& nodes, const Nodes& like) {
    const Nodes ways = nodes - like;
    Nodes sum = Nodes::Zero(nodes.rows(), 3);
    Eigen::VectorXd count = Eigen::VectorXd::Zero(nodes.rows());
    for (const Triangle& t : generic.surface) {
        for (const int node : t) {
            sum.row(node) += ways.row(t[0]) + ways.row(t[1]) + ways.row(t[2]) - ways.row(node);
            count[node] += 2;
        }
    }
    return like + (count.cwiseMax(1).cwiseInverse().asDiagonal() * sum);
}

// Moves the nodes of triangles that are turned over, later those about them too, halfway to amid their
// neighbours until none is, and where that does not help to where the generic head has them.
void relax_turned(const GenericHead& generic, Nodes& nodes) {
    constexpr int kRounds = 400, kRoundsToGrow = 50;
    const Nodes amid = Nodes::Zero(nodes.rows(), 3);
    for (int round = 0; round < kRounds; ++round) {
        const auto turned = turned_triangles(generic, nodes);
        if (turned.empty()) return;
        std::vector<bool> moves(static_cast<std::size_t>(nodes.rows()));
        for (const Triangle& t : turned) {
            for (const int node : t) moves[static_cast<std::size_t>(node)] = true;
        }
        const bool early = round < kRounds / 2;
        const int grown = round % (kRounds / 2) / kRoundsToGrow, rings = early ? std::min(grown, 1) : grown;
        for (int ring = 0; ring < rings; ++ring) moves = with_neighbours(generic, moves);
        const Nodes there = amid_neighbours(generic, nodes, early ? amid : Nodes(generic.face.rest));
        for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
            if (moves[static_cast<std::size_t>(i)]) nodes.row(i) = (nodes.row(i) + there.row(i)) / 2;
        }
    }
}

}  // namespace

SmoothFit fitted(const GenericHead& generic, const NearestSurface& scan, const Nodes& start,
                 std::vector<Pin> pins) {
    constexpr FitStage kStages[] = {{40, 30, 5}, {20, 25, 6}, {10, 15, 5}, {6, 8, 4},
                                    {4, 6, 3},   {2.5, 5, 3}, {1.6, 4, 3}};
    constexpr FitStage kSettle[] = {{1.6, 3, 3}, {1, 2, 4}, {0.7, 2, 3}};
    const Eigen::VectorXd trust = trust_in_scan(generic);
    SmoothFit fit = fit_smoothly(start, generic.surface, scan, trust, pins, kStages);
    // Once all are in their places the surface counts more than the picture.
    for (Pin& pin : pins) pin.weight *= 0.02;
    fit = fit_smoothly(start, generic.surface, scan, trust, pins, kSettle, &fit.nodes);
    relax_turned(generic, fit.nodes);
    return fit;
}

void weld_nodes(const Face& face, Nodes& nodes) {
    for (std::size_t i = 0; i < face.weld.size(); ++i)
        nodes.row(static_cast<Eigen::Index>(i)) = nodes.row(face.weld[i]).eval();
}

}  // namespace viaface

#include "synth/training/display_curves.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace viaface {
namespace {

constexpr int kColumns = LipGrid::kColumns;

void append(Curve& to, const Curve& more) { to.insert(to.end(), more.begin(), more.end()); }

Curve loop_curve(const Loop& loop) {
    Curve curve;
    for (const int node : loop) curve.push_back({{node, node, node}, {1, 0, 0}});
    curve.push_back(curve.front());
    return curve;
}

Anchor between(const Anchor& a, const Anchor& b, double t) {
    return {{a.nodes[0], b.nodes[0], a.nodes[0]}, {1 - t, t, 0}};
}

// A natural cubic spline through places of the chart, over their distance in space; `fine` places each span.
std::vector<Vector2d> spline_through(const std::vector<Vector2d>& places, const std::vector<double>& knots) {
    constexpr int kFine = 60;
    const auto n = static_cast<Eigen::Index>(places.size());
    Eigen::MatrixXd system = Eigen::MatrixXd::Identity(n, n);
    Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(n, 2);
    const auto step = [&](Eigen::Index k) {
        return knots[static_cast<std::size_t>(k + 1)] - knots[static_cast<std::size_t>(k)];
    };
    const auto place = [&](Eigen::Index k) { return places[static_cast<std::size_t>(k)]; };
    for (Eigen::Index k = 1; k + 1 < n; ++k) {
        system(k, k - 1) = step(k - 1);
        system(k, k) = 2 * (step(k - 1) + step(k));
        system(k, k + 1) = step(k);
        right.row(k) =
            6 * ((place(k + 1) - place(k)) / step(k) - (place(k) - place(k - 1)) / step(k - 1)).transpose();
    }
    const Eigen::MatrixX2d bend = system.partialPivLu().solve(right);
    std::vector<Vector2d> fine;
    for (Eigen::Index k = 0; k + 1 < n; ++k) {
        const double h = step(k);
        for (int i = 0; i < kFine; ++i) {
            const double t = static_cast<double>(i) / kFine, s = 1 - t;
            fine.push_back(
                s * place(k) + t * place(k + 1) +
                h * h / 6 * ((s * s * s - s) * bend.row(k) + (t * t * t - t) * bend.row(k + 1)).transpose());
        }
    }
    fine.push_back(places.back());
    return fine;
}

std::vector<double> arcs(const std::vector<Vector3d>& places) {
    std::vector<double> arc(places.size(), 0);
    for (std::size_t k = 1; k < places.size(); ++k) arc[k] = arc[k - 1] + (places[k] - places[k - 1]).norm();
    return arc;
}

// `count` places at equal steps of arc in space along a fine curve of the chart, without its end.
Curve resample_curve(const std::vector<Vector2d>& fine, const Chart& chart, const Nodes& scan, int count) {
    std::vector<Vector3d> places;
    for (const Vector2d& p : fine) places.push_back(chart.locate(p).at(scan));
    const std::vector<double> arc = arcs(places);
    Curve curve;
    for (int i = 0; i < count; ++i) {
        const double wanted = arc.back() * i / count;
        const auto k =
            static_cast<std::size_t>(std::upper_bound(arc.begin(), arc.end(), wanted) - arc.begin());
        const double t = (wanted - arc[k - 1]) / (arc[k] - arc[k - 1]);
        curve.push_back(chart.locate((1 - t) * fine[k - 1] + t * fine[k]));
    }
    return curve;
}

// A place `out` mm outwards on the surface from one on the rim of a hole.
Anchor outwards(const Anchor& from, const Vector2d& middle, double out, const Chart& chart,
                const Nodes& scan) {
    const Vector2d place = chart.uv(from), way = (place - middle) * 0.01;
    Anchor to = from;
    for (int step = 1; step < 300 && (to.at(scan) - from.at(scan)).norm() < out; ++step) {
        to = chart.locate(place + step * way);
    }
    return to;
}

Vector2d middle_of(const std::vector<Vector2d>& places) {
    Vector2d middle = Vector2d::Zero();
    for (const Vector2d& p : places) middle += p / static_cast<double>(places.size());
    return middle;
}

}  // namespace

std::vector<Vector2d> places_of(const Curve& curve, const Chart& chart) {
    std::vector<Vector2d> places;
    for (const Anchor& anchor : curve) places.push_back(chart.uv(anchor));
    return places;
}

std::vector<Vector3d> spatial(const Curve& curve, const Nodes& scan) {
    std::vector<Vector3d> places;
    for (const Anchor& anchor : curve) places.push_back(anchor.at(scan));
    return places;
}

// Places at equal steps of arc along a closed chain of scan nodes, half a step off its start.
Curve resample_loop(const Loop& loop, const Nodes& scan, int count) {
    const Curve chain = loop_curve(loop);
    std::vector<double> arc(chain.size(), 0);
    for (std::size_t k = 1; k < chain.size(); ++k) {
        arc[k] = arc[k - 1] + (chain[k].at(scan) - chain[k - 1].at(scan)).norm();
    }
    Curve places;
    for (int i = 0; i < count; ++i) {
        const double wanted = arc.back() * (i + 0.5) / count;
        const auto k =
            static_cast<std::size_t>(std::upper_bound(arc.begin(), arc.end(), wanted) - arc.begin());
        places.push_back(between(chain[k - 1], chain[k], (wanted - arc[k - 1]) / (arc[k] - arc[k - 1])));
    }
    return places;
}

// A quarter of contour after quarter: each from one of the four cardinal landmarks to the next. The upper and
// the lower lip each have a spline of their own, for the corners are sharp.
Curve lip_contour(const std::vector<int>& ring, int left, int bottom, int right, const Chart& chart,
                  const Nodes& scan) {
    const int count = static_cast<int>(ring.size());
    const auto spline = [&](int first, int last) {  // landmarks first..last of the ring, wrapped
        std::vector<Vector2d> places;
        std::vector<Vector3d> spatial;
        for (int k = first; k <= last; ++k) {
            const int node = ring[static_cast<std::size_t>(k % count)];
            places.push_back(chart.uv(node));
            spatial.push_back(scan.row(node).transpose());
        }
        return spline_through(places, arcs(spatial));
    };
    const auto upper = spline(right, count + left), lower = spline(left, right);
    const auto piece = [&](const std::vector<Vector2d>& fine, int from, int to, int spans) {
        const auto per = (fine.size() - 1) / static_cast<std::size_t>(spans);
        return std::vector<Vector2d>(
            fine.begin() + static_cast<std::ptrdiff_t>(per * static_cast<std::size_t>(from)),
            fine.begin() + static_cast<std::ptrdiff_t>(per * static_cast<std::size_t>(to)) + 1);
    };
    const int above = count + left - right, below = right - left;
    Curve contour;
    for (const auto& quarter :
         {piece(upper, count - right, above, above), piece(lower, 0, bottom - left, below),
          piece(lower, bottom - left, below, below), piece(upper, 0, count - right, above)}) {
        const Curve places = resample_curve(quarter, chart, scan, kColumns / 4);
        contour.insert(contour.end(), places.begin(), places.end());
    }
    return contour;
}

// Midway on the surface between two contours, column by column.
Curve midway(const Curve& outer, const Curve& inner, const Chart& chart, const Nodes& scan) {
    constexpr int kSteps = 40;
    Curve middle;
    for (std::size_t c = 0; c < outer.size(); ++c) {
        std::vector<Vector2d> line;
        for (int i = 0; i <= kSteps; ++i) {
            const double t = static_cast<double>(i) / kSteps;
            line.push_back((1 - t) * chart.uv(outer[c]) + t * chart.uv(inner[c]));
        }
        middle.push_back(resample_curve(line, chart, scan, 2)[1]);
    }
    return middle;
}

// The loop moved outwards by `out` mm.
Curve offset_loop(const Curve& loop, double out, const Chart& chart, const Nodes& scan) {
    const Vector2d middle = middle_of(places_of(loop, chart));
    Curve moved;
    for (const Anchor& anchor : loop) moved.push_back(outwards(anchor, middle, out, chart, scan));
    return moved;
}

LidEdge lid_edge(const std::vector<int>& upper, const std::vector<int>& lower, const Chart& chart,
                 const Nodes& scan) {
    const auto spline = [&](const std::vector<int>& nodes) {
        std::vector<Vector2d> places;
        std::vector<Vector3d> spatial;
        for (const int node : nodes) {
            places.push_back(chart.uv(node));
            spatial.push_back(scan.row(node).transpose());
        }
        return spline_through(places, arcs(spatial));
    };
    LidEdge edge{spline(upper), spline(lower), {}};
    edge.ring = resample_curve(edge.upper, chart, scan, kLidNodes / 2);
    append(edge.ring, resample_curve(edge.lower, chart, scan, kLidNodes / 2));
    return edge;
}

// Where lashes grow on one lid: nose to temple, off the corners.
Curve lash_roots(const std::vector<Vector2d>& lid, bool from_temple, const Chart& chart, const Nodes& scan) {
    constexpr int kSteps = 18;
    constexpr std::size_t kOffNose = 3, kOffTemple = 2;
    Curve roots = resample_curve(lid, chart, scan, kSteps);
    if (from_temple) std::reverse(roots.begin(), roots.end());
    return {roots.begin() + kOffNose, roots.end() - kOffTemple};
}

// Where an ear stands out farthest at each height, so that its outline from the front is one of the mesh's
// own curves. side: +1 the talker's left.
Curve ear_rim(double side, const Chart& chart, const Nodes& scan) {
    constexpr double kLowest = 6, kHighest = 84, kStep = 2.2, kHead = 77;  // mm
    Curve rim;
    for (double y = kLowest; y < kHighest; y += kStep) {
        Anchor farthest;
        double reach = kHead;
        for (const Triangle& t : chart.triangles()) {
            for (std::size_t k = 0; k < 3; ++k) {
                const int a = t[k], b = t[(k + 1) % 3];
                if ((scan(a, 1) < y) == (scan(b, 1) < y)) continue;
                const double share = (y - scan(a, 1)) / (scan(b, 1) - scan(a, 1));
                const double x = side * ((1 - share) * scan(a, 0) + share * scan(b, 0));
                if (x <= reach) continue;
                reach = x;
                farthest = {{a, b, a}, {1 - share, share, 0}};
            }
        }
        if (reach > kHead) rim.push_back(farthest);
    }
    return rim;
}

}  // namespace viaface

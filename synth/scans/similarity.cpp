#include "synth/scans/similarity.hpp"

#include <algorithm>
#include <cmath>

namespace viaface {

using Eigen::Vector3d;

Similarity Similarity::inverse() const {
    return {1 / scale, turn.transpose(), -(turn.transpose() * shift) / scale};
}

Similarity similarity_between(const Nodes& from, const Nodes& to, Size size) {
    const Eigen::Matrix4d m = Eigen::umeyama(Eigen::Matrix3Xd(from.transpose()),
                                             Eigen::Matrix3Xd(to.transpose()), size == Size::kFree);
    const double scale = std::cbrt(m.topLeftCorner<3, 3>().determinant());
    return {scale, m.topLeftCorner<3, 3>() / scale, m.topRightCorner<3, 1>()};
}

Alignment aligned(const Nodes& places, const Nodes& normals, const NearestSurface& scan, Similarity start,
                  int rounds, Size size) {
    constexpr double kStill = 1e-3;  // of the rms
    Alignment best{start, 0};
    for (int round = 0; round < rounds; ++round) {
        struct Match {
            Eigen::Index place;
            Vector3d foot;
            double distance;
        };
        std::vector<Match> matches;
        for (Eigen::Index i = 0; i < places.rows(); ++i) {
            const SurfacePlace near = scan(best.to_scan(places.row(i).transpose()));
            const Vector3d normal = best.to_scan.turn * normals.row(i).transpose();
            if (scan.on_border(near) || scan.normal(near).dot(normal) < 0.4) continue;
            matches.push_back({i, near.place, near.distance});
        }
        if (matches.size() < 30) return {best.to_scan, 1e9};
        std::ranges::stable_sort(matches, {}, &Match::distance);
        matches.resize(std::max<std::size_t>(30, matches.size() * 2 / 3));
        Nodes from(static_cast<Eigen::Index>(matches.size()), 3), to(from.rows(), 3);
        double sum = 0;
        for (Eigen::Index k = 0; k < from.rows(); ++k) {
            from.row(k) = places.row(matches[static_cast<std::size_t>(k)].place);
            to.row(k) = matches[static_cast<std::size_t>(k)].foot.transpose();
            sum +=
                matches[static_cast<std::size_t>(k)].distance * matches[static_cast<std::size_t>(k)].distance;
        }
        best.rms = std::sqrt(sum / static_cast<double>(from.rows()));
        const Similarity next = similarity_between(from, to, size);
        const double moved = (next.carried(from) - best.to_scan.carried(from)).rowwise().norm().maxCoeff();
        best.to_scan = next;
        if (moved < kStill * best.rms) break;
    }
    return best;
}

}  // namespace viaface

#include "viapoints/head_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.hpp"

namespace viaface {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr double kLeastSpread = 3;  // mm, of markers across their line
constexpr double kLoosest = 1;      // mm rms, of a distance that should not change
constexpr std::size_t kMostCandidates = 80;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Vector3d place(const PointRecording& recording, std::size_t sample, std::size_t label) {
    return recording.positions.block<1, 3>(static_cast<Index>(sample), static_cast<Index>(3 * label))
        .transpose();
}

// Standard deviation of the distance of two points over the samples that see both; infinite when few do.
double unsteadiness(const PointRecording& recording, std::size_t a, std::size_t b) {
    double sum = 0, squares = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < recording.size(); ++i) {
        const double distance = (place(recording, i, a) - place(recording, i, b)).norm();
        if (std::isnan(distance)) continue;
        sum += distance;
        squares += distance * distance;
        ++count;
    }
    if (2 * count < recording.size() || count == 0) return kInfinity;
    const double mean = sum / static_cast<double>(count);
    return std::sqrt(std::max(0.0, squares / static_cast<double>(count) - mean * mean));
}

Points first_places(const PointRecording& recording, const std::vector<std::size_t>& labels) {
    for (std::size_t i = 0; i < recording.size(); ++i) {
        Points places;
        for (const std::size_t label : labels) places.push_back(place(recording, i, label));
        if (std::ranges::all_of(places, [](const Vector3d& p) { return p.allFinite(); })) return places;
    }
    return {};
}

struct Triple {
    std::vector<std::size_t> labels;
    double unsteady = kInfinity;  // mm, of its least steady distance
};

Triple steadiest_triple(const PointRecording& recording, const Eigen::MatrixXd& pairs) {
    Triple best;
    const auto count = static_cast<std::size_t>(pairs.rows());
    for (std::size_t a = 0; a < count; ++a) {
        for (std::size_t b = a + 1; b < count; ++b) {
            if (pairs(static_cast<Index>(a), static_cast<Index>(b)) >= best.unsteady) continue;
            for (std::size_t c = b + 1; c < count; ++c) {
                const auto ia = static_cast<Index>(a), ib = static_cast<Index>(b), ic = static_cast<Index>(c);
                const double unsteady = std::max({pairs(ia, ib), pairs(ia, ic), pairs(ib, ic)});
                if (unsteady >= best.unsteady) continue;
                const Points places = first_places(recording, {a, b, c});
                if (places.empty() || spread(places) < kLeastSpread) continue;
                best = {{a, b, c}, unsteady};
            }
        }
    }
    return best;
}

std::vector<std::size_t> indices_of(const PointRecording& recording,
                                    const std::vector<std::string>& markers) {
    std::vector<std::size_t> indices;
    for (const std::string& marker : markers) {
        const auto found = std::ranges::find(recording.labels, marker);
        if (found == recording.labels.end())
            throw InputError("--head-markers", marker, "labels of the recording");
        indices.push_back(static_cast<std::size_t>(found - recording.labels.begin()));
    }
    std::ranges::sort(indices);
    if (std::ranges::adjacent_find(indices) != indices.end() || indices.size() < 3)
        throw InputError("--head-markers", std::to_string(indices.size()) + " labels",
                         "three or more, each once");
    return indices;
}

// Carries `shape` onto what a sample sees of it.
RigidTurn turn_at(const PointRecording& recording, std::size_t sample,
                  const std::vector<std::size_t>& markers, const Points& shape) {
    Points from, to;
    for (std::size_t k = 0; k < markers.size(); ++k) {
        const Vector3d now = place(recording, sample, markers[k]);
        if (!now.allFinite()) continue;
        from.push_back(shape[k]);
        to.push_back(now);
    }
    if (from.size() < 3 || spread(from) < kLeastSpread)
        throw InputError(
            "--head-markers",
            std::to_string(from.size()) + " seen at " + std::to_string(recording.time_s[sample]) + " s",
            "three that are not on a line, in every frame");
    return rigid_turn(from, to);
}

// The mean of the markers' places, every sample laid on the shape given.
Points mean_shape(const PointRecording& recording, const std::vector<std::size_t>& markers,
                  const Points& shape) {
    Points sums(markers.size(), Vector3d::Zero());
    std::vector<double> counts(markers.size(), 0);
    for (std::size_t i = 0; i < recording.size(); ++i) {
        const RigidTurn turn = turn_at(recording, i, markers, shape);
        for (std::size_t k = 0; k < markers.size(); ++k) {
            const Vector3d now = place(recording, i, markers[k]);
            if (!now.allFinite()) continue;
            sums[k] += turn.undone(now);
            ++counts[k];
        }
    }
    for (std::size_t k = 0; k < markers.size(); ++k) sums[k] /= counts[k];
    return sums;
}

}  // namespace

std::vector<std::string> least_moving(const PointRecording& recording, const std::string& field) {
    const std::size_t count = std::min(recording.labels.size(), kMostCandidates);
    Eigen::MatrixXd pairs = Eigen::MatrixXd::Zero(static_cast<Index>(count), static_cast<Index>(count));
    for (std::size_t a = 0; a < count; ++a) {
        for (std::size_t b = a + 1; b < count; ++b) {
            const double unsteady = unsteadiness(recording, a, b);
            pairs(static_cast<Index>(a), static_cast<Index>(b)) = unsteady;
            pairs(static_cast<Index>(b), static_cast<Index>(a)) = unsteady;
        }
    }
    Triple best = steadiest_triple(recording, pairs);
    if (!(best.unsteady <= kLoosest))
        throw InputError(field, "no three points that keep their distances",
                         "head markers: name them with --head-markers");
    const auto triple = best.labels;
    for (std::size_t p = 0; p < count; ++p) {
        const bool keeps = std::ranges::all_of(triple, [&](std::size_t t) {
            return t != p &&
                   pairs(static_cast<Index>(p), static_cast<Index>(t)) <= 2 * best.unsteady + kMarkerNoise;
        });
        if (keeps) best.labels.push_back(p);
    }
    std::ranges::sort(best.labels);
    std::vector<std::string> labels;
    for (const std::size_t label : best.labels) labels.push_back(recording.labels[label]);
    return labels;
}

HeadMotion head_motion(const PointRecording& recording, const std::vector<std::string>& markers) {
    const std::vector<std::size_t> indices = indices_of(recording, markers);
    Points shape = first_places(recording, indices);
    if (shape.empty())
        throw InputError("--head-markers", "never all seen at once", "one frame that sees them all");
    if (spread(shape) < kLeastSpread)
        throw InputError("--head-markers", "markers on a line", "three that are not");
    shape = mean_shape(recording, indices, shape);
    const RigidTurn first = turn_at(recording, 0, indices, shape);
    for (Vector3d& point : shape) point = first(point);
    Vector3d middle = Vector3d::Zero();
    for (const Vector3d& point : shape) middle += point / static_cast<double>(shape.size());
    HeadMotion head;
    for (const std::size_t index : indices) head.markers.push_back(recording.labels[index]);
    double squares = 0;
    for (std::size_t i = 0; i < recording.size(); ++i) {
        const RigidTurn turn = turn_at(recording, i, indices, shape);
        squares += turn.residual_mm * turn.residual_mm;
        head.widest_turn_degrees = std::max(
            head.widest_turn_degrees,
            2 * std::atan2(turn.turn.vec().norm(), std::abs(turn.turn.w())) * 180 / std::numbers::pi);
        head.farthest_shift_mm = std::max(head.farthest_shift_mm, (turn(middle) - middle).norm());
        head.frames.push_back(turn);
    }
    head.residual_mm = std::sqrt(squares / static_cast<double>(recording.size()));
    return head;
}

PointRecording without_head(PointRecording recording, const HeadMotion& head) {
    for (std::size_t i = 0; i < recording.size(); ++i) {
        for (std::size_t p = 0; p < recording.labels.size(); ++p) {
            recording.positions.block<1, 3>(static_cast<Index>(i), static_cast<Index>(3 * p)) =
                head.frames[i].undone(place(recording, i, p)).transpose();
        }
    }
    return recording;
}

}  // namespace viaface

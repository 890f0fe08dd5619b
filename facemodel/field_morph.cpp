#include "facemodel/field_morph.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace viaface {
namespace {

using Eigen::Vector2d;

Vector2d perpendicular(const Vector2d& v) { return {-v.y(), v.x()}; }

bool has_length(const MorphLine& line) { return (line.to - line.from).norm() > 1e-9; }

double distance_to(const MorphLine& line, const Vector2d& place) {
    const Vector2d along = line.to - line.from;
    const double u = std::clamp((place - line.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (place - (line.from + u * along)).norm();
}

Vector2d carried(const MorphLine& source, const MorphLine& target, const Vector2d& place) {
    const Vector2d along = source.to - source.from, goal = target.to - target.from;
    const double u = (place - source.from).dot(along) / along.squaredNorm();
    const double v = (place - source.from).dot(perpendicular(along)) / along.norm();
    return target.from + u * goal + v * perpendicular(goal) / goal.norm();
}

}  // namespace

FieldMorph::FieldMorph(std::vector<MorphLine> source, std::vector<MorphLine> target,
                       FieldMorphOptions options)
    : source_(std::move(source)), target_(std::move(target)), options_(options) {
    if (source_.empty() || source_.size() != target_.size()) {
        throw std::invalid_argument("FieldMorph: as many lines after as before, at least one");
    }
    if (!std::ranges::all_of(source_, has_length) || !std::ranges::all_of(target_, has_length)) {
        throw std::invalid_argument("FieldMorph: a line without length");
    }
}

Vector2d FieldMorph::operator()(const Vector2d& place) const {
    Vector2d sum = Vector2d::Zero();
    double weights = 0;
    for (std::size_t i = 0; i < source_.size(); ++i) {
        const double length = (source_[i].to - source_[i].from).norm();
        const double weight = std::pow(
            std::pow(length, options_.p) / (options_.a + distance_to(source_[i], place)), options_.b);
        sum += weight * (carried(source_[i], target_[i], place) - place);
        weights += weight;
    }
    return place + sum / weights;
}

}  // namespace viaface

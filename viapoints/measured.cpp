#include "viapoints/measured.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/error.hpp"

namespace viaface {
namespace {

using Eigen::Index;

bool measured_at(const RowMatrix& positions, Index sample, int point) {
    return positions.block<1, 3>(sample, 3 * point).allFinite();
}

bool missing_at(const RowMatrix& positions, Index sample, int point) {
    return positions.block<1, 3>(sample, 3 * point).array().isNaN().all();
}

}  // namespace

std::vector<int> measured_points(const RowMatrix& positions, const std::string& field) {
    if (positions.cols() != kCoordinates) throw std::invalid_argument("positions need 114 columns");
    std::vector<int> points;
    for (int point = 0; point < kPoints; ++point) {
        const bool measured = positions.rows() > 0 && measured_at(positions, 0, point);
        for (Index i = 0; i < positions.rows(); ++i) {
            if (measured ? measured_at(positions, i, point) : missing_at(positions, i, point)) continue;
            throw InputError(field, std::string(point_name(point)) + " at sample " + std::to_string(i),
                             "a point measured at every sample or at none");
        }
        if (measured) points.push_back(point);
    }
    if (points.empty()) throw InputError(field, "no measured point", "at least one point and one sample");
    return points;
}

RowMatrix coordinates_of(const RowMatrix& positions, const std::vector<int>& points) {
    RowMatrix packed(positions.rows(), static_cast<Index>(3 * points.size()));
    for (Index row = 0; row < positions.rows(); ++row) {
        for (std::size_t i = 0; i < points.size(); ++i)
            packed.block<1, 3>(row, static_cast<Index>(3 * i)) = positions.block<1, 3>(row, 3 * points[i]);
    }
    return packed;
}

double longest_triple(const Eigen::Ref<const RowMatrix>& triples) {
    double longest = 0;
    for (Index row = 0; row < triples.rows(); ++row) {
        for (Index i = 0; i + 2 < triples.cols(); i += 3) {
            longest = std::max(longest, triples.block<1, 3>(row, i).squaredNorm());
        }
    }
    return std::sqrt(longest);
}

}  // namespace viaface

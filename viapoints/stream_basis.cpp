#include "viapoints/stream_basis.hpp"

#include <algorithm>
#include <bitset>
#include <cmath>

#include "base/decompositions.hpp"
#include "viapoints/measured.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr double kModeOne = 32767;
constexpr double kIndependent = 0.02;  // of the square of a mode of length 1

double rounded_entry(double entry) {
    return std::clamp(std::round(entry * kModeOne), -kModeOne, kModeOne) / kModeOne;
}

RowMatrix left_over(const ConfigurationBasis& basis, const std::vector<int>& points,
                    const RowMatrix& positions) {
    const RowMatrix drawn = to_points(basis, fitted_components(basis, points, positions));
    return coordinates_of(positions - drawn, points);
}

Eigen::VectorXd leading_direction(const RowMatrix& rows) {
    return symmetric_eigen(rows.transpose() * rows).vectors.rightCols(1);
}

}  // namespace

ConfigurationBasis stored_basis(const ConfigurationBasis& basis) {
    return {basis.mean.cast<float>().cast<double>(), basis.modes.unaryExpr(&rounded_entry)};
}

void put_point_set(ByteWriter& writer, const std::vector<int>& points) {
    std::bitset<8 * ((kPoints + 7) / 8)> set;
    for (const int p : points) set.set(static_cast<std::size_t>(p));
    for (std::size_t byte = 0; byte < set.size() / 8; ++byte) {
        std::uint8_t bits = 0;
        for (std::size_t i = 0; i < 8; ++i) bits |= static_cast<std::uint8_t>(set[8 * byte + i] << i);
        writer.put(bits);
    }
}

std::vector<int> take_point_set(ByteReader& reader) {
    std::vector<int> points;
    for (int byte = 0; byte < (kPoints + 7) / 8; ++byte) {
        const auto bits = reader.get<std::uint8_t>();
        for (int i = 0; i < 8; ++i) {
            if (((bits >> i) & 1) == 0) continue;
            if (8 * byte + i >= kPoints) throw std::runtime_error("a point beyond the layout's");
            points.push_back(8 * byte + i);
        }
    }
    if (points.empty()) throw std::runtime_error("no points");
    return points;
}

void put_mean(ByteWriter& writer, const ConfigurationBasis& basis) {
    const std::vector<int> points = points_of(basis);
    put_point_set(writer, points);
    for (const int p : points)
        for (int axis = 0; axis < 3; ++axis) writer.put(static_cast<float>(basis.mean[3 * p + axis]));
}

Configuration take_mean(ByteReader& reader) {
    Configuration mean = Configuration::Constant(std::nan(""));
    for (const int p : take_point_set(reader)) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto value = static_cast<double>(reader.get<float>());
            if (!(std::abs(value) <= 1e6)) throw std::runtime_error("a mean over 1e6 mm");
            mean[3 * p + axis] = value;
        }
    }
    return mean;
}

void put_modes(ByteWriter& writer, const ConfigurationBasis& basis, Index from) {
    writer.put(static_cast<std::uint8_t>(basis.size() - from));
    for (Index k = from; k < basis.size(); ++k)
        for (const int p : points_of(basis))
            for (int axis = 0; axis < 3; ++axis)
                writer.put(static_cast<std::int16_t>(std::lround(basis.modes(3 * p + axis, k) * kModeOne)));
}

Eigen::MatrixXd take_modes(ByteReader& reader, const std::vector<int>& points) {
    const int count = reader.get<std::uint8_t>();
    if (count > kMostStreamComponents)
        throw std::runtime_error(std::to_string(count) + " modes, at most 114");
    Eigen::MatrixXd modes = Eigen::MatrixXd::Zero(kCoordinates, count);
    for (Index k = 0; k < count; ++k)
        for (const int p : points)
            for (int axis = 0; axis < 3; ++axis)
                modes(3 * p + axis, k) = reader.get<std::int16_t>() / kModeOne;
    return modes;
}

RowMatrix fitted_components(const ConfigurationBasis& basis, const std::vector<int>& points,
                            const RowMatrix& positions) {
    const RowMatrix off =
        coordinates_of(positions, points).rowwise() - coordinates_of(basis.mean.transpose(), points).row(0);
    if (basis.size() == 0) return RowMatrix(positions.rows(), 0);
    const Eigen::MatrixXd modes = coordinates_of(basis.modes.transpose(), points).transpose();
    return least_squares(modes, Eigen::MatrixXd(off.transpose())).transpose();
}

ConfigurationBasis extended_basis(const ConfigurationBasis& basis, const std::vector<int>& points,
                                  const RowMatrix& positions, double max_error_mm) {
    ConfigurationBasis more = basis;
    while (more.size() < kMostStreamComponents) {
        const RowMatrix rest = left_over(more, points, positions);
        if (longest_triple(rest) <= max_error_mm) break;
        const Eigen::VectorXd direction = leading_direction(rest);
        more.modes.conservativeResize(Eigen::NoChange, more.size() + 1);
        more.modes.rightCols(1).setZero();
        for (std::size_t i = 0; i < points.size(); ++i)
            more.modes.block<3, 1>(3 * points[i], more.size() - 1) =
                direction.segment<3>(static_cast<Index>(3 * i)).unaryExpr(&rounded_entry);
    }
    return more;
}

bool ReachedDirections::leaves(const Eigen::VectorXd& mode) const {
    return beyond(mode).squaredNorm() > kIndependent;
}

void ReachedDirections::add(const Eigen::VectorXd& mode) {
    const Eigen::VectorXd direction = beyond(mode).normalized();
    directions_.conservativeResize(Eigen::NoChange, directions_.cols() + 1);
    directions_.rightCols(1) = direction;
}

Eigen::VectorXd ReachedDirections::beyond(const Eigen::VectorXd& mode) const {
    return mode - directions_ * (directions_.transpose() * mode);
}

std::vector<int> independent_modes(const ConfigurationBasis& basis, const std::vector<int>& points,
                                   int count) {
    const Eigen::MatrixXd packed = coordinates_of(basis.modes.transpose(), points);
    ReachedDirections reached(packed.cols());
    std::vector<int> modes;
    for (int i = 0; i < count; ++i) {
        if (!reached.leaves(packed.row(i).transpose())) continue;
        reached.add(packed.row(i).transpose());
        modes.push_back(i);
    }
    return modes;
}

std::vector<int> needed_modes(const ConfigurationBasis& basis, const std::vector<int>& points,
                              const RowMatrix& positions, double max_error_mm) {
    constexpr Index kMostRows = 2000;
    const Index stride = positions.rows() / kMostRows + 1;
    const RowMatrix rows = positions(Eigen::seq(0, Eigen::last, stride), Eigen::all);
    const auto left = [&](const std::vector<int>& modes) {
        return left_over({basis.mean, basis.modes(Eigen::all, modes)}, points, rows);
    };
    const Eigen::MatrixXd packed = coordinates_of(basis.modes.transpose(), points);
    ReachedDirections reached(packed.cols());
    std::vector<int> modes;
    for (RowMatrix rest = left(modes);
         longest_triple(rest) > max_error_mm && modes.size() < kMostStreamComponents; rest = left(modes)) {
        Eigen::VectorXd taken = (packed * rest.transpose()).rowwise().squaredNorm().array() /
                                packed.rowwise().squaredNorm().array();
        for (Index i = 0; i < taken.size(); ++i)
            if (!reached.leaves(packed.row(i).transpose())) taken[i] = -1;
        Index best = 0;
        if (taken.size() == 0 || taken.maxCoeff(&best) <= 0) break;
        reached.add(packed.row(best).transpose());
        modes.insert(std::upper_bound(modes.begin(), modes.end(), static_cast<int>(best)),
                     static_cast<int>(best));
    }
    for (std::size_t i = modes.size(); i-- > 0;) {
        std::vector<int> fewer = modes;
        fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
        if (!fewer.empty() && longest_triple(left(fewer)) <= max_error_mm) modes = std::move(fewer);
    }
    return modes;
}

}  // namespace viaface

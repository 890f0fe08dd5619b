#include "viapoints/stream_directions.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "base/decompositions.hpp"
#include "viapoints/measured.hpp"
#include "viapoints/range_coder.hpp"
#include "viapoints/stream_basis.hpp"
#include "viapoints/stream_packets.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr int kEntryBits = 10;
constexpr int kWhole = 1 << kEntryBits;
constexpr double kSpent = 0.5;      // of the error allowed, less than which more directions do not win
constexpr double kRounding = 0.15;  // of the error allowed, that a weight's rounding may move the points
constexpr std::uint8_t kEvenChance = 128;
constexpr std::uint8_t kChanceTrust = 4;  // sightings with which a told chance starts

struct WeightCoder {
    std::array<AdaptiveBit, kEntryBits + 1> longer;

    // |weight| at most kWhole, which has 11 digits
    template <class Coder>
    int code(Coder& coder, int weight) {
        const auto size = static_cast<std::uint32_t>(std::abs(weight));
        const int wanted = std::bit_width(size);
        int digits = 0;
        while (digits <= kEntryBits && coder.bit(longer[static_cast<std::size_t>(digits)], wanted > digits))
            ++digits;
        if (digits == 0) return 0;
        const bool negative = coder.even(weight < 0, 1) != 0;
        const std::uint32_t top = 1u << (digits - 1);
        const auto coded = static_cast<int>(top + coder.even(size & (top - 1), digits - 1));
        return negative ? -coded : coded;
    }
};

template <class Coder>
void code_weights(Coder& coder, Eigen::MatrixXi& weights) {
    WeightCoder one;
    for (Index d = 0; d < weights.cols(); ++d)
        for (Index i = 0; i < weights.rows(); ++i) weights(i, d) = one.code(coder, weights(i, d));
}

// The coarsest one at which rounding moves points little, where they go `furthest` along a direction.
int shift_for(double furthest, double max_error_mm) {
    const double unit = furthest / kWhole;
    return std::clamp(static_cast<int>(std::floor(std::log2(kRounding * max_error_mm / unit))), 0,
                      kMostShift - 1);
}

struct Span {
    std::vector<int> modes;      // independent ones of the basis
    Eigen::MatrixXd packed;      // [coordinates x modes]
    Eigen::MatrixXd directions;  // of the same span, orthonormal
};

Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& modes) {
    Eigen::MatrixXd directions = modes;
    for (Index k = 0; k < modes.cols(); ++k) {
        for (int twice = 0; twice < 2; ++twice)
            directions.col(k) -=
                directions.leftCols(k) * (directions.leftCols(k).transpose() * directions.col(k)).eval();
        directions.col(k).normalize();
    }
    return directions;
}

// The leading direction of `rest` within the span, as weights of the basis's modes.
StreamDirections leading_in(const Span& span, Index all_modes, const RowMatrix& rest, double max_error_mm) {
    const Eigen::VectorXd direction = symmetric_eigen(rest.transpose() * rest).vectors.rightCols(1);
    const Eigen::VectorXd weights = least_squares(span.packed, direction);
    const double furthest = (rest * direction).cwiseAbs().maxCoeff();
    StreamDirections one{
        Eigen::MatrixXi::Zero(all_modes, 1), {shift_for(furthest, max_error_mm)}, {kEvenChance}};
    const double largest = std::max(1.0, weights.cwiseAbs().maxCoeff());
    for (std::size_t i = 0; i < span.modes.size(); ++i)
        one.weights(span.modes[i], 0) = static_cast<int>(
            std::lround(std::ldexp(weights[static_cast<Index>(i)] / largest, kEntryBits - one.shift[0])));
    return one;
}

void append(StreamDirections& directions, const StreamDirections& one) {
    directions.weights.conservativeResize(one.weights.rows(), directions.count() + 1);
    directions.weights.rightCols(1) = one.weights;
    directions.shift.push_back(one.shift[0]);
    directions.chance.push_back(one.chance[0]);
}

}  // namespace

Eigen::MatrixXd modes_along(const ConfigurationBasis& basis, const StreamDirections& directions) {
    Eigen::MatrixXd modes =
        basis.modes.leftCols(directions.weights.rows()) * directions.weights.cast<double>();
    for (Index d = 0; d < modes.cols(); ++d)
        modes.col(d) *= std::ldexp(1.0, directions.shift[static_cast<std::size_t>(d)] - kEntryBits);
    return modes;
}

void put_directions(ByteWriter& writer, const StreamDirections& directions) {
    writer.put(static_cast<std::uint8_t>(directions.count()));
    writer.put(static_cast<std::uint8_t>(directions.weights.rows()));
    for (const int shift : directions.shift) writer.put(static_cast<std::uint8_t>(shift));
    writer.put_bytes(directions.chance);
    RangeEncoder encoder;
    Eigen::MatrixXi told = directions.weights;
    code_weights(encoder, told);
    const Bytes bytes = encoder.finish();
    put_varint(writer, static_cast<std::uint32_t>(bytes.size()));
    writer.put_bytes(bytes);
}

StreamDirections take_directions(ByteReader& reader) {
    StreamDirections directions;
    const int count = reader.get<std::uint8_t>(), modes = reader.get<std::uint8_t>();
    if (count > kMostStreamComponents)
        throw std::runtime_error(std::to_string(count) + " directions, at most 114");
    for (int d = 0; d < count; ++d) {
        directions.shift.push_back(reader.get<std::uint8_t>());
        if (directions.shift.back() > kMostShift)
            throw std::runtime_error("a shift of " + std::to_string(directions.shift.back()) +
                                     ", at most 10");
    }
    const auto chance = reader.take(static_cast<std::size_t>(count));
    directions.chance.assign(chance.begin(), chance.end());
    directions.weights = Eigen::MatrixXi::Zero(modes, count);
    RangeDecoder decoder(reader.take(take_varint(reader)));
    code_weights(decoder, directions.weights);
    return directions;
}

StreamDirections needed_directions(const ConfigurationBasis& basis, const std::vector<int>& points,
                                   const RowMatrix& positions, double max_error_mm) {
    const auto packed = [&](const Eigen::MatrixXd& modes) -> Eigen::MatrixXd {
        return coordinates_of(modes.transpose(), points).transpose();
    };
    Span span{independent_modes(basis, points, static_cast<int>(basis.size())), {}, {}};
    span.packed = packed(basis.modes(Eigen::all, span.modes));
    span.directions = orthonormal(span.packed);
    RowMatrix rest =
        coordinates_of(positions, points).rowwise() - coordinates_of(basis.mean.transpose(), points).row(0);
    const RowMatrix wanted = rest;
    StreamDirections directions{Eigen::MatrixXi(basis.size(), 0), {}, {}};
    ReachedDirections reached(span.packed.rows());
    while (directions.count() < static_cast<Index>(span.modes.size()) &&
           longest_triple(rest) > max_error_mm) {
        const RowMatrix within = rest * span.directions * span.directions.transpose();
        if (longest_triple(within) < kSpent * max_error_mm) break;
        StreamDirections more = directions;
        append(more, leading_in(span, basis.size(), within, max_error_mm));
        const Eigen::MatrixXd taken = packed(modes_along(basis, more));
        if (!reached.leaves(taken.rightCols(1))) break;
        reached.add(taken.rightCols(1));
        directions = std::move(more);
        rest = wanted - (taken * least_squares(taken, Eigen::MatrixXd(wanted.transpose()))).transpose();
    }
    return directions;
}

void set_chances(StreamStatistics& statistics, std::size_t first, const std::vector<std::uint8_t>& chance) {
    for (std::size_t d = 0; d < chance.size(); ++d) {
        ValueContexts& value = statistics.value[first + d];
        value = {};
        const auto one = static_cast<std::uint16_t>(256 * chance[d] + 128);
        for (auto& row : value.any)
            for (auto& active : row) active.fill({one, kChanceTrust});
    }
}

}  // namespace viaface

#include "viapoints/stream_blends.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/decompositions.hpp"
#include "viapoints/measured.hpp"
#include "viapoints/range_coder.hpp"
#include "viapoints/stream_basis.hpp"
#include "viapoints/stream_packets.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr double kDeadZone = 0.65;  // of the smallest size, below which a weight is 0

struct WeightCoder {
    AdaptiveBit any;
    std::array<AdaptiveBit, kLargestBlend - 1> more;

    template <class Coder>
    int code(Coder& coder, int weight) {
        if (!coder.bit(any, weight != 0)) return 0;
        const bool negative = coder.even(weight < 0, 1) != 0;
        int size = 1;
        while (size < kLargestBlend &&
               coder.bit(more[static_cast<std::size_t>(size - 1)], std::abs(weight) > size))
            ++size;
        return negative ? -size : size;
    }
};

template <class Coder>
void code_weights(Coder& coder, BlendWeights& weights, const std::vector<int>& shared) {
    WeightCoder one;
    for (Index b = 0; b < weights.cols(); ++b)
        for (Index i = 0; i < weights.rows(); ++i)
            if (!std::binary_search(shared.begin(), shared.end(), static_cast<int>(i)))
                weights(i, b) = one.code(coder, weights(i, b));
}

double longest_in(const RowMatrix& rows, Index i) { return longest_triple(rows.row(i)); }

// The direction within the span of `others` in which most is left, far-off rows counting most.
Eigen::VectorXd direction_of(const RowMatrix& rest, const Eigen::MatrixXd& taken,
                             const Eigen::MatrixXd& others) {
    Eigen::MatrixXd both(taken.rows(), taken.cols() + others.cols());
    both << taken, others;
    const Eigen::MatrixXd parts =
        least_squares(both, Eigen::MatrixXd(rest.transpose())).bottomRows(others.cols());
    RowMatrix within = (others * parts).transpose();
    for (Index i = 0; i < within.rows(); ++i) {
        const double far = longest_in(rest, i);
        within.row(i) *= far * far;
    }
    const SymmetricEigen directions = symmetric_eigen(within.transpose() * within);
    return least_squares(others, Eigen::VectorXd(directions.vectors.rightCols(1)));
}

int rounded_weight(double weight) {
    if (std::abs(weight) < kDeadZone * kBlendSizes[1]) return 0;
    int nearest = 1;
    for (int n = 2; n <= kLargestBlend; ++n) {
        const auto off = [&](int m) {
            return std::abs(std::abs(weight) - kBlendSizes[static_cast<std::size_t>(m)]);
        };
        if (off(n) < off(nearest)) nearest = n;
    }
    return weight < 0 ? -nearest : nearest;
}

Eigen::VectorXi rounded_weights(const Eigen::VectorXd& parts) {
    return (parts / parts.cwiseAbs().maxCoeff()).unaryExpr(&rounded_weight);
}

std::vector<int> others_of(const ConfigurationBasis& basis, const std::vector<int>& shared) {
    std::vector<int> others;
    for (int i = 0; i < static_cast<int>(basis.size()); ++i)
        if (!std::binary_search(shared.begin(), shared.end(), i)) others.push_back(i);
    return others;
}

}  // namespace

Eigen::MatrixXd blended_modes(const ConfigurationBasis& basis, const BlendWeights& weights) {
    return basis.modes.leftCols(weights.rows()) * weights.unaryExpr([](int weight) {
        const double size = kBlendSizes[static_cast<std::size_t>(std::abs(weight))];
        return weight < 0 ? -size : size;
    });
}

void put_blends(ByteWriter& writer, const BlendWeights& weights, const std::vector<int>& shared) {
    RangeEncoder encoder;
    BlendWeights told = weights;
    code_weights(encoder, told, shared);
    const Bytes bytes = encoder.finish();
    writer.put(static_cast<std::uint8_t>(weights.cols()));
    writer.put(static_cast<std::uint8_t>(weights.rows()));
    put_varint(writer, static_cast<std::uint32_t>(bytes.size()));
    writer.put_bytes(bytes);
}

BlendWeights take_blends(ByteReader& reader, const std::vector<int>& shared) {
    const Index blends = reader.get<std::uint8_t>(), modes = reader.get<std::uint8_t>();
    if (blends > kMostStreamComponents)
        throw std::runtime_error(std::to_string(blends) + " blends, at most 114");
    RangeDecoder decoder(reader.take(take_varint(reader)));
    BlendWeights weights = BlendWeights::Zero(modes, blends);
    code_weights(decoder, weights, shared);
    return weights;
}

BlendWeights needed_blends(const ConfigurationBasis& basis, const std::vector<int>& shared,
                           const std::vector<int>& points, const RowMatrix& positions, double max_error_mm) {
    const std::vector<int> others = others_of(basis, shared);
    const auto packed = [&](const Eigen::MatrixXd& modes) -> Eigen::MatrixXd {
        return coordinates_of(modes.transpose(), points).transpose();
    };
    const Eigen::MatrixXd other_modes = packed(basis.modes(Eigen::all, others));
    const RowMatrix wanted =
        coordinates_of(positions, points).rowwise() - coordinates_of(basis.mean.transpose(), points).row(0);
    Eigen::MatrixXd taken = packed(basis.modes(Eigen::all, shared));
    ReachedDirections reached(taken.rows());
    for (const auto& mode : taken.colwise()) reached.add(mode);
    BlendWeights weights(basis.size(), 0);
    while (weights.cols() < static_cast<Index>(others.size())) {
        const RowMatrix rest =
            wanted - (taken * least_squares(taken, Eigen::MatrixXd(wanted.transpose()))).transpose();
        if (longest_triple(rest) <= max_error_mm) break;
        BlendWeights next = BlendWeights::Zero(basis.size(), 1);
        next(others, 0) = rounded_weights(direction_of(rest, taken, other_modes));
        const Eigen::VectorXd blend = packed(blended_modes(basis, next));
        if (!reached.leaves(blend)) break;
        reached.add(blend);
        taken.conservativeResize(Eigen::NoChange, taken.cols() + 1);
        taken.rightCols(1) = blend;
        weights.conservativeResize(Eigen::NoChange, weights.cols() + 1);
        weights.rightCols(1) = next;
    }
    return weights;
}

}  // namespace viaface

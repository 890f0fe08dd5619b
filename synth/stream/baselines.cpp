#include "synth/stream/baselines.hpp"

#include <lzma.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/error.hpp"
#include "viapoints/measured.hpp"
#include "viapoints/range_coder.hpp"

namespace viaface {
namespace {

using Eigen::Index;
using Integers = Eigen::Matrix<std::int32_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr int kHalvings = 9;  // of the interval in which the step is searched

struct Off {
    double largest = 0, rms = 0;
};

Off off_by(const Motion& motion, const ConfigurationBasis& basis, const RowMatrix& components) {
    const RowMatrix off = coordinates_of(to_points(basis, components) - motion.positions, points_of(basis));
    return {longest_triple(off), std::sqrt(off.squaredNorm() / static_cast<double>(off.size() / 3))};
}

// The largest step within the bound, as far as error rises with it.
template <class Quantised>
std::optional<BaselineBits> widest(double bound_mm, const Quantised& quantised) {
    double low = bound_mm / 64, high = bound_mm * 8;
    std::optional<BaselineBits> best;
    for (int i = 0; i < kHalvings; ++i) {
        const double step = std::sqrt(low * high);
        BaselineBits tried = quantised(step);
        if (tried.max_error_mm <= bound_mm) {
            best = tried;
            low = step;
        } else {
            high = step;
        }
    }
    return best;
}

// Orthonormal, type II: [block x block].
RowMatrix dct(int block) {
    RowMatrix c(block, block);
    for (Index f = 0; f < block; ++f)
        for (Index t = 0; t < block; ++t)
            c(f, t) =
                std::sqrt((f == 0 ? 1.0 : 2.0) / block) *
                std::cos(std::numbers::pi * (static_cast<double>(t) + 0.5) * static_cast<double>(f) / block);
    return c;
}

// Blocks one below the other, the last one filled with its last sample: [blocks * block x k].
RowMatrix transformed(const RowMatrix& components, const RowMatrix& c) {
    const Index block = c.rows(), blocks = (components.rows() + block - 1) / block;
    RowMatrix all(blocks * block, components.cols());
    all.topRows(components.rows()) = components;
    for (Index i = components.rows(); i < all.rows(); ++i) all.row(i) = components.bottomRows(1);
    for (Index b = 0; b < blocks; ++b)
        all.middleRows(b * block, block) = (c * all.middleRows(b * block, block)).eval();
    return all;
}

RowMatrix restored(const RowMatrix& coefficients, const RowMatrix& c, Index samples) {
    RowMatrix all(coefficients.rows(), coefficients.cols());
    for (Index b = 0; b < coefficients.rows() / c.rows(); ++b)
        all.middleRows(b * c.rows(), c.rows()) =
            c.transpose() * coefficients.middleRows(b * c.rows(), c.rows());
    return all.topRows(samples);
}

// `zero` is half the width of what becomes 0, in steps: 0.5 rounds, more widens the dead zone.
Integers quantised(const RowMatrix& values, double step, double zero) {
    return values.unaryExpr([&](double v) {
        const double size = std::abs(v) / step;
        return static_cast<std::int32_t>(std::copysign(size < zero ? 0 : std::max(1.0, std::round(size)), v));
    });
}

struct CoefficientContexts {
    AdaptiveBit any[3], more[14], beyond;
};

class CoefficientCoder {
  public:
    CoefficientCoder(Index components, Index block)
        : block_(block), contexts_(static_cast<std::size_t>(components * block)) {}

    void code(RangeEncoder& encoder, const Integers& q) {
        for (Index b = 0; b < q.rows() / block_; ++b) {
            for (Index k = 0; k < q.cols(); ++k) {
                int near = 0;  // of the two coefficients before, and the same one of the block before
                for (Index f = 0; f < block_; ++f) {
                    const Index row = b * block_ + f;
                    const int before = (b > 0 && q(row - block_, k) != 0) + (near != 0);
                    code(encoder, contexts_[static_cast<std::size_t>(k * block_ + f)], before, q(row, k));
                    near = (near << 1 | (q(row, k) != 0)) & 3;
                }
            }
        }
    }

  private:
    void code(RangeEncoder& encoder, CoefficientContexts& c, int before, std::int32_t value) {
        if (!encoder.bit(c.any[before], value != 0)) return;
        encoder.even(value < 0, 1);
        int size = 1;
        while (size <= 14 && encoder.bit(c.more[size - 1], std::abs(value) > size)) ++size;
        if (size <= 14) return;
        const auto rest = static_cast<std::uint32_t>(std::abs(value) - 14);
        int bits = 0;
        while (encoder.bit(c.beyond, (rest >> bits) > 1)) ++bits;
        encoder.even(rest & ((1u << bits) - 1), bits);
    }

    Index block_;
    std::vector<CoefficientContexts> contexts_;
};

ConfigurationBasis leading(const ConfigurationBasis& basis, Index modes) {
    return {basis.mean, basis.modes.leftCols(modes)};
}

BaselineBits with_xz(const Integers& q) {
    std::vector<std::uint8_t> deltas;
    for (Index k = 0; k < q.cols(); ++k) {
        for (Index i = 0; i < q.rows(); ++i) {
            const auto d = static_cast<std::uint16_t>(q(i, k) - (i > 0 ? q(i - 1, k) : 0));
            deltas.push_back(static_cast<std::uint8_t>(d));
            deltas.push_back(static_cast<std::uint8_t>(d >> 8));
        }
    }
    std::vector<std::uint8_t> packed(lzma_stream_buffer_bound(deltas.size()));
    std::size_t size = 0;
    if (lzma_easy_buffer_encode(9 | LZMA_PRESET_EXTREME, LZMA_CHECK_CRC32, nullptr, deltas.data(),
                                deltas.size(), packed.data(), &size, packed.size()) != LZMA_OK)
        throw std::runtime_error("xz does not pack");
    BaselineBits bits;
    bits.bits = 8 * static_cast<double>(size);
    return bits;
}

BaselineBits fewest(const std::vector<std::optional<BaselineBits>>& tried, double bound_mm) {
    std::optional<BaselineBits> best;
    for (const auto& one : tried)
        if (one && (!best || one->bits < best->bits)) best = one;
    if (!best) throw InputError("max_error_mm", std::to_string(bound_mm), "a bound that the basis can hold");
    return *best;
}

}  // namespace

BaselineBits dct_bits(const Motion& motion, const Motion& training, const ConfigurationBasis& basis,
                      double bound_mm) {
    std::vector<std::optional<BaselineBits>> tried;
    for (Index k = basis.size(); k >= 1; --k) {
        const ConfigurationBasis used = leading(basis, k);
        if (truncation_error_mm(used, motion.positions) > 0.6 * bound_mm) break;
        const RowMatrix own = to_components(used, motion.positions),
                        other = to_components(used, training.positions);
        for (const int block : {16, 32, 64}) {
            const RowMatrix c = dct(block), mine = transformed(own, c), theirs = transformed(other, c);
            for (const double zero : {0.5, 0.6, 0.7}) {
                auto found = widest(bound_mm, [&](double step) {
                    const Integers q = quantised(mine, step, zero);
                    const Off off = off_by(motion, used, restored(q.cast<double>() * step, c, own.rows()));
                    return BaselineBits{0, off.largest, off.rms, static_cast<int>(k), block, step};
                });
                if (!found) continue;
                CoefficientCoder coder(k, block);
                RangeEncoder priming, encoder;
                coder.code(priming, quantised(theirs, found->step_mm, zero));
                coder.code(encoder, quantised(mine, found->step_mm, zero));
                found->bits = 8 * static_cast<double>(encoder.finish().size());
                tried.push_back(found);
            }
        }
    }
    return fewest(tried, bound_mm);
}

BaselineBits delta_xz_bits(const Motion& motion, const ConfigurationBasis& basis, double bound_mm) {
    const RowMatrix own = to_components(basis, motion.positions);
    const auto found = widest(bound_mm, [&](double step) {
        const Off off = off_by(motion, basis, quantised(own, step, 0.5).cast<double>() * step);
        return BaselineBits{0, off.largest, off.rms, static_cast<int>(basis.size()), 0, step};
    });
    if (!found) return fewest({}, bound_mm);
    BaselineBits bits = *found;
    bits.bits = with_xz(quantised(own, found->step_mm, 0.5)).bits;
    return bits;
}

}  // namespace viaface

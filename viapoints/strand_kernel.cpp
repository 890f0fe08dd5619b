// Compiled once per instruction set, which VIAFACE_KERNEL names.
#include "viapoints/strand_kernel.hpp"

#if defined(__AVX__)
#include <immintrin.h>
#endif

#define VIAFACE_INLINE inline __attribute__((always_inline))

namespace viaface::strands::VIAFACE_KERNEL {
namespace {

typedef double Four __attribute__((vector_size(sizeof(Lanes)), may_alias));

constexpr double kLeastEmphasis = 1e-3;
constexpr double kSingular = 1e-12;
constexpr int kOfPoints = 3;  // vectors: x, y and z

VIAFACE_INLINE Four four(double value) { return Four{} + value; }
VIAFACE_INLINE const Four& from(const Lanes* lanes) { return *reinterpret_cast<const Four*>(lanes); }
VIAFACE_INLINE Four& into(Lanes* lanes) { return *reinterpret_cast<Four*>(lanes); }
VIAFACE_INLINE Four greater(Four a, Four b) { return a > b ? a : b; }
VIAFACE_INLINE int smaller(int a, int b) { return a < b ? a : b; }
VIAFACE_INLINE int larger(int a, int b) { return a > b ? a : b; }
VIAFACE_INLINE double sum_of(Four v) { return (v[0] + v[1]) + (v[2] + v[3]); }

VIAFACE_INLINE Four root(Four v) {
#if defined(__AVX__)
    return _mm256_sqrt_pd(v);
#else
    for (int i = 0; i < kLanes; ++i) v[i] = __builtin_sqrt(v[i]);
    return v;
#endif
}

// Rows that name the same control points, the first of which is `control`.
struct Run {
    std::ptrdiff_t begin, end, control;
};
VIAFACE_INLINE Run run_of(const FitRows& s, std::ptrdiff_t i) {
    return {s.starts[i], s.starts[i + 1], s.rows[s.starts[i]].first};
}

// The control points that rows of free ones may name.
struct Range {
    std::ptrdiff_t begin, end;
};
VIAFACE_INLINE Range named(const FitRows& s) {
    return {larger(0, s.free_begin - kSupport + 1),
            smaller(s.controls + kSupport - 1, s.free_end + kSupport - 1)};
}

// The products of some rows' weights from the r-th of six on: as many as there are registers for.
template <int kFrom, int kTo>
VIAFACE_INLINE void add_products(const FitRows& s, const Run& run, const Lanes* emphasis, Lanes* band) {
    Four sum[kTo - kFrom][kSupport] = {};
    for (std::ptrdiff_t i = run.begin; i < run.end; ++i) {
        const double* weight = s.rows[i].weight;
#pragma GCC unroll 8
        for (int r = kFrom; r < kTo; ++r) {
            const Four emphasised = weight[r] * from(emphasis + i);
#pragma GCC unroll 8
            for (int c = r; c < kSupport; ++c) sum[r - kFrom][c - r] += weight[c] * emphasised;
        }
    }
#pragma GCC unroll 8
    for (int r = kFrom; r < kTo; ++r) {
#pragma GCC unroll 8
        for (int c = r; c < kSupport; ++c)
            into(band + (run.control + r) * kSupport + c - r) += sum[r - kFrom][c - r];
    }
}

void factor(const FitRows& s, const Lanes* emphasis, Lanes* band, Lanes* factors) {
    for (auto [i, end] = named(s); i < end; ++i)
        for (int j = 0; j < kSupport; ++j) into(band + i * kSupport + j) = Four{};
    for (std::ptrdiff_t i = 0; i < s.runs; ++i) {
        add_products<0, 2>(s, run_of(s, i), emphasis, band);
        add_products<2, kSupport>(s, run_of(s, i), emphasis, band);
    }
    const int n = s.free_end - s.free_begin;
    for (std::ptrdiff_t i = 0; i < n * kSupport; ++i)
        into(factors + i) = from(band + s.free_begin * kSupport + i);
    for (int i = 0; i < n; ++i) {
        Lanes* row = factors + i * kSupport;
        const Four inverse = 1 / greater(from(row), four(kSingular));
        into(row) = inverse;
        for (int j = 1; j < smaller(kSupport, n - i); ++j) {
            const Four ratio = from(row + j) * inverse;
            Lanes* below = row + j * kSupport;
            for (int c = j; c < smaller(kSupport, n - i); ++c) into(below + c - j) -= ratio * from(row + c);
            into(row + j) = ratio;
        }
    }
}

// Right sides of the normal equations.
VIAFACE_INLINE void gather(const FitRows& s, const Lanes* emphasis, int vectors, const Lanes* value,
                           Lanes* right) {
    for (auto [i, end] = named(s); i < end; ++i)
        for (int k = 0; k < vectors; ++k) into(right + i * vectors + k) = Four{};
    for (std::ptrdiff_t n = 0; n < s.runs; ++n) {
        const Run run = run_of(s, n);
        for (int k = 0; k < vectors; ++k) {
            Four sum[kSupport] = {};
            for (std::ptrdiff_t i = run.begin; i < run.end; ++i) {
                const Four sample = from(emphasis + i) * from(value + i * vectors + k);
#pragma GCC unroll 8
                for (int r = 0; r < kSupport; ++r) sum[r] += s.rows[i].weight[r] * sample;
            }
#pragma GCC unroll 8
            for (int r = 0; r < kSupport; ++r) into(right + (run.control + r) * vectors + k) += sum[r];
        }
    }
}

// Takes what is known of the control points that are not free from the right sides.
VIAFACE_INLINE void move_held(const FitRows& s, const Lanes* band, int vectors, const Lanes* control,
                              Lanes* right) {
    const int begin = s.free_begin, end = s.free_end;
    const auto move = [&](int to, const Four& share, int held) __attribute__((always_inline)) {
        for (int k = 0; k < vectors; ++k)
            into(right + to * vectors + k) -= share * from(control + held * vectors + k);
    };
    for (int i = larger(0, begin - kSupport + 1); i < begin; ++i)
        for (int j = begin - i; j < kSupport; ++j) move(i + j, from(band + i * kSupport + j), i);
    for (int i = larger(begin, end - kSupport + 1); i < end; ++i)
        for (int j = end - i; j < smaller(kSupport, s.controls - i); ++j)
            move(i, from(band + i * kSupport + j), i + j);
}

// From right sides to control points, by the factors.
VIAFACE_INLINE void substitute(const FitRows& s, const Lanes* factors, int vectors, Lanes* right,
                               Lanes* control) {
    const int begin = s.free_begin, n = s.free_end - begin;
    for (int i = 0; i < n; ++i) {
        const Lanes* row = factors + i * kSupport;
        Lanes* own = right + (begin + i) * vectors;
        for (int j = 1; j < smaller(kSupport, n - i); ++j)
            for (int k = 0; k < vectors; ++k) into(own + j * vectors + k) -= from(row + j) * from(own + k);
    }
    for (int i = n - 1; i >= 0; --i) {
        const Lanes* row = factors + i * kSupport;
        for (int k = 0; k < vectors; ++k) {
            Lanes* found = control + (begin + i) * vectors + k;
            Four value = from(right + (begin + i) * vectors + k) * from(row);
            // the one just found comes last: the others need not wait for it
            for (int j = smaller(kSupport, n - i) - 1; j > 0; --j)
                value -= from(row + j) * from(found + j * vectors);
            into(found) = value;
        }
    }
}

VIAFACE_INLINE void solve_vectors(const FitRows& s, const Lanes* band, const Lanes* factors,
                                  const Lanes* emphasis, int vectors, const Lanes* value, Lanes* right,
                                  Lanes* control) {
    gather(s, emphasis, vectors, value, right);
    move_held(s, band, vectors, control, right);
    substitute(s, factors, vectors, right, control);
}

void solve(const FitRows& s, const Lanes* band, const Lanes* factors, const Lanes* emphasis, int vectors,
           const Lanes* value, Lanes* right, Lanes* control) {
    if (vectors == kOfPoints)
        return solve_vectors(s, band, factors, emphasis, kOfPoints, value, right, control);
    solve_vectors(s, band, factors, emphasis, vectors, value, right, control);
}

// Calls with each sample's index, a vector's and its value less the spline.
VIAFACE_INLINE void for_left(const FitRows& s, int vectors, const Lanes* value, const Lanes* control,
                             const auto& visit) {
    for (std::ptrdiff_t n = 0; n < s.runs; ++n) {
        const Run run = run_of(s, n);
        for (int k = 0; k < vectors; ++k) {
            Four near[kSupport];
#pragma GCC unroll 8
            for (int r = 0; r < kSupport; ++r) near[r] = from(control + (run.control + r) * vectors + k);
            for (std::ptrdiff_t i = run.begin; i < run.end; ++i) {
                Four rest = from(value + i * vectors + k);
#pragma GCC unroll 8
                for (int r = 0; r < kSupport; ++r) rest -= s.rows[i].weight[r] * near[r];
                visit(i, k, rest);
            }
        }
    }
}

void leave(const FitRows& s, int vectors, const Lanes* value, const Lanes* control, Lanes* left) {
    for_left(
        s, vectors, value,
        control, [&](std::ptrdiff_t i, int k, const Four& rest) __attribute__((always_inline)) {
            into(left + i * vectors + k) = rest;
        });
}

VIAFACE_INLINE void miss_vectors(const FitRows& s, int vectors, const Lanes* value, const Lanes* control,
                                 Lanes* miss) {
    for_left(
        s, vectors, value,
        control, [&](std::ptrdiff_t i, int k, const Four& rest) __attribute__((always_inline)) {
            into(miss + i) = k == 0 ? rest * rest : from(miss + i) + rest * rest;
        });
}

void miss(const FitRows& s, int vectors, const Lanes* value, const Lanes* control, Lanes* miss) {
    if (vectors == kOfPoints) return miss_vectors(s, kOfPoints, value, control, miss);
    miss_vectors(s, vectors, value, control, miss);
}

Misses judge(std::ptrdiff_t samples, const Lanes* emphasis, const Lanes* miss) {
    Four largest{}, weighted{}, sum{};
    for (std::ptrdiff_t i = 0; i < samples; ++i) {
        largest = greater(largest, from(miss + i));
        weighted += from(emphasis + i) * from(miss + i);
        sum += from(emphasis + i);
    }
    Misses misses;
    into(&misses.largest) = largest;
    into(&misses.weighted) = weighted;
    into(&misses.emphasis) = sum;
    return misses;
}

void emphasise(std::ptrdiff_t samples, const Lanes* miss, const Lanes* largest, Lanes* emphasis) {
    const auto changing = from(largest) > 0;
    const Four share = 1 / (changing ? from(largest) : four(1));
    Four sum{};
    for (std::ptrdiff_t i = 0; i < samples; ++i) {
        const Four growth = root(from(miss + i) * share) + kLeastEmphasis;
        into(emphasis + i) *= changing ? growth : four(1);
        sum += from(emphasis + i);
    }
    const Four scale = changing ? double(samples) / sum : four(1);
    for (std::ptrdiff_t i = 0; i < samples; ++i) into(emphasis + i) *= scale;
}

bool even(std::ptrdiff_t samples, const Lanes* emphasis) {
    auto other = Four{} != Four{};
    for (std::ptrdiff_t i = 0; i < samples; ++i) other |= from(emphasis + i) != four(1);
    return (other[0] | other[1] | other[2] | other[3]) == 0;
}

double strain(std::ptrdiff_t samples, const Lanes* miss, double limit) {
    Four sum{};
    for (std::ptrdiff_t i = 0; i < samples; ++i) {
        const Four share = from(miss + i) * (1 / limit), squared = share * share;
        sum += squared * squared;
    }
    return sum_of(sum);
}

double jump(const double* weights, const Lanes* const* control, int vectors) {
    Four sum{};
    for (int k = 0; k < vectors; ++k) {
        Four jump{};
        for (int i = 0; i < kSupport + 1; ++i) jump += weights[i] * from(control[i] + k);
        sum += jump * jump;
    }
    return sum_of(sum);
}

}  // namespace

extern const StrandKernel kernel;
const StrandKernel kernel = {factor, solve, leave, miss, judge, emphasise, even, strain, jump};

}  // namespace viaface::strands::VIAFACE_KERNEL

#include "viapoints/stream_learn.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "base/decompositions.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr double kTowardsAll = 6;     // as many via points as speak for the weights of all gaps together
constexpr double kTowardsPlain = 10;  // and for predicting the last value
constexpr double kTowardsParent = 4, kTowardsPrior = 4, kRarely = 0.03;
constexpr std::uint8_t kTrust = 20;  // sightings with which a learned probability starts

struct Counts {
    double all = 0, ones = 0;
};
using CountsOf = std::unordered_map<const AdaptiveBit*, Counts>;  // looked up, never gone through

struct Counter {
    CountsOf& counts;
    bool bit(AdaptiveBit& context, bool value) {
        Counts& seen = counts[&context];
        seen.all += 1;
        seen.ones += value;
        return value;
    }
    std::uint32_t even(std::uint32_t value, int) { return value; }
};

struct Normal {  // normal equations of one value in one class of gap
    Eigen::MatrixXd a;
    Eigen::VectorXd b;
};

void add_events(const QuantisedSegment& segment, int j, std::vector<Normal>& classes) {
    const ViaValues zeros(segment.values[0].size());
    std::vector<double> f;
    for (std::size_t n = 0; n < segment.values.size(); ++n) {
        const ViaPast past = past_of(segment.values, n, zeros);
        const int c = row_class(past, n > 0 ? segment.tick[n] - segment.tick[n - 1] : 0);
        put_features(j, past, segment.values[n], f);
        const Eigen::Map<const Eigen::VectorXd> x(f.data(), static_cast<Index>(f.size()));
        Normal& normal = classes[static_cast<std::size_t>(c)];
        normal.a += x * x.transpose();
        normal.b += x * segment.values[n][static_cast<std::size_t>(j)];
    }
}

// The weights nearest to `prior` that fit, `strength` events of typical size speaking for the prior.
Eigen::VectorXd solved(const Normal& normal, const Eigen::VectorXd& prior, double strength,
                       const Eigen::VectorXd& typical) {
    Eigen::MatrixXd a = normal.a;
    const Eigen::VectorXd ridge = strength * typical;
    a.diagonal() += ridge;
    return solve_positive(a, Eigen::VectorXd(normal.b + ridge.cwiseProduct(prior)));
}

void learn_weights(const std::vector<QuantisedSegment>& segments, int j, StreamStatistics& statistics) {
    const auto size = static_cast<Index>(StreamStatistics::features(statistics.components, j));
    std::vector<Normal> classes(kRowClasses,
                                {Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size)});
    double events = 0;
    for (const QuantisedSegment& segment : segments) {
        add_events(segment, j, classes);
        events += static_cast<double>(segment.values.size());
    }
    Normal all = classes[0];
    for (int c = 1; c < kStartClass; ++c) {
        all.a += classes[static_cast<std::size_t>(c)].a;
        all.b += classes[static_cast<std::size_t>(c)].b;
    }
    const Eigen::VectorXd typical = (all.a.diagonal().array() + 1.0) / std::max(events, 1.0);
    Eigen::VectorXd plain = Eigen::VectorXd::Zero(size);
    plain[1 + j] = 1;
    const Eigen::VectorXd together = solved(all, plain, kTowardsPlain, typical);
    for (int c = 0; c < kRowClasses; ++c) {
        const Normal& own = classes[static_cast<std::size_t>(c)];
        const Eigen::VectorXd w = c == kStartClass ? solved(own, Eigen::VectorXd::Zero(size), 1, typical)
                                                   : solved(own, together, kTowardsAll, typical);
        for (Index i = 0; i < size; ++i)
            statistics.weights[statistics.weights_at(j, c) + static_cast<std::size_t>(i)] =
                static_cast<std::int32_t>(std::lround(4096 * std::clamp(w[i], -1e4, 1e4)));
    }
}

// Counts of some contexts become probabilities near what all of them together say, that near `prior`.
template <std::size_t kContexts>
void settle(const CountsOf& counts, const std::array<AdaptiveBit*, kContexts>& bits, double prior) {
    const auto of = [&](const AdaptiveBit* bit) {
        const auto at = counts.find(bit);
        return at == counts.end() ? Counts{} : at->second;
    };
    Counts together;
    for (const AdaptiveBit* bit : bits) {
        together.all += of(bit).all;
        together.ones += of(bit).ones;
    }
    const double parent = (together.ones + kTowardsPrior * prior) / (together.all + kTowardsPrior);
    for (AdaptiveBit* bit : bits) {
        const Counts own = of(bit);
        const double one = (own.ones + kTowardsParent * parent) / (own.all + kTowardsParent);
        bit->one = static_cast<std::uint16_t>(std::clamp(std::lround(65536 * one), long{AdaptiveBit::kLeast},
                                                         long{65536 - AdaptiveBit::kLeast}));
        bit->sightings = kTrust;
    }
}

void settle_value(const CountsOf& counts, ValueContexts& value) {
    std::array<AdaptiveBit*, kRowClasses * ValueContexts::kActivities * 3> any{};
    std::size_t n = 0;
    for (auto& row : value.any)
        for (auto& active : row)
            for (AdaptiveBit& bit : active) any[n++] = &bit;
    settle(counts, any, kRarely);
    for (auto& sides : value.negative)
        for (AdaptiveBit& side : sides) settle<1>(counts, {&side}, 0.5);
    for (n = 0; n < kUnaryLimit; ++n)
        settle<4>(counts, {&value.more[0][n], &value.more[1][n], &value.more[2][n], &value.more_still[n]},
                  0.5);
}

void learn_probabilities(const std::vector<QuantisedSegment>& segments, StreamStatistics& statistics) {
    CountsOf counts;
    Counter counter{counts};
    ViaCoder<Counter> coder(counter, std::move(statistics));
    for (const QuantisedSegment& segment : segments) code_segment(coder, segment);
    StreamStatistics& known = coder.known();
    for (ValueContexts& value : known.value) settle_value(counts, value);
    for (std::size_t n = 0; n < kMostGapTicks; ++n) {
        std::array<AdaptiveBit*, kGapContexts> longer{};
        for (std::size_t c = 0; c < kGapContexts; ++c) longer[c] = &known.gap.longer[c][n];
        settle(counts, longer, 0.7);
    }
    settle<1>(counts, {&known.beyond}, 0.5);
    statistics = std::move(known);
}

}  // namespace

StreamStatistics learn_statistics(const std::vector<QuantisedSegment>& segments, int components,
                                  double bound_mm, double step_mm) {
    StreamStatistics statistics = plain_statistics(components);
    statistics.bound_mm = bound_mm;
    statistics.step_mm = step_mm;
    for (int j = 0; j < components; ++j) learn_weights(segments, j, statistics);
    learn_probabilities(segments, statistics);
    return statistics;
}

}  // namespace viaface

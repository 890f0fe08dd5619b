#include "viapoints/stream_learn.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace viaface {
namespace {

using Eigen::Index;

constexpr double kTowardsAll = 6;     // as many via points as speak for the weights of all gaps together
constexpr double kTowardsPlain = 10;  // and for predicting the last value
constexpr std::uint8_t kTrust = 30;   // sightings with which a learned probability starts

struct Meter {
    bool bit(AdaptiveBit& context, bool value) {
        context.see(value);
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
        const int c = n > 0 ? gap_class(segment.tick[n] - segment.tick[n - 1]) : kStartClass;
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
    return a.ldlt().solve(normal.b + ridge.cwiseProduct(prior));
}

void learn_weights(const std::vector<QuantisedSegment>& segments, int j, StreamStatistics& statistics) {
    const auto size = static_cast<Index>(StreamStatistics::features(statistics.components, j));
    std::vector<Normal> classes(kGapClasses,
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
    for (int c = 0; c < kGapClasses; ++c) {
        const Normal& own = classes[static_cast<std::size_t>(c)];
        const Eigen::VectorXd w = c == kStartClass ? solved(own, Eigen::VectorXd::Zero(size), 1, typical)
                                                   : solved(own, together, kTowardsAll, typical);
        for (Index i = 0; i < size; ++i)
            statistics.weights[statistics.weights_at(j, c) + static_cast<std::size_t>(i)] =
                static_cast<std::int32_t>(std::lround(4096 * std::clamp(w[i], -1e4, 1e4)));
    }
}

}  // namespace

StreamStatistics learn_statistics(const std::vector<QuantisedSegment>& segments, int components,
                                  double bound_mm, double step_mm) {
    StreamStatistics statistics = plain_statistics(components);
    statistics.bound_mm = bound_mm;
    statistics.step_mm = step_mm;
    for (int j = 0; j < components; ++j) learn_weights(segments, j, statistics);
    Meter meter;
    for (const QuantisedSegment& segment : segments) {
        ViaCoder<Meter> coder(meter, statistics);
        code_segment(coder, segment);
        statistics = coder.known();
    }
    for_each_bit(statistics, [](AdaptiveBit& bit) { bit.sightings = std::min(bit.sightings, kTrust); });
    return statistics;
}

}  // namespace viaface

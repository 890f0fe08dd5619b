#include "synth/training/gestures.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viaface {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double kLipLead = 0.025, kJawLead = 0.010, kClosureLead = 0.026;  // s
constexpr double kClosureLeadShare = 0.3;  // of the phone: a short closure leads less, to stay inside
constexpr double kHeldUntil = 0.85;        // of the phone: what is left is its release
constexpr double kHoldLead = 0.010;        // s, before that
constexpr double kHeldShare = 0.45;        // of a bilabial's target: past contact still
constexpr double kVelocityTime = 0.020;    // a, s
constexpr double kJerkTime = 0.022;        // b, s
constexpr double kEdgeShare = 0.15;        // of the window: a gesture grows and fades within its phone
constexpr double kFirstUntil = 0.45, kSecondFrom = 0.65;  // of the phone: the two windows of a glide
constexpr double kFloor = 1e-4;                           // of dominance, towards rest
constexpr double kEndPull = 100;                          // at rest at both ends

// How much of a vowel's targets and dominance is left, by stress digit.
struct Reduction {
    double target, dominance;
};
constexpr Reduction kReduction[] = {{0.85, 0.8}, {1, 1}, {0.93, 0.9}};

struct Pull {
    double target, dominance, begin_s, end_s, reach_s;
};

Reduction reduction_of(const TimedPhone& phone) {
    const PhoneInfo& info = phone_info(phone.phone);
    const bool always_weak = info.name == "ax";
    return info.vowel && !always_weak ? kReduction[phone.stress] : Reduction{1, 1};
}

Pull closure_pull(const Gesture& gesture, double begin, double end) {
    const double lead = std::min(kClosureLead, kClosureLeadShare * (end - begin));
    const double instant = (begin + end) / 2 - lead;
    return {gesture.target, gesture.dominance, instant, instant, gesture.reach_ms / 1000};
}

// What keeps a closure until the sound is released: lips stay in contact less deeply than they met, teeth and
// lip as they met.
Pull hold_pull(const Gesture& gesture, VisemeClass viseme, double begin, double end) {
    const double share = viseme == VisemeClass::kBilabial ? kHeldShare : 1;
    const double until = begin + kHeldUntil * (end - begin) - kHoldLead;
    return {share * gesture.target, gesture.dominance, until, until, gesture.reach_ms / 1000};
}

bool is_held(VisemeClass viseme) {
    return viseme == VisemeClass::kBilabial || viseme == VisemeClass::kLabiodental;
}

Pull sustained_pull(const Gesture& gesture, double lead, double begin, double end) {
    const double edge = kEdgeShare * (end - begin);
    return {gesture.target, gesture.dominance, begin + edge - lead, end - edge - lead,
            gesture.reach_ms / 1000};
}

std::vector<Pull> pulls_of(const PhoneSequence& phones, int channel) {
    std::vector<Pull> pulls;
    const double lead = channel == kJaw ? kJawLead : kLipLead;
    for (std::size_t i = 0; i < phones.phones.size(); ++i) {
        const auto parts = gestures_of(phones.phones[i].phone);
        const Reduction reduction = reduction_of(phones.phones[i]);
        const double begin = phones.begin_s(i), end = phones.end_s(i), length = end - begin;
        for (std::size_t part = 0; part < parts.size(); ++part) {
            Gesture g = parts[part][static_cast<std::size_t>(channel)];
            g.target *= reduction.target;
            g.dominance *= reduction.dominance;
            const double from = part == 1 ? begin + kSecondFrom * length : begin;
            const double to = part == 0 && parts.size() == 2 ? begin + kFirstUntil * length : end;
            const bool closes = g.dominance >= kInstant;
            pulls.push_back(closes ? closure_pull(g, from, to) : sustained_pull(g, lead, from, to));
            const VisemeClass viseme = phone_info(phones.phones[i].phone).viseme;
            if (closes && is_held(viseme)) pulls.push_back(hold_pull(g, viseme, from, to));
        }
    }
    return pulls;
}

// weight (x - goal/weight)^2 at each sample.
struct Field {
    ArrayXd weight, goal;
};

Field field_of(const std::vector<Pull>& pulls, double rest, Index samples) {
    constexpr double kFarthest = 4;  // reaches: less than 2e-7 of the dominance lies beyond
    Field field{ArrayXd::Constant(samples, kFloor), ArrayXd::Constant(samples, kFloor * rest)};
    for (const Pull& pull : pulls) {
        const double margin = kFarthest * pull.reach_s;
        const Index first = std::max<Index>(0, std::lround((pull.begin_s - margin) * kGestureRate));
        const Index last =
            std::min(samples - 1, static_cast<Index>(std::lround((pull.end_s + margin) * kGestureRate)));
        for (Index k = first; k <= last; ++k) {
            const double t = static_cast<double>(k) / kGestureRate;
            const double away = std::max({pull.begin_s - t, t - pull.end_s, 0.0}) / pull.reach_s;
            const double weight = pull.dominance * std::exp(-away * away);
            field.weight(k) += weight;
            field.goal(k) += weight * pull.target;
        }
    }
    for (const Index end : {Index(0), samples - std::min<Index>(3, samples)}) {
        field.weight.segment(end, std::min<Index>(3, samples)) += kEndPull;
        field.goal.segment(end, std::min<Index>(3, samples)) += kEndPull * rest;
    }
    return field;
}

// The symmetric band matrix of the smoothness terms: row d holds the d-th lower diagonal.
using Band = Eigen::Array<double, 4, Eigen::Dynamic>;

void add_difference(Band& band, const std::vector<double>& stencil, double scale) {
    const Index width = static_cast<Index>(stencil.size());
    for (Index i = 0; i + width <= band.cols(); ++i) {
        for (Index p = 0; p < width; ++p) {
            for (Index q = p; q < width; ++q) {
                band(q - p, i + p) +=
                    scale * stencil[static_cast<std::size_t>(p)] * stencil[static_cast<std::size_t>(q)];
            }
        }
    }
}

Band smoothness(Index samples) {
    Band band = Band::Zero(4, samples);
    add_difference(band, {-1, 1}, std::pow(kVelocityTime * kGestureRate, 2));
    add_difference(band, {-1, 3, -3, 1}, std::pow(kJerkTime * kGestureRate, 6));
    return band;
}

// Solves the positive definite system by L D L' within the band.
ArrayXd solve_band(Band a, ArrayXd x) {
    const Index n = x.size();
    for (Index j = 0; j < n; ++j) {
        const Index below = std::min<Index>(3, n - 1 - j);
        for (Index d = 1; d <= below; ++d) {
            const double l = a(d, j) / a(0, j);
            for (Index e = d; e <= below; ++e) a(e - d, j + d) -= l * a(e, j);
            x(j + d) -= l * x(j);
        }
    }
    for (Index j = n - 1; j >= 0; --j) {
        for (Index d = 1; d <= std::min<Index>(3, n - 1 - j); ++d) x(j) -= a(d, j) * x(j + d);
        x(j) /= a(0, j);
    }
    return x;
}

}  // namespace

std::array<double, kChannels> resting_channels() {
    const Gestures& pause = gestures_of(kPause).front();
    std::array<double, kChannels> rest;
    std::ranges::transform(pause, rest.begin(), &Gesture::target);
    return rest;
}

ChannelMotion gesture(const PhoneSequence& phones) {
    if (phones.phones.empty()) throw std::invalid_argument("no phones to perform");
    const double end = phones.end_s(phones.phones.size() - 1);
    const Index samples = static_cast<Index>(std::ceil(end * kGestureRate - 1e-9)) + 1;
    ChannelMotion motion;
    for (Index k = 0; k < samples; ++k) motion.time_s.push_back(static_cast<double>(k) / kGestureRate);
    motion.channels.resize(samples, kChannels);
    const Band smooth = smoothness(samples);
    const std::array<double, kChannels> rest = resting_channels();
    for (int channel = 0; channel < kChannels; ++channel) {
        const Field field =
            field_of(pulls_of(phones, channel), rest[static_cast<std::size_t>(channel)], samples);
        Band system = smooth;
        system.row(0) += field.weight.transpose();
        motion.channels.col(channel) = solve_band(std::move(system), field.goal).matrix();
    }
    return motion;
}

}  // namespace viaface

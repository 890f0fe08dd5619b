#include "viapoints/rest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr double kRestWindow = 0.2;    // s
constexpr double kClosedShare = 0.25;  // of the recording
constexpr double kSame = 0.1;          // mm, of openings

// The lips' opening in the file, by the innermost pair measured; NaN without one.
double opening(const Configuration& c) {
    for (const auto& [top, bottom] :
         {std::pair{kInnerTop, kInnerBottom}, {kBorderTop, kBorderBottom}, {kLipTop, kLipBottom}}) {
        const double mm = (point_of(c, top) - point_of(c, bottom)).norm();
        if (!std::isnan(mm)) return mm;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

// Mean squared speed of the points from a sample to the next, mm^2/s^2.
double squared_speed(const Motion& motion, std::size_t i) {
    const double step = motion.time_s[i + 1] - motion.time_s[i];
    double sum = 0;
    int count = 0;
    const Configuration way = motion.at(i + 1) - motion.at(i);
    for (int p = 0; p < kPoints; ++p) {
        if (!point_of(way, p).allFinite()) continue;
        sum += point_of(way, p).squaredNorm() / (step * step);
        ++count;
    }
    return count == 0 ? std::numeric_limits<double>::infinity() : sum / count;
}

struct Span {
    std::size_t first, behind;
};

Configuration mean_over(const Motion& motion, Span span) {
    Configuration mean = Configuration::Constant(std::numeric_limits<double>::quiet_NaN());
    for (int k = 0; k < kCoordinates; ++k) {
        double sum = 0;
        int count = 0;
        for (std::size_t i = span.first; i < span.behind; ++i) {
            const double value = motion.positions(static_cast<Index>(i), k);
            if (std::isnan(value)) continue;
            sum += value;
            ++count;
        }
        if (count > 0) mean[k] = sum / count;
    }
    return mean;
}

// Every point that the motion ever has is there.
bool is_whole(const Motion& motion, const Configuration& mean) {
    for (int p = 0; p < kPoints; ++p) {
        const bool ever = !motion.positions.middleCols<3>(3 * p).array().isNaN().all();
        if (ever && !point_of(mean, p).allFinite()) return false;
    }
    return true;
}

// Openings up to this one are closed; infinite without lips.
double closed_limit(const Motion& motion) {
    std::vector<double> openings;
    for (std::size_t i = 0; i < motion.size(); ++i) {
        const double mm = opening(motion.at(i));
        if (!std::isnan(mm)) openings.push_back(mm);
    }
    if (openings.empty()) return std::numeric_limits<double>::infinity();
    const auto at = openings.begin() +
                    static_cast<std::ptrdiff_t>(kClosedShare * static_cast<double>(openings.size() - 1));
    std::nth_element(openings.begin(), at, openings.end());
    return *at;
}

std::size_t first_from(const Motion& motion, double time_s) {
    return static_cast<std::size_t>(std::ranges::lower_bound(motion.time_s, time_s) - motion.time_s.begin());
}

bool is_within(const std::vector<TimeSpan>& quiet_s, double from_s, double to_s) {
    return std::ranges::any_of(
        quiet_s, [&](const TimeSpan& span) { return from_s >= span.first && to_s <= span.second; });
}

// Without quiet times anywhere; nothing where no window serves.
std::optional<Span> found_rest(const Motion& motion, const std::vector<TimeSpan>& quiet_s) {
    const double limit = closed_limit(motion);
    std::vector<double> sums = {0};  // of squared speeds
    for (std::size_t i = 0; i + 1 < motion.size(); ++i)
        sums.push_back(sums.back() + squared_speed(motion, i));
    Span best{0, 0};
    double least = std::numeric_limits<double>::infinity();
    std::size_t behind = 0;
    for (std::size_t i = 0; i < motion.size(); ++i) {
        while (behind < motion.size() && motion.time_s[behind] < motion.time_s[i] + kRestWindow) ++behind;
        const bool whole_window = behind < motion.size() || i == 0;
        if (!whole_window || behind < i + 2) continue;
        const double speed = (sums[behind - 1] - sums[i]) / static_cast<double>(behind - 1 - i);
        if (speed >= least) continue;
        if (!quiet_s.empty() && !is_within(quiet_s, motion.time_s[i], motion.time_s[behind - 1])) continue;
        const Configuration mean = mean_over(motion, {i, behind});
        if (!is_whole(motion, mean) || opening(mean) > limit + kSame) continue;
        least = speed;
        best = {i, behind};
    }
    return best.behind == 0 ? std::nullopt : std::optional(best);
}

}  // namespace

Rest rest_of(const Motion& motion, const std::optional<TimeSpan>& given_s,
             const std::vector<TimeSpan>& quiet_s) {
    Span span{};
    if (given_s) {
        span = {first_from(motion, given_s->first), first_from(motion, given_s->second)};
        const std::string given = std::to_string(given_s->first) + "-" + std::to_string(given_s->second);
        if (span.behind <= span.first) throw InputError("--rest", given, "a time within the motion, in s");
        if (!is_whole(motion, mean_over(motion, span)))
            throw InputError("--rest", given, "a time at which every point is measured");
    } else {
        std::optional<Span> found;
        if (!quiet_s.empty()) found = found_rest(motion, quiet_s);
        if (!found) found = found_rest(motion, {});
        if (!found) throw InputError("--rest", "not to be found", "T0-T1 in s, where the face is at rest");
        span = *found;
    }
    return {mean_over(motion, span), motion.time_s[span.first], motion.time_s[span.behind - 1]};
}

}  // namespace viaface

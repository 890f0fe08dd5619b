#include "viapoints/codex_cut.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "viapoints/lip_rows.hpp"
#include "viapoints/spline.hpp"
#include "viapoints/via_spacing.hpp"

namespace viaface {
namespace {

// Kept a fifth wider than kMinViaGap, so that rounding in files and small changes of duration do not thin a
// unit again.
constexpr double kRecitedGap = 1.2 * kMinViaGap;
constexpr double kNucleusStep = 0.001;  // s
constexpr double kLastVia = 0.999;      // of the last pause: via times lie before the end

void check(bool holds, const std::string& what) {
    if (!holds) throw std::invalid_argument("recitation: " + what);
}

// Motion at a fixed rate, read between its samples by the cubic through four of them.
class SampledMotion {
  public:
    explicit SampledMotion(const RecitationTake& take)
        : rows_(take.components),
          begin_(take.time_s.front()),
          step_((take.time_s.back() - begin_) / static_cast<double>(take.time_s.size() - 1)) {
        check(step_ <= 0.020 + 1e-9, "under 50 samples per second");
        for (std::size_t i = 0; i < take.time_s.size(); ++i) {
            check(std::abs(take.time_s[i] - (begin_ + static_cast<double>(i) * step_)) < 1e-3 * step_,
                  "the rate is not fixed");
        }
    }

    Eigen::RowVectorXd at(double time_s) const {
        const double x = std::clamp((time_s - begin_) / step_, 0.0, static_cast<double>(rows_.rows() - 1));
        const Eigen::Index i = std::min<Eigen::Index>(static_cast<Eigen::Index>(x), rows_.rows() - 2);
        const double f = x - static_cast<double>(i);
        const auto row = [&](Eigen::Index r) {
            return rows_.row(std::clamp<Eigen::Index>(r, 0, rows_.rows() - 1));
        };
        return 0.5 * (2 * row(i) + f * (row(i + 1) - row(i - 1)) +
                      f * f * (2 * row(i - 1) - 5 * row(i) + 4 * row(i + 1) - row(i + 2)) +
                      f * f * f * (3 * row(i) - row(i - 1) - 3 * row(i + 1) + row(i + 2)));
    }
    double speed_at(double time_s) const {
        return (at(time_s + step_ / 2) - at(time_s - step_ / 2)).norm() / step_;
    }

  private:
    const RowMatrix& rows_;
    double begin_, step_;
};

void check_take(const ConfigurationBasis& basis, const RecitationTake& take) {
    const Eigen::Index k = basis.modes.cols();
    check(take.time_s.size() >= 2 && std::ssize(take.time_s) == take.components.rows(),
          "times and components disagree");
    check(take.components.cols() == k && take.track.points.cols() == k, "components of another basis");
    check(take.components.allFinite(), "components that are not finite");
    const double begin = take.phones.begin_s(0), end = take.phones.end_s(take.phones.phones.size() - 1);
    check(take.time_s.front() <= begin + 0.020 && take.time_s.back() >= end - 0.020,
          "the motion does not cover the phones");
}

// What is least at the nucleus of a phone: how far the lips are apart, how far the lower lip lies below the
// upper teeth's edge (the origin), or the speed.
class Openness {
  public:
    Openness(const ConfigurationBasis& basis, const SampledMotion& motion) : motion_(motion) {
        const std::optional<LipRows> lips = lip_rows(basis);
        check(lips.has_value(), "a basis in which the lips do not move");
        lips_ = *lips;
    }

    double at(ViaRank rank, double time_s) const {
        switch (rank) {
            case ViaRank::kBilabial:
                return lips_.apart.dot(motion_.at(time_s));
            case ViaRank::kLabiodental:
                return -lips_.lower.dot(motion_.at(time_s));
            default:
                return motion_.speed_at(time_s);
        }
    }

  private:
    const SampledMotion& motion_;
    LipRows lips_;
};

struct Span {
    double begin, end;  // s
};

Span span_of(const PhoneSlot& slot, int sample_rate) {
    return {static_cast<double>(slot.begin) / sample_rate, static_cast<double>(slot.end) / sample_rate};
}

// The earliest instant of least openness, so far inside the phone that neighbours' nuclei keep their
// distance.
double nucleus_time(const Openness& openness, PhoneId phone, Span span) {
    const double length = span.end - span.begin;
    const double margin = std::min(std::max(0.15 * length, kRecitedGap / 2), length / 2);
    const int steps = std::max(1, static_cast<int>((length - 2 * margin) / kNucleusStep));
    double best_time = 0, best = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= steps; ++i) {
        const double time = span.begin + margin + (length - 2 * margin) * i / steps;
        const double here = openness.at(nucleus_rank(phone), time);
        if (here < best) std::tie(best, best_time) = std::pair(here, time);
    }
    return best_time;
}

struct RankedTime {
    double time;
    ViaRank rank;
};

RankedTrack without_places(std::vector<RankedTime> times) {
    std::stable_sort(times.begin(), times.end(), [](auto& a, auto& b) { return a.time < b.time; });
    RankedTrack ranked{{{}, RowMatrix(std::ssize(times), 0)}, {}, std::vector<int>(times.size(), 0)};
    for (const auto& [time, rank] : times) {
        ranked.track.time_s.push_back(time);
        ranked.rank.push_back(rank);
    }
    return ranked;
}

std::vector<double> graded(std::vector<double> times) {
    const std::vector<double> added = grading_times(times, kMaxRecitedGapRatio);
    times.insert(times.end(), added.begin(), added.end());
    std::sort(times.begin(), times.end());
    return times;
}

// The via times of the analysis, with every nucleus and both ends, well spaced.
std::vector<double> refined_times(const std::vector<double>& analysed, const std::vector<double>& nuclei,
                                  const std::vector<PhoneSlot>& slots, int sample_rate) {
    const double begin = span_of(slots.front(), sample_rate).begin;
    const Span last = span_of(slots.back(), sample_rate);
    const double end = last.begin + kLastVia * (last.end - last.begin);
    std::vector<RankedTime> times{{begin, ViaRank::kRest}, {end, ViaRank::kRest}};
    for (const double time : analysed) {
        if (time > begin && time < end) times.push_back({time, ViaRank::kPassing});
    }
    for (std::size_t i = 0; i < slots.size(); ++i)
        times.push_back({nuclei[i], nucleus_rank(slots[i].centre)});
    return graded(thinned(without_places(std::move(times)), kRecitedGap, kRecitedGap).track.time_s);
}

ViaPointTrack read_off(const SampledMotion& motion, std::vector<double> times, Eigen::Index k) {
    ViaPointTrack track{std::move(times), {}};
    track.points.resize(std::ssize(track.time_s), k);
    for (Eigen::Index i = 0; i < track.points.rows(); ++i) {
        track.points.row(i) = motion.at(track.time_s[static_cast<std::size_t>(i)]);
    }
    return track;
}

RecitedPhone recited(const PhoneSlot& slot, Span span, double nucleus, const ViaPointTrack& track) {
    RecitedPhone phone{slot.centre, slot.stress, true, span.end - span.begin};
    const auto first = std::lower_bound(track.time_s.begin(), track.time_s.end(), span.begin);
    const auto last = std::lower_bound(first, track.time_s.end(), span.end);
    for (auto via = first; via != last; ++via) {
        phone.via.push_back((*via - span.begin) / phone.duration_s);
        if (std::abs(*via - nucleus) <
            std::abs(track.time_s[static_cast<std::size_t>(first - track.time_s.begin() + phone.nucleus)] -
                     nucleus)) {
            phone.nucleus = static_cast<int>(via - first);
        }
    }
    phone.points = track.points.middleRows(first - track.time_s.begin(), last - first);
    return phone;
}

// How far the farthest point lies from the motion, at every sample, on the spline through the via points.
std::vector<double> misses_mm(const ConfigurationBasis& basis, const RecitationTake& take,
                              const ViaPointTrack& track) {
    const MinimumJerkSpline spline(track, SplineEnd::at_rest(), SplineEnd::at_rest());
    std::vector<double> misses(take.time_s.size(), 0.0);
    for (std::size_t i = 0; i < misses.size(); ++i) {
        const double time = take.time_s[i];
        if (time < track.time_s.front() || time > track.time_s.back()) continue;
        const Configuration difference =
            basis.modes * (spline.at(time) - take.components.row(static_cast<Eigen::Index>(i)).transpose());
        for (int p = 0; p < kPoints; ++p) misses[i] = std::max(misses[i], point_of(difference, p).norm());
    }
    return misses;
}

// One more via time in every gap that misses the motion by over `bound_mm` and has room for it, where it
// misses most.
std::vector<double> mended(const std::vector<double>& times, const std::vector<double>& samples,
                           const std::vector<double>& misses, double bound_mm) {
    std::vector<double> result;
    std::size_t sample = 0;
    for (std::size_t i = 0; i + 1 < times.size(); ++i) {
        result.push_back(times[i]);
        double worst = bound_mm, at = 0;
        for (; sample < samples.size() && samples[sample] < times[i + 1]; ++sample) {
            if (samples[sample] >= times[i] && misses[sample] > worst)
                std::tie(worst, at) = std::pair(misses[sample], samples[sample]);
        }
        const double low = times[i] + kRecitedGap, high = times[i + 1] - kRecitedGap;
        if (worst > bound_mm && low <= high) result.push_back(std::clamp(at, low, high));
    }
    result.push_back(times.back());
    return result;
}

double farthest_in(const Span& span, const std::vector<double>& samples, const std::vector<double>& misses) {
    double farthest = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (samples[i] >= span.begin && samples[i] < span.end) farthest = std::max(farthest, misses[i]);
    }
    return farthest;
}

std::string printed(const char* format, auto... values) {
    char text[160];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

std::string why_dropped(const RecitedPhone& phone, double farthest_mm, const CutLimits& limits) {
    const double longest = phone.phone == kPause ? limits.longest_pause_s : limits.longest_s;
    if (phone.duration_s < limits.shortest_s || phone.duration_s > longest) {
        return printed("%.3f s long, %.3f to %.3f allowed", phone.duration_s, limits.shortest_s, longest);
    }
    if (phone.via.empty()) return "no via point lies in it";
    if (farthest_mm > limits.farthest_mm) {
        return printed("its via points miss the motion by %.2f mm, %.2f allowed", farthest_mm,
                       limits.farthest_mm);
    }
    return {};
}

}  // namespace

CutRecitation cut_recitation(const ConfigurationBasis& basis, const RecitationTake& take,
                             const CutLimits& limits) {
    const std::vector<PhoneSlot> slots = slots_of(take.phones);
    check_take(basis, take);
    const SampledMotion motion(take);
    const Openness openness(basis, motion);
    std::vector<double> nuclei;
    for (const PhoneSlot& slot : slots) {
        nuclei.push_back(nucleus_time(openness, slot.centre, span_of(slot, take.phones.sample_rate)));
    }
    constexpr int kRounds = 4;
    const Eigen::Index k = basis.modes.cols();
    ViaPointTrack track =
        read_off(motion, refined_times(take.track.time_s, nuclei, slots, take.phones.sample_rate), k);
    std::vector<double> misses = misses_mm(basis, take, track);
    for (int round = 0; round < kRounds; ++round) {
        const std::vector<double> more = mended(track.time_s, take.time_s, misses, limits.mended_mm);
        if (more.size() == track.time_s.size()) break;
        track = read_off(motion, graded(more), k);
        misses = misses_mm(basis, take, track);
    }

    CutRecitation cut;
    for (std::size_t i = 0; i < slots.size(); ++i) {
        const Span span = span_of(slots[i], take.phones.sample_rate);
        RecitedPhone phone = recited(slots[i], span, nuclei[i], track);
        const std::string reason = why_dropped(phone, farthest_in(span, take.time_s, misses), limits);
        phone.usable = reason.empty();
        if (!phone.usable) {
            const std::string name(phone_info(slots[i].centre).name);
            cut.dropped.push_back({i, name + printed(" at %.3f s: ", span.begin) + reason});
        }
        cut.recitation.push_back(std::move(phone));
    }
    cut.farthest_mm = *std::max_element(misses.begin(), misses.end());
    return cut;
}

}  // namespace viaface

#include "synth/learn/recorded_takes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.hpp"
#include "base/median.hpp"
#include "base/whole_file.hpp"
#include "synth/align/align.hpp"
#include "synth/align/labelled.hpp"
#include "synth/learn/take_files.hpp"
#include "viapoints/measured.hpp"
#include "viapoints/spline.hpp"

namespace viaface {
namespace {

constexpr std::size_t kBasisSamples = 8000;  // of all takes, half of them for the check
constexpr double kLongestStep = 0.050;       // s, from sample to sample
constexpr double kLearnedStep = 0.020;       // s: units are cut from steps no longer than this
constexpr double kUnevenStep = 0.1;  // of a step, that a sample may lie from where a fixed rate has it

std::string printed(const char* format, auto... values) {
    char text[160];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

// What a part of a take is refused for, with the take's name.
template <class Work>
auto of_file(const std::filesystem::path& file, const std::string& field, Work work) {
    try {
        return work();
    } catch (const InputError& error) {
        const std::string name = file.filename().string();
        const bool named = error.value().find(name) != std::string::npos;
        const bool place = error.field() != field && error.field() != "labels";
        throw InputError(field,
                         (named ? "" : name + ": ") + (place ? error.field() + ": " : "") + error.value(),
                         error.allowed());
    }
}

// Times at a fixed rate, when they nearly were.
void make_even(Motion& motion) {
    const std::size_t n = motion.size();
    if (n < 2) throw InputError("motion", printed("%zu samples", n), "at least two samples");
    const double begin = motion.time_s.front(),
                 step = (motion.time_s.back() - begin) / static_cast<double>(n - 1);
    if (step > kLongestStep + 1e-9)
        throw InputError("motion", printed("%.1f samples a second", 1 / step),
                         "at least 20 samples a second");
    for (std::size_t i = 0; i < n; ++i) {
        const double even = begin + static_cast<double>(i) * step;
        if (std::abs(motion.time_s[i] - even) > kUnevenStep * step) {
            throw InputError("motion", printed("sample %zu at %.4f s", i, motion.time_s[i]),
                             printed("samples at a fixed rate: %.4f s here", even));
        }
        motion.time_s[i] = even;
    }
}

// Motion of a film, at 25 frames a second say, with samples between its own on the minimum-jerk spline
// through them, the same number in each step.
Motion in_learned_steps(Motion motion) {
    const std::size_t steps = motion.size() - 1;
    const double begin = motion.time_s.front(), end = motion.time_s.back();
    const auto parts =
        static_cast<std::size_t>(std::ceil((end - begin) / static_cast<double>(steps) / kLearnedStep - 1e-6));
    if (parts < 2) return motion;
    std::vector<double> times;
    for (std::size_t i = 0; i <= steps * parts; ++i)
        times.push_back(begin + (end - begin) * static_cast<double>(i) / static_cast<double>(steps * parts));
    const MinimumJerkSpline spline({std::move(motion.time_s), std::move(motion.positions)});
    Motion made{.time_s = times, .positions = spline.at(times)};
    return made;
}

Motion motion_of(const std::filesystem::path& file, const MotionReader& read, const PhoneSequence& phones) {
    Motion motion = read(file, phones);
    measured_points(motion.positions, "motion");
    make_even(motion);
    return in_learned_steps(std::move(motion));
}

struct Spoken {
    Utterance utterance;
    double confidence = 1;
};

Spoken spoken_in(const TakeFiles& files, const std::string& field) {
    Recording recording = of_file(files.sound, field, [&] { return read_recording(files.sound, field); });
    if (!files.labels.empty()) {
        return of_file(files.labels, field, [&] {
            const TextGrid grid = read_text_grid(read_text(files.labels, field));
            return Spoken{labelled(grid, std::move(recording.sound), field)};
        });
    }
    return of_file(files.transcript, field, [&] {
        Alignment found = align(recording, pronounced(read_text(files.transcript, field)), field);
        return Spoken{std::move(found.utterance), found.confidence};
    });
}

// The outer pauses cut to where there is motion.
PhoneSequence within(PhoneSequence phones, const Motion& motion) {
    const double rate = phones.sample_rate;
    TimedPhone &first = phones.phones.front(), &last = phones.phones.back();
    first.begin = std::max(first.begin, static_cast<std::int64_t>(std::ceil(motion.time_s.front() * rate)));
    last.end = std::min(last.end, static_cast<std::int64_t>(std::floor(motion.time_s.back() * rate)));
    if (last.end - last.begin < 2 || first.end - first.begin < 2) {
        throw InputError(
            "motion", printed("%.3f to %.3f s", motion.time_s.front(), motion.time_s.back()),
            printed("motion of all phones, %.3f to %.3f s", static_cast<double>(first.end) / rate,
                    static_cast<double>(last.begin) / rate));
    }
    return phones;
}

RecordedTake read_take(const TakeFiles& files, const MotionReader& read_motion, const std::string& field) {
    Spoken spoken = spoken_in(files, field);
    Motion motion = of_file(files.motion, field,
                            [&] { return motion_of(files.motion, read_motion, spoken.utterance.phones); });
    const double sound_s = spoken.utterance.sound.seconds(), motion_s = motion.time_s.back();
    return of_file(files.motion, field, [&] {
        if (std::abs(sound_s - motion_s) > kEndsApart) {
            throw InputError("motion",
                             printed("motion that ends at %.2f s, sound at %.2f s", motion_s, sound_s),
                             printed("both to end within %.2f s of each other", kEndsApart));
        }
        PhoneSequence phones = within(std::move(spoken.utterance.phones), motion);
        return RecordedTake{
            {files.name, std::move(phones), std::move(motion)}, spoken.confidence, files.labels.empty()};
    });
}

std::string told(const RecordedTake& read) {
    const auto& phones = read.take.phones;
    std::string line = printed("%.60s: %.2f s, %zu phones", read.take.name.c_str(),
                               phones.end_s(phones.phones.size() - 1), phones.phones.size());
    return line + (read.aligned ? printed(", aligned with confidence %.2f", read.confidence) : ", labelled");
}

Configuration at_time(const Motion& motion, double time_s) {
    const auto after = std::lower_bound(motion.time_s.begin(), motion.time_s.end(), time_s);
    const auto i = static_cast<std::size_t>(after - motion.time_s.begin());
    return motion.at(std::min(i, motion.size() - 1));
}

Configuration median_of(const std::vector<Configuration>& configurations) {
    Configuration middle;
    std::vector<double> values(configurations.size());
    for (Eigen::Index row = 0; row < middle.size(); ++row) {
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = configurations[i][row];
        middle[row] = median(values);
    }
    return middle;
}

// The points in the middle of the pauses before and after.
std::array<Configuration, 2> rests_of(const Take& take) {
    const auto& phones = take.phones;
    const std::size_t last = phones.phones.size() - 1;
    return {at_time(take.motion, (phones.begin_s(0) + phones.end_s(0)) / 2),
            at_time(take.motion, (phones.begin_s(last) + phones.end_s(last)) / 2)};
}

// Root mean square distance of the points from their centre, mm.
double size_of(const Configuration& c, const std::vector<int>& points) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (const int p : points) centre += point_of(c, p) / static_cast<double>(points.size());
    double sum = 0;
    for (const int p : points) sum += (point_of(c, p) - centre).squaredNorm();
    return std::sqrt(sum / static_cast<double>(points.size()));
}

double mean_distance(const Configuration& a, const Configuration& b, const std::vector<int>& points) {
    double sum = 0;
    for (const int p : points) sum += (point_of(a, p) - point_of(b, p)).norm();
    return sum / static_cast<double>(points.size());
}

// Of the two pauses the one in which the mouth is more as it mostly is: it may open to breathe in the other.
const Configuration& nearest(const Configuration& before, const Configuration& after,
                             const Configuration& rest, const std::vector<int>& points) {
    return mean_distance(after, rest, points) < mean_distance(before, rest, points) ? after : before;
}

void check_same_points(const std::vector<RecordedTake>& takes, const std::string& field) {
    const auto first = measured_points(takes.front().take.motion.positions, field);
    for (const RecordedTake& each : takes) {
        const auto points = measured_points(each.take.motion.positions, field);
        for (int p = 0; p < kPoints; ++p) {
            const bool here = std::binary_search(points.begin(), points.end(), p);
            if (here == std::binary_search(first.begin(), first.end(), p)) continue;
            throw InputError(field,
                             each.take.name + (here ? " holds " : " lacks ") + std::string(point_name(p)),
                             "the same points in every take, as in " + takes.front().take.name);
        }
    }
}

}  // namespace

Configuration common_rest(const std::vector<RecordedTake>& takes, const std::string& field) {
    check_same_points(takes, field);
    const auto points = measured_points(takes.front().take.motion.positions, field);
    std::vector<Configuration> rests;
    for (const RecordedTake& each : takes) {
        for (const Configuration& rest : rests_of(each.take)) rests.push_back(rest);
    }
    const Configuration rest = median_of(rests);
    for (std::size_t i = 0; i < takes.size(); ++i) {
        const Configuration& own = nearest(rests[2 * i], rests[2 * i + 1], rest, points);
        const double scale = size_of(own, points) / size_of(rest, points),
                     apart = mean_distance(own, rest, points);
        if (std::abs(scale - 1) > kOtherScale || apart > kOtherPlace) {
            throw InputError(field,
                             takes[i].take.name +
                                 printed(": %.2f times the size of the others, %.1f mm apart", scale, apart),
                             "one talker's recordings, in one scale and head frame");
        }
    }
    return rest;
}

RecordedTakes read_takes(const std::filesystem::path& folder, const std::string& field,
                         const MotionReader& read_motion,
                         const std::function<void(const std::string&)>& progress) {
    RecordedTakes read;
    for (const TakeFiles& files : find_takes(folder, field)) {
        read.takes.push_back(read_take(files, read_motion, field));
        if (progress) progress(told(read.takes.back()));
    }
    read.rest = common_rest(read.takes, field);
    return read;
}

ConfigurationBasis basis_of(const std::vector<const Take*>& takes, double error_mm) {
    std::size_t samples = 0;
    for (const Take* take : takes) samples += take->motion.size();
    const std::size_t every = std::max<std::size_t>(1, samples / kBasisSamples);
    RowMatrix training(static_cast<Eigen::Index>(samples / every + 1), kCoordinates), held_out = training;
    Eigen::Index trained = 0, held = 0;
    std::size_t sample = 0;
    for (const Take* take : takes) {
        for (std::size_t i = 0; i < take->motion.size(); ++i, ++sample) {
            if (sample % every != 0) continue;
            const bool train = sample / every % 2 == 0;
            (train ? training : held_out).row(train ? trained++ : held++) = take->motion.at(i).transpose();
        }
    }
    return choose_basis(training.topRows(trained), held_out.topRows(held), error_mm);
}

}  // namespace viaface

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <ctime>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "server/via_command.hpp"
#include "synth/film/media_reader.hpp"
#include "synth/motion/via_plot.hpp"
#include "viapoints/analysis.hpp"
#include "viapoints/measured.hpp"
#include "viapoints/motion_csv.hpp"
#include "viapoints/via_stream.hpp"

namespace viaface {
namespace {

constexpr int kSoundRate = 16000;     // Hz, of a plot's sound
constexpr double kBasisShare = 0.25;  // of the bound, that a basis chosen by itself may take
constexpr int kBlocks = 10;           // of a motion, every other one of which is held out

struct Options {
    std::string motion, output, times = "shared", basis = "none", plot, points, audio;
    double max_error_mm = 0.5, max_gap_ratio = AnalysisOptions{}.max_gap_ratio;
    double from_s = 0, seconds = 3;
};

// One track for all coordinates, or one for each.
struct Found {
    std::vector<ViaPointTrack> tracks;  // shared: one of 114 dimensions; else one for each
    std::vector<std::string> names;     // of what tracks are of, when they are separate
    double max_error_mm = 0, worst_time_s = 0, rms_error_mm = 0;
    int worst_point = 0;
    Eigen::Index components = 0;  // of the basis; 0 without one

    bool shared() const { return names.empty(); }
};

// The fewest components that keep held-out stretches within a share of the bound.
ConfigurationBasis held_out_basis(const RowMatrix& positions, double max_error_mm) {
    std::vector<Eigen::Index> rows[2];
    for (Eigen::Index i = 0; i < positions.rows(); ++i) rows[kBlocks * i / positions.rows() % 2].push_back(i);
    const RowMatrix training = positions(rows[0], Eigen::all), held_out = positions(rows[1], Eigen::all);
    const auto size = choose_basis(training, held_out, kBasisShare * max_error_mm).size();
    return principal_basis(positions, size);
}

ConfigurationBasis asked_basis(const Options& options, const RowMatrix& positions) {
    if (options.basis == "auto") return held_out_basis(positions, options.max_error_mm);
    int size = 0;
    const char* end = options.basis.data() + options.basis.size();
    const auto [past, error] = std::from_chars(options.basis.data(), end, size);
    if (error != std::errc() || past != end || size < 1 || size > kCoordinates)
        throw InputError("--basis", options.basis, "none, auto, or 1 to 114");
    return principal_basis(positions, size);
}

std::string coordinate_name(int coordinate) {
    return std::string(point_name(coordinate / 3)) + "_" + "xyz"[coordinate % 3] + "_mm";
}

Found found(Analysis&& analysis) {
    return {{std::move(analysis.track)}, {},
            analysis.max_error_mm,       analysis.worst_time_s,
            analysis.rms_error_mm,       analysis.worst_point};
}

Found found(SeparateAnalysis&& analysis) {
    return {std::move(analysis.tracks), {},
            analysis.max_error_mm,      analysis.worst_time_s,
            analysis.rms_error_mm,      analysis.worst_point};
}

Found analysed(const Motion& motion, const Options& options) {
    const AnalysisOptions limits{options.max_error_mm, options.max_gap_ratio};
    const bool shared = options.times == "shared";
    Found result;
    if (options.basis == "none") {
        result = shared ? found(analyse_in_full(motion, limits)) : found(analyse_separately(motion, limits));
        for (int i = 0; !shared && i < kCoordinates; ++i) result.names.push_back(coordinate_name(i));
        return result;
    }
    const ConfigurationBasis basis = asked_basis(options, motion.positions);
    result = shared ? found(analyse_in_full(motion, basis, limits))
                    : found(analyse_separately(motion, basis, limits));
    result.components = basis.size();
    if (shared) result.tracks[0].points = to_points(basis, result.tracks[0].points);
    for (Eigen::Index i = 0; !shared && i < basis.size(); ++i)
        result.names.push_back("component_" + std::to_string(i + 1));
    return result;
}

std::string comment(const Options& options) {
    char text[80];
    std::snprintf(text, sizeof text, "via points, within %g mm", options.max_error_mm);
    return text;
}

// Via points in time: a motion CSV; or, when dimensions have times of their own, one line for each of theirs.
std::string as_csv(const Found& result, const Options& options) {
    if (result.shared())
        return format_motion_csv({result.tracks[0].time_s, result.tracks[0].points}, {comment(options)});
    std::string text = "# " + comment(options) + "\nname,time_s,value_mm\n";
    const auto append = [&](double value) {
        char digits[32];
        text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
    };
    for (std::size_t d = 0; d < result.tracks.size(); ++d) {
        for (std::size_t i = 0; i < result.tracks[d].time_s.size(); ++i) {
            append((text += result.names[d] + ",", result.tracks[d].time_s[i]));
            append((text += ",", result.tracks[d].points(static_cast<Eigen::Index>(i), 0)));
            text += "\n";
        }
    }
    return text;
}

ViaPointTrack track_of(const Found& result, int coordinate) {
    if (!result.shared()) return result.tracks[static_cast<std::size_t>(coordinate)];
    return {result.tracks[0].time_s, result.tracks[0].points.col(coordinate)};
}

std::string drawn(const Motion& motion, const Found& result, const Options& options) {
    ViaPlot plot;
    char title[120];
    std::snprintf(title, sizeof title, "Via points within %g mm", options.max_error_mm);
    plot.title = title;
    plot.from_s = std::max(options.from_s, motion.time_s.front());
    plot.to_s = std::min(options.from_s + options.seconds, motion.time_s.back());
    if (!(plot.from_s < plot.to_s)) {
        throw InputError("--from", std::to_string(options.from_s),
                         "within the motion: " + std::to_string(motion.time_s.front()) + " to " +
                             std::to_string(motion.time_s.back()) + " s");
    }
    plot.time_s = motion.time_s;
    const auto measured = measured_points(motion.positions, "motion");
    for (const int coordinate : plotted_coordinates(options.points, measured, "--points")) {
        const auto column = motion.positions.col(coordinate);
        plot.coordinates.push_back(
            {coordinate, track_of(result, coordinate), {column.begin(), column.end()}});
    }
    if (!options.audio.empty()) plot.sound = read_sound(std::filesystem::path(options.audio), kSoundRate);
    plot.sound_rate = kSoundRate;
    return format_via_plot(plot);
}

struct Gaps {
    double shortest_s = 1e300, longest_s = 0, ratio = 1;
};

Gaps gaps_of(const std::vector<ViaPointTrack>& tracks) {
    Gaps gaps;
    for (const ViaPointTrack& track : tracks) {
        for (std::size_t i = 1; i < track.time_s.size(); ++i) {
            const double gap = track.time_s[i] - track.time_s[i - 1];
            gaps.shortest_s = std::min(gaps.shortest_s, gap);
            gaps.longest_s = std::max(gaps.longest_s, gap);
            if (i < 2) continue;
            const double last = track.time_s[i - 1] - track.time_s[i - 2];
            gaps.ratio = std::max({gaps.ratio, gap / last, last / gap});
        }
    }
    return gaps;
}

void print_report(const Motion& motion, const Found& result, const Options& options, double took_s) {
    const double seconds = motion.time_s.back() - motion.time_s.front();
    const std::vector<int> points = measured_points(motion.positions, "motion");
    std::printf("motion       %.2f s, %zu samples, %zu points\n", seconds, motion.size(), points.size());
    std::size_t count = 0;
    for (const ViaPointTrack& track : result.tracks) count += track.time_s.size();
    if (result.shared()) {
        std::printf("via points   %zu, %.2f a second, times shared", count,
                    static_cast<double>(count) / seconds);
    } else {
        std::printf("via points   %zu, %.2f a second in all, each %s with times of its own", count,
                    static_cast<double>(count) / seconds, result.components > 0 ? "component" : "coordinate");
    }
    if (result.components > 0) std::printf(", in a basis of %td components", result.components);
    std::printf("\nerror        largest %.4f mm (%s at %.3f s), rms %.4f mm; bound %g mm\n",
                result.max_error_mm, std::string(point_name(result.worst_point)).c_str(), result.worst_time_s,
                result.rms_error_mm, options.max_error_mm);
    const RowMatrix measured = coordinates_of(motion.positions, points);
    const Eigen::RowVectorXd ranges = measured.colwise().maxCoeff() - measured.colwise().minCoeff();
    Eigen::Index widest = 0;
    const double range = ranges.maxCoeff(&widest);
    std::printf(
        "motion range %.2f mm (%s)\n", range,
        coordinate_name(3 * points[static_cast<std::size_t>(widest / 3)] + static_cast<int>(widest % 3))
            .c_str());
    const Gaps gaps = gaps_of(result.tracks);
    std::printf("gaps         %.0f to %.0f ms, neighbours by a ratio of up to %.2f\n", 1e3 * gaps.shortest_s,
                1e3 * gaps.longest_s, gaps.ratio);
    std::printf("time taken   %.3f s of one core, %.0f x real time\n", took_s, seconds / took_s);
}

void require_ending(const std::string& option, const std::string& path, const std::string& ending) {
    if (!path.empty() && !path.ends_with(ending))
        throw InputError(option, path, "a name that ends in " + ending);
}

int analyse_file(const Options& options) {
    const bool to_stream = options.output.ends_with(".via");
    if (!to_stream) require_ending("--output", options.output, ".csv");
    require_ending("--plot", options.plot, ".svg");
    if (options.times != "shared" && options.times != "component")
        throw InputError("--times", options.times, "shared or component");
    if (!(options.seconds > 0)) throw InputError("--seconds", std::to_string(options.seconds), "more than 0");
    if (!options.plot.empty() && options.times == "component" && options.basis != "none")
        throw InputError("--plot", options.plot,
                         "--times shared or --basis none: components are no coordinates");
    if (to_stream && (options.times != "shared" || options.basis != "none"))
        throw InputError("--output", options.output,
                         "a .csv, or --times shared and --basis none: a stream brings both");
    const Motion motion = read_motion_csv(options.motion).motion;
    const std::clock_t start = std::clock();
    const Found result = analysed(motion, options);
    const double took = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    if (to_stream) {
        write_whole(options.output,
                    encode_stream(motion, nullptr, {.max_error_mm = options.max_error_mm}).bytes);
    } else if (!options.output.empty()) {
        write_whole(options.output, as_csv(result, options));
    }
    if (!options.plot.empty()) write_whole(options.plot, drawn(motion, result, options));
    print_report(motion, result, options, took);
    return 0;
}

}  // namespace

Command add_via_analyse(CLI::App& via) {
    auto options = std::make_shared<Options>();
    CLI::App* app = via.add_subcommand(
        "analyse", "The via points of a recorded motion, from which it is recovered within a bound.");
    app->add_option("motion", options->motion, "motion CSV in mm")->required();
    app->add_option("--max-error", options->max_error_mm, "bound in mm for each point at each sample")
        ->capture_default_str();
    app->add_option("--gap-ratio", options->max_gap_ratio, "of neighbouring gaps between via points, at most")
        ->capture_default_str();
    app->add_option("--times", options->times,
                    "shared, or component: each dimension has via times of its own")
        ->capture_default_str();
    app->add_option(
           "--basis", options->basis,
           "none, a number of principal components, or auto: chosen by its error on what is held out")
        ->capture_default_str();
    app->add_option("-o,--output", options->output,
                    "the via points as .csv, or as a stream that holds the bound, .via");
    app->add_option("--plot", options->plot, "measured, via points and recovered path as .svg");
    app->add_option("--points", options->points,
                    "what is plotted, as in lip_bottom_y,chin (default: lips and jaw)");
    app->add_option("--audio", options->audio, "sound that is plotted above");
    app->add_option("--from", options->from_s, "s: where the plot begins")->capture_default_str();
    app->add_option("--seconds", options->seconds, "s: how much is plotted")->capture_default_str();
    return [options] { return analyse_file(*options); };
}

}  // namespace viaface

#include "synth/learn/held_out.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <sstream>

#include "base/error.hpp"
#include "viapoints/codex_consensus.hpp"
#include "viapoints/codex_speak.hpp"
#include "viapoints/measured.hpp"
#include "viapoints/spline.hpp"

namespace viaface {
namespace {

struct Split {
    std::vector<const Take*> learned, left_out;
};

Split split(const RecordedTakes& takes, double share, const std::string& field) {
    if (!(share >= 0.01 && share <= 0.5)) {
        throw InputError(field, (std::ostringstream() << 100 * share << "%").str(), "1% to 50%");
    }
    if (takes.takes.size() < 2) throw InputError(field, "one take", "at least two takes");
    const auto every =
        std::min<std::size_t>(static_cast<std::size_t>(std::lround(1 / share)), takes.takes.size());
    Split parts;
    for (std::size_t i = 0; i < takes.takes.size(); ++i) {
        (i % every == every - 1 ? parts.left_out : parts.learned).push_back(&takes.takes[i].take);
    }
    return parts;
}

// Measured and spoken points of one take, side by side.
struct Beside {
    RowMatrix measured, spoken;  // [samples x 114]
};

Beside beside(const Codex& codex, const Take& take, const Selection& selection) {
    ViaPointTrack track = speak(codex, take.phones, selection);
    const MinimumJerkSpline spline(std::move(track), SplineEnd::at_rest(), SplineEnd::at_rest());
    const auto& time = take.motion.time_s;
    const std::size_t last = take.phones.phones.size() - 1;
    const auto from = std::lower_bound(time.begin(), time.end(), take.phones.end_s(0));
    const auto to = std::upper_bound(from, time.end(), take.phones.begin_s(last));
    return {take.motion.positions.middleRows(from - time.begin(), to - from),
            to_points(codex.basis, spline.at(std::vector<double>(from, to)))};
}

// Some columns made of each take's points, of all takes one under the other.
using Columns = std::function<RowMatrix(const RowMatrix&)>;

RowMatrix stacked(const std::vector<Beside>& takes, RowMatrix Beside::*part, const Columns& columns) {
    std::vector<RowMatrix> blocks;
    Eigen::Index rows = 0;
    for (const Beside& take : takes) {
        blocks.push_back(columns(take.*part));
        rows += blocks.back().rows();
    }
    RowMatrix all(rows, blocks.front().cols());
    Eigen::Index at = 0;
    for (const RowMatrix& block : blocks) {
        all.middleRows(at, block.rows()) = block;
        at += block.rows();
    }
    return all;
}

struct Likeness {
    double correlation, rms_mm, spread_mm;
};

Likeness likeness(const std::vector<Beside>& takes, const Columns& columns) {
    const RowMatrix measured = stacked(takes, &Beside::measured, columns);
    const RowMatrix spoken = stacked(takes, &Beside::spoken, columns);
    const RowMatrix m = measured.rowwise() - measured.colwise().mean();
    const RowMatrix s = spoken.rowwise() - spoken.colwise().mean();
    const double samples = static_cast<double>(measured.rows());
    const double both = m.norm() * s.norm();
    return {both > 0 ? m.cwiseProduct(s).sum() / both : 0, (measured - spoken).norm() / std::sqrt(samples),
            m.norm() / std::sqrt(samples)};
}

PointFigures figures_of(const std::vector<Beside>& takes, int point) {
    const Likeness found =
        likeness(takes, [&](const RowMatrix& points) { return points.middleCols<3>(3 * point); });
    return {point, found.correlation, found.rms_mm, found.spread_mm};
}

struct Pair {
    int first, second;
};

// Along an axis, of the first pair of which both points are measured.
std::optional<LengthFigures> length_of(const std::vector<Beside>& takes, const std::string& name, int axis,
                                       const std::vector<Pair>& pairs, const std::vector<int>& measured) {
    const auto has = [&](int point) { return std::ranges::binary_search(measured, point); };
    const auto pair = std::ranges::find_if(pairs, [&](Pair p) { return has(p.first) && has(p.second); });
    if (pair == pairs.end()) return std::nullopt;
    const Likeness found = likeness(takes, [&](const RowMatrix& points) -> RowMatrix {
        return points.col(3 * pair->first + axis) - points.col(3 * pair->second + axis);
    });
    return LengthFigures{name, found.correlation, found.rms_mm, found.spread_mm};
}

std::vector<LengthFigures> lengths_of(const std::vector<Beside>& takes, const std::vector<int>& measured) {
    std::vector<LengthFigures> figures;
    for (const auto& length :
         {length_of(takes, "opening", 1,
                    {{kInnerTop, kInnerBottom}, {kBorderTop, kBorderBottom}, {kLipTop, kLipBottom}},
                    measured),
          length_of(takes, "mouth width", 0, {{kBorderLeft, kBorderRight}, {kLipCornerLeft, kLipCornerRight}},
                    measured)}) {
        if (length) figures.push_back(*length);
    }
    return figures;
}

std::vector<PointFigures> figures_of(const std::vector<Beside>& takes, const std::vector<int>& measured) {
    std::vector<PointFigures> figures;
    for (const int point : measured) figures.push_back(figures_of(takes, point));
    return figures;
}

double root_mean_square(const std::vector<PointFigures>& points, double PointFigures::*figure) {
    double sum = 0;
    for (const PointFigures& each : points) sum += each.*figure * each.*figure;
    return std::sqrt(sum / static_cast<double>(points.size()));
}

TakeFigures figures_of(const std::string& name, const Beside& take, const std::vector<int>& measured) {
    const std::vector<PointFigures> points = figures_of({take}, measured);
    return {name, lengths_of({take}, measured), root_mean_square(points, &PointFigures::rms_mm),
            root_mean_square(points, &PointFigures::spread_mm)};
}

}  // namespace

HeldOutFigures check_held_out(const RecordedTakes& takes, double share, const std::string& field,
                              const LearningOptions& options) {
    const Split parts = split(takes, share, field);
    const Codex codex =
        with_scatter(learn_from_takes(
                         basis_of(parts.learned, options.basis_error_mm), takes.rest, parts.learned.size(),
                         [&](std::size_t i) { return *parts.learned[i]; }, "", options)
                         .codex);
    HeldOutFigures figures;
    figures.learned = parts.learned.size();
    const std::vector<int> measured = measured_points(takes.takes.front().take.motion.positions, field);
    std::vector<Beside> spoken;
    for (const Take* take : parts.left_out) {
        const Selection selection = select_units(codex, take->phones);
        for (std::size_t i = 0; i < 3; ++i) figures.phones_at_level[i] += selection.phones_at_level[i];
        spoken.push_back(beside(codex, *take, selection));
        figures.left_out.push_back(figures_of(take->name, spoken.back(), measured));
    }
    figures.points = figures_of(spoken, measured);
    figures.lengths = lengths_of(spoken, measured);
    figures.rms_mm = root_mean_square(figures.points, &PointFigures::rms_mm);
    figures.spread_mm = root_mean_square(figures.points, &PointFigures::spread_mm);
    return figures;
}

namespace {

std::string printed(const char* format, auto... values) {
    char line[160];
    std::snprintf(line, sizeof line, format, values...);
    return line;
}

std::string line_of(std::string_view name, const auto& figures) {
    return printed("%-20s %6.2f %8.2f %10.2f\n", std::string(name).c_str(), figures.correlation,
                   figures.rms_mm, figures.spread_mm);
}

std::string line_of(const TakeFigures& take) {
    std::string line =
        printed("%-20.40s %6s %8.2f %10.2f", take.name.c_str(), "", take.rms_mm, take.spread_mm);
    for (const LengthFigures& each : take.lengths)
        line += printed("  %s r %.2f rms %.2f", each.name.c_str(), each.correlation, each.rms_mm);
    return line + "\n";
}

}  // namespace

std::string as_text(const HeldOutFigures& figures) {
    const auto& [exact, of_class, half] = figures.phones_at_level;
    const double all = std::max(1, exact + of_class + half);
    std::string text =
        printed("%zu takes learned from, %zu left out\n", figures.learned, figures.left_out.size()) +
        printed("triphones: %.1f%% exact, %.1f%% by viseme class, %.1f%% halves\n", 100 * exact / all,
                100 * of_class / all, 100 * half / all);
    const char* titles = "%-20s %6s %8s %10s\n";
    text += printed(titles, "take left out", "", "rms mm", "spread mm");
    for (const TakeFigures& each : figures.left_out) text += line_of(each);
    text += printed(titles, "point", "r", "rms mm", "spread mm");
    for (const PointFigures& each : figures.points) text += line_of(point_name(each.point), each);
    for (const LengthFigures& each : figures.lengths) text += line_of(each.name, each);
    return text + printed("%-20s %6s %8.2f %10.2f\n", "all", "", figures.rms_mm, figures.spread_mm);
}

}  // namespace viaface

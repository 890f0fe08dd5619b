#include "synth/motion/live_link.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "base/error.hpp"
#include "base/median.hpp"
#include "viapoints/cells.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr std::array kFrameRates = {60, 120, 50, 48, 30, 25, 24};
constexpr double kDay = 86400;  // s

bool is_turn(std::string_view name) {
    return name.ends_with("Yaw") || name.ends_with("Pitch") || name.ends_with("Roll");
}

struct TimeCode {
    double seconds = 0;  // whole, since midnight
    double frames = 0;
};

std::optional<TimeCode> time_code(std::string_view cell) {
    const auto parts = cells_of(cell, ':');
    if (parts.size() != 4) return std::nullopt;
    std::array<double, 4> numbers{};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto number = finite_number(parts[i]);
        const double above = i == 0 ? 24 : i == 3 ? kFrameRates[1] : 60;
        if (!number || !(*number >= 0) || *number >= above || (i < 3 && *number != std::floor(*number)))
            return std::nullopt;
        numbers[i] = *number;
    }
    return TimeCode{3600 * numbers[0] + 60 * numbers[1] + numbers[2], numbers[3]};
}

std::vector<double> times_at(const std::vector<TimeCode>& codes, int rate) {
    std::vector<double> times;
    double days = 0;
    for (const TimeCode& code : codes) {
        const double of_day = code.seconds + code.frames / rate;
        if (!times.empty() && days + of_day < times.back() - kDay / 2) days += kDay;
        times.push_back(days + of_day);
    }
    const double first = times.front();
    for (double& time : times) time -= first;
    return times;
}

// Sum of the steps' distances from the median step, in median steps.
double unevenness(const std::vector<double>& times) {
    if (times.size() < 2) return 0;
    std::vector<double> steps;
    for (std::size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
    const double usual = median(steps);
    if (!(usual > 0)) return std::numeric_limits<double>::infinity();
    double sum = 0;
    for (const double step : steps) sum += std::abs(step - usual);
    return sum / usual;
}

std::vector<double> most_even_times(const std::vector<TimeCode>& codes) {
    constexpr double kSame = 1e-6;  // of a step, per row: round-off
    const double largest = std::ranges::max_element(codes, {}, &TimeCode::frames)->frames;
    std::vector<double> best;
    double least = std::numeric_limits<double>::infinity();
    for (const int rate : kFrameRates) {
        if (rate <= largest) continue;
        std::vector<double> times = times_at(codes, rate);
        const double uneven = unevenness(times);
        if (!best.empty() && uneven >= least - kSame * static_cast<double>(codes.size())) continue;
        best = std::move(times);
        least = uneven;
    }
    return best;
}

class Parser {
  public:
    Parser(std::string_view text, const std::string& field) : lines_(text, field) {}

    BlendRecording parse() {
        while (lines_.next()) {
            if (trimmed(lines_.line()).empty()) continue;
            const auto cells = cells_of(lines_.line(), ',');
            columns_.empty() ? header(cells) : row(cells);
        }
        if (codes_.empty()) lines_.fail("", "no row", "a header and at least one row");
        return finished();
    }

  private:
    void header(const std::vector<std::string_view>& names) {
        if (names.size() < 3 || in_lower_case(names[0]) != "timecode" ||
            in_lower_case(names[1]) != "blendshapecount") {
            lines_.fail("", names.front(), "Timecode,BlendShapeCount and the names of shapes");
        }
        if (names.size() > kLiveLinkColumns)
            lines_.fail("", std::to_string(names.size()) + " columns", "at most 256");
        std::set<std::string_view> seen;
        for (const std::string_view name : names) {
            if (name.empty() || std::any_of(name.begin(), name.end(), is_control))
                lines_.fail(std::to_string(seen.size() + 1), name, "a name without control characters");
            if (!seen.insert(name).second) lines_.fail(name, name, "each column once");
            columns_.emplace_back(name);
        }
        values_.resize(columns_.size() - 2);
    }

    void row(const std::vector<std::string_view>& cells) {
        const std::size_t shapes = values_.size();
        if (codes_.size() == kLiveLinkRows)
            lines_.fail("", "more rows", "at most " + std::to_string(kLiveLinkRows));
        const auto code = time_code(cells.front());
        if (!code) lines_.fail(columns_[0], cells.front(), "hours:minutes:seconds:frames");
        const auto count = cells.size() > 1 ? finite_number(cells[1]) : std::nullopt;
        if (!count || (*count != 0 && *count != static_cast<double>(shapes))) {
            lines_.fail(columns_[1], cells.size() > 1 ? cells[1] : "nothing",
                        std::to_string(shapes) + ", as many as the header names, or 0");
        }
        if (*count != 0 && cells.size() != columns_.size()) {
            lines_.fail("", std::to_string(cells.size()) + " cells",
                        "as many as the header has: " + std::to_string(columns_.size()));
        }
        codes_.push_back(*code);
        row_lines_.push_back(lines_.number());
        for (std::size_t i = 0; i < shapes; ++i)
            values_[i].push_back(*count == 0 ? std::nan("") : number(cells[i + 2], columns_[i + 2]));
    }

    double number(std::string_view cell, const std::string& column) const {
        if (is_missing(cell)) return std::nan("");
        const auto value = finite_number(cell);
        if (!value || std::abs(*value) > BlendRecording::kLargestWeight)
            lines_.fail(column, cell, "a number from -10 to 10, or nothing");
        return *value;
    }

    BlendRecording finished() {
        BlendRecording recording;
        recording.time_s = most_even_times(codes_);
        for (std::size_t i = 1; i < recording.time_s.size(); ++i) {
            if (recording.time_s[i] > recording.time_s[i - 1]) continue;
            lines_.go_to(row_lines_[i]);
            lines_.fail(columns_[0], "a time that does not rise", "a time code above that of the row before");
        }
        std::vector<std::size_t> shapes;
        for (std::size_t i = 0; i < values_.size(); ++i) {
            const std::string& name = columns_[i + 2];
            if (is_turn(name)) {
                recording.extra.push_back({name, std::move(values_[i])});
            } else {
                recording.names.push_back(name);
                shapes.push_back(i);
            }
        }
        recording.weights.resize(static_cast<Index>(codes_.size()), static_cast<Index>(shapes.size()));
        for (std::size_t i = 0; i < shapes.size(); ++i)
            recording.weights.col(static_cast<Index>(i)) = Eigen::Map<const Eigen::VectorXd>(
                values_[shapes[i]].data(), static_cast<Index>(values_[shapes[i]].size()));
        return recording;
    }

    Lines lines_;
    std::vector<std::string> columns_;
    std::vector<TimeCode> codes_;
    std::vector<std::size_t> row_lines_;       // of the rows
    std::vector<std::vector<double>> values_;  // [columns after the count], by row
};

}  // namespace

bool is_live_link(std::string_view text) { return in_lower_case(text.substr(0, 9)) == "timecode,"; }

BlendRecording parse_live_link(std::string_view text, const std::string& field) {
    return Parser(text, field).parse();
}

}  // namespace viaface

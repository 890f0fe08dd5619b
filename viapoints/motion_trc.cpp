#include "viapoints/motion_trc.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/error.hpp"
#include "viapoints/cells.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view kKind = "PathFileType", kAxes = "XYZ";

class Parser {
  public:
    Parser(std::string_view text, const std::string& field, const std::string& unit)
        : lines_(text, field), unit_(unit) {}

    PointRecording parse() {
        if (!lines_.next() || !is_trc(lines_.line())) lines_.fail("", lines_.line(), "PathFileType");
        facts();
        labels();
        while (lines_.next()) {
            if (!trimmed(lines_.line()).empty()) frame(cells_of(lines_.line(), '\t'));
        }
        if (recording_.time_s.empty()) lines_.fail("", "no frame", "at least one");
        if (frames_ && *frames_ != static_cast<double>(recording_.size()))
            lines_.fail("NumFrames", std::to_string(recording_.size()) + " frames",
                        "as many as line 3 says: " + std::to_string(static_cast<long long>(*frames_)));
        return finished();
    }

  private:
    // The lines of facts and their values.
    void facts() {
        if (!lines_.next())
            lines_.fail("", "nothing", "DataRate, CameraRate, NumFrames, NumMarkers, Units, ...");
        const std::vector<std::string> names = copied(cells_of(lines_.line(), '\t'));
        if (!lines_.next()) lines_.fail("", "nothing", "the values of the line above");
        const auto values = cells_of(lines_.line(), '\t');
        for (std::size_t i = 0; i < names.size(); ++i) {
            const std::string_view value = i < values.size() ? values[i] : "";
            if (names[i] == "Units" && !value.empty()) unit_ = value;
            if (names[i] == "NumFrames") frames_ = count(names[i], value);
            if (names[i] == "NumMarkers") markers_ = count(names[i], value);
            if (names[i] == "DataRate") rate_ = count(names[i], value);
        }
        const auto mm = millimetres_per(unit_);
        if (!mm) lines_.fail("Units", unit_, "mm, cm or m");
        mm_per_unit_ = *mm;
    }

    double count(const std::string& name, std::string_view value) const {
        const auto number = finite_number(value);
        if (!number || !(*number > 0) || *number > static_cast<double>(kMotionFileSamples))
            lines_.fail(name, value, "a number above 0, up to " + std::to_string(kMotionFileSamples));
        return *number;
    }

    static std::vector<std::string> copied(const std::vector<std::string_view>& cells) {
        return {cells.begin(), cells.end()};
    }

    void labels() {
        if (!lines_.next()) lines_.fail("", "nothing", "Frame#, Time and the markers' names");
        const auto cells = cells_of(lines_.line(), '\t');
        if (cells.size() < 3 || in_lower_case(cells[1]) != "time")
            lines_.fail("2", cells.size() < 2 ? "nothing" : cells[1], "Frame#, Time and the markers' names");
        for (std::size_t i = 2; i < cells.size(); ++i) {
            if (!cells[i].empty()) recording_.labels.push_back(unused_label(recording_.labels, cells[i]));
            if (recording_.labels.size() > kMotionFilePoints)
                lines_.fail("", "more markers", "at most " + std::to_string(kMotionFilePoints));
        }
        const std::size_t found = recording_.labels.size();
        if (found == 0 || (markers_ && *markers_ != static_cast<double>(found)))
            lines_.fail("NumMarkers", std::to_string(found) + " names",
                        "as many as line 3 says, at least one");
        if (!lines_.next()) lines_.fail("", "nothing", "the line X1, Y1, Z1, ...");
    }

    void frame(const std::vector<std::string_view>& cells) {
        const std::size_t wanted = 2 + 3 * recording_.labels.size();
        if (cells.size() < wanted)
            lines_.fail("", std::to_string(cells.size()) + " cells", std::to_string(wanted));
        for (std::size_t i = wanted; i < cells.size(); ++i) {
            if (!cells[i].empty())
                lines_.fail(std::to_string(i + 1), cells[i], std::to_string(wanted) + " cells");
        }
        std::vector<double>& times = recording_.time_s;
        if (times.size() == kMotionFileSamples)
            lines_.fail("", "more frames", "at most " + std::to_string(kMotionFileSamples));
        const auto time = finite_number(cells[1]);
        if (!time || (!times.empty() && !(*time > times.back())))
            lines_.fail("Time", cells[1], "a time above that of the frame before");
        times.push_back(*time);
        for (std::size_t i = 2; i < wanted; ++i) positions_.push_back(coordinate(cells[i], i - 2));
    }

    double coordinate(std::string_view cell, std::size_t coordinate) const {
        if (is_missing(cell)) return kNaN;
        const auto value = finite_number(cell);
        if (!value || std::abs(*value * mm_per_unit_) > kFarthestPoint_mm)
            lines_.fail(recording_.labels[coordinate / 3] + " " + kAxes[coordinate % 3], cell,
                        "a number within 1e6 mm, or nothing");
        return *value * mm_per_unit_;
    }

    PointRecording finished() {
        recording_.positions =
            Eigen::Map<const RowMatrix>(positions_.data(), static_cast<Index>(recording_.size()),
                                        static_cast<Index>(3 * recording_.labels.size()));
        const double span = recording_.time_s.back() - recording_.time_s.front();
        const double rate = static_cast<double>(recording_.size() - 1) / span;
        if (rate_ && span > 0 && std::abs(rate / *rate_ - 1) > 0.01)
            recording_.remarks.push_back("DataRate says " + std::to_string(*rate_) +
                                         " per second, the times " + std::to_string(rate));
        return std::move(recording_);
    }

    Lines lines_;
    std::string unit_;
    std::optional<double> frames_, markers_, rate_;
    double mm_per_unit_ = 1;
    std::vector<double> positions_;  // [samples x 3*labels]
    PointRecording recording_;
};

}  // namespace

bool is_trc(std::string_view text) { return text.starts_with(kKind); }

PointRecording parse_trc(std::string_view text, const std::string& field, const std::string& unit) {
    return Parser(text, field, unit).parse();
}

std::string format_trc(const PointRecording& recording) {
    if (recording.size() < 1 || recording.positions.rows() != static_cast<Index>(recording.size()) ||
        recording.positions.cols() != static_cast<Index>(3 * recording.labels.size()))
        throw std::invalid_argument("a recording's labels, times and positions differ in number");
    const std::size_t frames = recording.size();
    const double span = recording.time_s.back() - recording.time_s.front();
    std::string rate, text = "PathFileType\t4\t(X/Y/Z)\tmotion.trc\n";
    append_number(rate, span > 0 ? std::round(static_cast<double>(frames - 1) / span * 1e6) / 1e6 : 1);
    text +=
        "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames"
        "\n" +
        rate + "\t" + rate + "\t" + std::to_string(frames) + "\t" + std::to_string(recording.labels.size()) +
        "\tmm\t" + rate + "\t1\t" + std::to_string(frames) + "\nFrame#\tTime";
    for (const std::string& label : recording.labels) {
        if (label.empty() || std::any_of(label.begin(), label.end(), is_control))
            throw InputError("motion", label, "a label without control characters");
        text += "\t" + label + "\t\t";
    }
    text += "\n\t";
    for (std::size_t p = 1; p <= recording.labels.size(); ++p) {
        for (const char axis : kAxes) text += std::string("\t") + axis + std::to_string(p);
    }
    text += "\n\n";
    for (std::size_t f = 0; f < frames; ++f) {
        append_number(text += std::to_string(f + 1) + "\t", recording.time_s[f]);
        for (const double mm : recording.positions.row(static_cast<Index>(f)))
            append_number(text += '\t', mm);
        text += "\n";
    }
    return text;
}

}  // namespace viaface

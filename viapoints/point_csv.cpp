#include "viapoints/point_csv.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "base/error.hpp"
#include "viapoints/cells.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kMostColumns = 3 * kMotionFilePoints + 1024;

// "chin_x_mm": label, axis and unit.
struct CoordinateName {
    std::string label;
    int axis = 0;
    std::string unit;  // empty when none is named
};

std::optional<CoordinateName> coordinate_name(std::string_view name) {
    std::string unit;
    for (const char* ending : {"_mm", "_cm", "_m"}) {
        if (!in_lower_case(name).ends_with(ending)) continue;
        unit = ending + 1;
        name.remove_suffix(std::string_view(ending).size());
        break;
    }
    if (name.size() < 3 || name[name.size() - 2] != '_') return std::nullopt;
    const int axis = in_lower_case(name.substr(name.size() - 1))[0] - 'x';
    if (axis < 0 || axis > 2) return std::nullopt;
    return CoordinateName{std::string(name.substr(0, name.size() - 2)), axis, unit};
}

// Where a column's numbers go.
struct Column {
    std::string name;
    int coordinate = -1;     // of the positions; -1 for another column
    double mm_per_unit = 1;  // of a coordinate
    std::size_t extra = 0;
};

class Parser {
  public:
    Parser(std::string_view text, const std::string& field, const std::string& unit)
        : lines_(text, field), unit_(unit) {}

    PointRecording parse() {
        while (lines_.next()) {
            const std::string_view content = trimmed(lines_.line());
            if (content.empty()) continue;
            if (content.front() == '#') {
                recording_.comments.emplace_back(trimmed(content.substr(1)));
            } else if (columns_.empty()) {
                header(cells_of(lines_.line(), ','));
            } else {
                sample(cells_of(lines_.line(), ','));
            }
        }
        if (recording_.time_s.empty()) lines_.fail("", "no sample", "a header and at least one sample");
        recording_.positions =
            Eigen::Map<const RowMatrix>(positions_.data(), static_cast<Index>(recording_.size()),
                                        static_cast<Index>(3 * recording_.labels.size()));
        recording_.head_frame =
            recording_.head_frame &&
            std::ranges::find(recording_.comments, kAnotherPerson) == recording_.comments.end();
        return std::move(recording_);
    }

  private:
    void header(const std::vector<std::string_view>& names) {
        if (names.size() > kMostColumns)
            lines_.fail("", std::to_string(names.size()) + " columns",
                        "at most " + std::to_string(kMostColumns));
        const std::string time = in_lower_case(names.front());
        static const std::set<std::string> kSeconds = {"time_s", "t_s", "time", "t"};
        if (!kSeconds.contains(time) && time != "time_ms")
            lines_.fail("1", names.front(), "time_s as the first column");
        seconds_per_unit_ = time == "time_ms" ? 0.001 : 1;
        std::set<std::string_view> seen;
        std::map<std::string, std::array<int, 3>> axes;  // columns of a label
        for (const std::string_view name : names) {
            if (name.empty() || std::any_of(name.begin(), name.end(), is_control))
                lines_.fail(std::to_string(seen.size() + 1), name, "a name without control characters");
            if (!seen.insert(name).second) lines_.fail(name, name, "each column once");
            const auto coordinate = columns_.empty() ? std::nullopt : coordinate_name(name);
            if (coordinate) {
                auto& found = axes.try_emplace(coordinate->label, std::array{-1, -1, -1}).first->second;
                int& place = found[static_cast<std::size_t>(coordinate->axis)];
                if (place >= 0) lines_.fail(name, name, "each coordinate once");
                place = static_cast<int>(columns_.size());
            }
            columns_.push_back({std::string(name)});
        }
        for (std::size_t i = 1; i < columns_.size(); ++i) place(i, axes);
        recording_.head_frame =
            columns_.front().name == "time_s" && !recording_.labels.empty() && all_of_layout_;
    }

    // A label whose three axes are there becomes a point where the first of them stands.
    void place(std::size_t i, const std::map<std::string, std::array<int, 3>>& axes) {
        const auto coordinate = coordinate_name(columns_[i].name);
        const bool whole = coordinate && std::ranges::min(axes.at(coordinate->label)) > 0;
        if (!whole) {
            if (coordinate && !coordinate->unit.empty())
                lines_.fail(columns_[i].name, columns_[i].name, "x, y and z of a point");
            columns_[i].extra = recording_.extra.size();
            recording_.extra.push_back({columns_[i].name, {}});
            return;
        }
        auto& labels = recording_.labels;
        auto at = std::ranges::find(labels, coordinate->label);
        if (at == labels.end()) at = labels.insert(labels.end(), coordinate->label);
        const auto mm = millimetres_per(coordinate->unit.empty() ? unit_ : coordinate->unit);
        if (!mm)
            lines_.fail(columns_[i].name, "no unit", "a name that ends in _mm, _cm or _m, or a unit given");
        columns_[i].coordinate = static_cast<int>(3 * (at - labels.begin())) + coordinate->axis;
        columns_[i].mm_per_unit = *mm;
        all_of_layout_ = all_of_layout_ && *mm == 1 && point_index(coordinate->label);
    }

    void sample(const std::vector<std::string_view>& cells) {
        if (cells.size() != columns_.size())
            lines_.fail("", std::to_string(cells.size()) + " cells",
                        "as many as the header has: " + std::to_string(columns_.size()));
        std::vector<double>& times = recording_.time_s;
        if (times.size() == kMotionFileSamples)
            lines_.fail("", "more samples", "at most " + std::to_string(kMotionFileSamples));
        const auto time = finite_number(cells[0]);
        if (!time || (!times.empty() && !(*time * seconds_per_unit_ > times.back())))
            lines_.fail(columns_[0].name, cells[0], "a time above that of the sample before");
        times.push_back(*time * seconds_per_unit_);
        const std::size_t first = positions_.size();
        positions_.resize(first + 3 * recording_.labels.size(), kNaN);
        for (std::size_t i = 1; i < cells.size(); ++i) {
            const double value = number(cells[i], columns_[i]);
            if (columns_[i].coordinate < 0) {
                recording_.extra[columns_[i].extra].values.push_back(value);
            } else {
                positions_[first + static_cast<std::size_t>(columns_[i].coordinate)] = value;
            }
        }
    }

    double number(std::string_view cell, const Column& column) const {
        if (is_missing(cell)) return kNaN;
        const auto value = finite_number(cell);
        if (!value) lines_.fail(column.name, cell, "a finite number with a point, nan, or nothing");
        if (column.coordinate < 0) return *value;
        if (std::abs(*value * column.mm_per_unit) > kFarthestPoint_mm)
            lines_.fail(column.name, cell, "a coordinate within 1e6 mm");
        return *value * column.mm_per_unit;
    }

    Lines lines_;
    std::string unit_;
    double seconds_per_unit_ = 1;
    bool all_of_layout_ = true;
    std::vector<Column> columns_;
    std::vector<double> positions_;  // [samples x 3*labels]
    PointRecording recording_;
};

}  // namespace

PointRecording parse_point_csv(std::string_view text, const std::string& field, const std::string& unit) {
    return Parser(text, field, unit).parse();
}

}  // namespace viaface

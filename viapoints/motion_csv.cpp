#include "viapoints/motion_csv.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "viapoints/cells.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kFarthest_mm = 1e6;
constexpr std::string_view kAxes = "xyz";

std::string coordinate_name(int coordinate) {
    return std::string(point_name(coordinate / 3)) + "_" + kAxes[static_cast<std::size_t>(coordinate % 3)] +
           "_mm";
}

// The coordinate that "chin_x_mm", "chin_x" or "chin_x_cm" means: a point of the layout without its unit, or
// in another one, would be lost among the other columns.
std::optional<int> meant_coordinate(std::string_view name) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t at = name.rfind(std::string("_") + kAxes[axis]);
        if (at == name.npos || (at + 2 < name.size() && name[at + 2] != '_')) continue;
        if (const auto point = point_index(name.substr(0, at))) return 3 * *point + static_cast<int>(axis);
    }
    return std::nullopt;
}

bool is_one_line(std::string_view comment) {
    return std::none_of(comment.begin(), comment.end(), [](char c) { return is_control(c) && c != '\t'; });
}

// Which place of the motion a column fills.
struct Column {
    std::string name;
    int coordinate = -1;    // of the layout, 0 to 113; -1 for another column
    std::size_t extra = 0;  // of Motion::extra when it is another column
};

class Parser {
  public:
    Parser(std::string_view text, const std::string& field) : lines_(text, field) {}

    MotionCsv parse() {
        while (lines_.next()) {
            const std::string_view line = lines_.line(), content = trimmed(line);
            if (content.empty()) continue;
            if (content.front() == '#') {
                comment(line.substr(line.find('#') + 1));
            } else if (columns_.empty()) {
                header(cells_of(line, ','));
            } else {
                sample(cells_of(line, ','));
            }
        }
        if (result_.motion.time_s.empty())
            lines_.fail("", columns_.empty() ? "no header" : "no sample", "a header and at least one sample");
        return finished();
    }

  private:
    void comment(std::string_view text) {
        if (!text.empty() && text.front() == ' ') text.remove_prefix(1);
        if (!is_one_line(text)) lines_.fail("", text, "a comment without control characters");
        result_.comments.emplace_back(text);
    }

    void header(const std::vector<std::string_view>& names) {
        if (names.front() != "time_s") lines_.fail("1", names.front(), "time_s as the first column");
        if (names.size() > kMotionCsvColumns) {
            lines_.fail("", std::to_string(names.size()) + " columns",
                        "at most " + std::to_string(kMotionCsvColumns));
        }
        std::set<std::string_view> seen;
        for (const std::string_view name : names) {
            if (name.empty() || std::any_of(name.begin(), name.end(), is_control)) {
                lines_.fail(std::to_string(seen.size() + 1), name, "a name without control characters");
            }
            if (!seen.insert(name).second) lines_.fail(name, name, "each column once");
            columns_.push_back(column(name));
        }
        require_triples();
        for (Column& added : columns_) {
            if (added.coordinate >= 0 || &added == &columns_.front()) continue;
            added.extra = result_.motion.extra.size();
            result_.motion.extra.push_back({added.name, {}});
        }
    }

    Column column(std::string_view name) const {
        const auto meant = meant_coordinate(name);
        if (meant && name != coordinate_name(*meant)) lines_.fail(name, name, coordinate_name(*meant));
        return {std::string(name), meant.value_or(-1)};
    }

    void require_triples() const {
        for (std::size_t i = 0; i < columns_.size(); ++i) {
            const int first = columns_[i].coordinate;
            if (first < 0) continue;
            const bool whole = first % 3 == 0 && i + 2 < columns_.size() &&
                               columns_[i + 1].coordinate == first + 1 &&
                               columns_[i + 2].coordinate == first + 2;
            if (!whole) {
                lines_.fail(columns_[i].name, columns_[i].name,
                            "x, y and z of a point side by side, in this order");
            }
            i += 2;
        }
    }

    void sample(const std::vector<std::string_view>& cells) {
        if (cells.size() != columns_.size()) {
            lines_.fail("", std::to_string(cells.size()) + " cells",
                        "as many as the header has: " + std::to_string(columns_.size()));
        }
        std::vector<double>& times = result_.motion.time_s;
        if (times.size() == kMotionCsvSamples)
            lines_.fail("", "more samples", "at most " + std::to_string(kMotionCsvSamples));
        const double time = number(cells[0], columns_[0]);
        if (std::isnan(time) || (!times.empty() && !(time > times.back()))) {
            lines_.fail("time_s", cells[0], "a time above that of the sample before");
        }
        times.push_back(time);
        positions_.resize(positions_.size() + kCoordinates, kNaN);
        double* position = positions_.data() + positions_.size() - kCoordinates;
        for (std::size_t i = 1; i < cells.size(); ++i) {
            const double value = number(cells[i], columns_[i]);
            if (columns_[i].coordinate < 0) {
                result_.motion.extra[columns_[i].extra].values.push_back(value);
            } else if (std::abs(value) > kFarthest_mm) {
                lines_.fail(columns_[i].name, cells[i], "a coordinate within 1e6 mm");
            } else {
                position[columns_[i].coordinate] = value;
            }
        }
    }

    double number(std::string_view cell, const Column& column) const {
        if (is_missing(cell)) return kNaN;
        const auto value = finite_number(cell);
        if (!value) lines_.fail(column.name, cell, "a finite number with a point, nan, or nothing");
        return *value;
    }

    MotionCsv finished() {
        const auto samples = static_cast<Index>(result_.motion.time_s.size());
        result_.motion.positions = Eigen::Map<const RowMatrix>(positions_.data(), samples, kCoordinates);
        return std::move(result_);
    }

    Lines lines_;
    std::vector<Column> columns_;
    std::vector<double> positions_;  // [samples x 114]
    MotionCsv result_;
};

bool is_plain(std::string_view name) {
    return !name.empty() && trimmed(name) == name && name.find(',') == name.npos &&
           std::none_of(name.begin(), name.end(), is_control);
}

void require_writable(const Motion& motion, const std::vector<std::string>& comments) {
    bool fits = motion.positions.rows() == static_cast<Index>(motion.size()) &&
                motion.positions.cols() == kCoordinates;
    std::set<std::string_view> seen{"time_s"};
    for (const ExtraColumn& column : motion.extra) {
        fits = fits && column.values.size() == motion.size();
        if (!is_plain(column.name) || meant_coordinate(column.name) || !seen.insert(column.name).second) {
            throw std::invalid_argument("an extra column's name cannot be written: '" + column.name + "'");
        }
    }
    if (!fits) throw std::invalid_argument("a motion's times, positions and extra columns differ in length");
    for (const std::string& comment : comments) {
        if (!is_one_line(comment)) throw std::invalid_argument("a comment with control characters");
    }
}

std::vector<int> written_points(const RowMatrix& positions) {
    std::vector<int> points;
    for (int point = 0; point < kPoints; ++point) {
        if (!positions.middleCols<3>(3 * point).array().isNaN().all()) points.push_back(point);
    }
    return points;
}

}  // namespace

MotionCsv parse_motion_csv(std::string_view text, const std::string& field) {
    if (text.size() > kMotionCsvBytes) {
        throw InputError(field, std::to_string(text.size()) + " bytes",
                         "at most " + std::to_string(kMotionCsvBytes));
    }
    return Parser(text, field).parse();
}

MotionCsv read_motion_csv(const std::filesystem::path& path, const std::string& field) {
    return parse_motion_csv(read_text(path, field, kMotionCsvBytes), field);
}

std::string format_motion_csv(const Motion& motion, const std::vector<std::string>& comments) {
    require_writable(motion, comments);
    std::string text;
    for (const std::string& comment : comments) text += "# " + comment + "\n";
    const std::vector<int> points = written_points(motion.positions);
    text += "time_s";
    for (const int point : points) {
        for (int axis = 0; axis < 3; ++axis) text += "," + coordinate_name(3 * point + axis);
    }
    for (const ExtraColumn& column : motion.extra) text += "," + column.name;
    text += "\n";
    for (std::size_t i = 0; i < motion.size(); ++i) {
        append_number(text, motion.time_s[i]);
        for (const int point : points) {
            for (int axis = 0; axis < 3; ++axis) {
                append_number(text += ',', motion.positions(static_cast<Index>(i), 3 * point + axis));
            }
        }
        for (const ExtraColumn& column : motion.extra) append_number(text += ',', column.values[i]);
        text += "\n";
    }
    return text;
}

void write_motion_csv(const std::filesystem::path& path, const Motion& motion,
                      const std::vector<std::string>& comments) {
    write_whole(path, format_motion_csv(motion, comments));
}

}  // namespace viaface

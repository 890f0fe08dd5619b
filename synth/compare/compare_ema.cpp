#include "synth/compare/compare_ema.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>

#include "base/error.hpp"
#include "base/whole_file.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;
using Eigen::Index;
using Eigen::VectorXd;

constexpr int kLabelRate = 10000;  // Hz: label times have four decimals
constexpr double kAround = 0.030;  // s, searched on either side of a bilabial

std::vector<std::string> split(const std::string& line, char separator) {
    std::vector<std::string> cells;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, separator);) cells.push_back(cell);
    return cells;
}

double number(const std::string& cell) {
    std::size_t used = 0;
    double value = 0;
    try {
        value = std::stod(cell, &used);
    } catch (const std::exception&) {
        used = 0;
    }
    if (used == 0 || cell.find_first_not_of(" \r", used) != std::string::npos || !(std::abs(value) <= 1e6)) {
        throw InputError("recording", cell, "a number up to 1e6");
    }
    return value;
}

// Comment lines left out.
std::vector<std::string> lines_of(const fs::path& file) {
    std::vector<std::string> lines = split(read_text(file, "recording"), '\n');
    std::erase_if(lines, [](const std::string& l) { return l.empty() || l == "\r" || l.front() == '#'; });
    if (lines.empty()) throw InputError("recording", file.string(), "a file with lines");
    return lines;
}

std::size_t column(const std::vector<std::string>& names, const std::string& name) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) throw InputError("recording", name, "a column of the file");
    return static_cast<std::size_t>(found - names.begin());
}

struct Table {
    std::vector<std::string> names;
    std::vector<std::vector<double>> rows;

    VectorXd values(const std::string& name) const {
        const std::size_t c = column(names, name);
        VectorXd result(static_cast<Index>(rows.size()));
        for (std::size_t r = 0; r < rows.size(); ++r) result(static_cast<Index>(r)) = rows[r][c];
        return result;
    }
    RowMatrix sensor(const std::string& name) const {
        RowMatrix place(static_cast<Index>(rows.size()), 3);
        place << values(name + "_x_mm"), values(name + "_y_mm"), values(name + "_z_mm");
        return place;
    }
};

Table read_table(const fs::path& file) {
    std::vector<std::string> lines = lines_of(file);
    if (lines.front().back() == '\r') lines.front().pop_back();
    Table table{split(lines.front(), ','), {}};
    for (std::size_t i = 1; i < lines.size(); ++i) {
        std::vector<double> row;
        for (const std::string& cell : split(lines[i], ',')) row.push_back(number(cell));
        if (row.size() != table.names.size())
            throw InputError("recording", lines[i], "as many cells as columns");
        table.rows.push_back(std::move(row));
    }
    return table;
}

TimedPhone read_phone(const std::string& line) {
    std::istringstream in(line);
    std::string begin, end, name;
    if (!(in >> begin >> end >> name)) throw InputError("recording", line, "begin, end and phone");
    const StressedPhone phone = parse_phone(name);
    return {phone.phone, phone.stress, std::llround(number(begin) * kLabelRate),
            std::llround(number(end) * kLabelRate)};
}

PhoneSequence read_phones(const fs::path& file) {
    PhoneSequence sequence{kLabelRate, {}};
    for (const std::string& line : lines_of(file)) {
        const TimedPhone phone = read_phone(line);
        const bool joined = sequence.phones.empty() || sequence.phones.back().end == phone.begin;
        if (!joined || phone.end <= phone.begin)
            throw InputError("recording", line, "phones in order without gaps");
        sequence.phones.push_back(phone);
    }
    return sequence;
}

std::pair<double, double> speech_of(const PhoneSequence& phones) {
    const std::size_t n = phones.phones.size();
    const bool silent_first = phones.phones.front().phone == kPause,
               silent_last = phones.phones.back().phone == kPause;
    return {silent_first ? phones.end_s(0) : phones.begin_s(0),
            silent_last ? phones.begin_s(n - 1) : phones.end_s(n - 1)};
}

Configuration at_time(const Motion& motion, double t) {
    const auto after = std::lower_bound(motion.time_s.begin(), motion.time_s.end(), t);
    if (after == motion.time_s.end()) return motion.at(motion.size() - 1);
    const std::size_t i = static_cast<std::size_t>(after - motion.time_s.begin());
    if (i == 0) return motion.at(0);
    const double share = (t - motion.time_s[i - 1]) / (motion.time_s[i] - motion.time_s[i - 1]);
    return (1 - share) * motion.at(i - 1) + share * motion.at(i);
}

struct Curves {
    VectorXd opening, protrusion, jaw;  // [samples], mm
};

Curves curves_of(const EmaRecording& r) {
    return {(r.upper_lip - r.lower_lip).rowwise().norm(), (r.upper_lip.col(0) + r.lower_lip.col(0)) / 2,
            r.jaw.col(2)};
}

Curves curves_of(const Motion& motion, const std::vector<double>& time_s) {
    const Index n = static_cast<Index>(time_s.size());
    Curves curves{VectorXd(n), VectorXd(n), VectorXd(n)};
    for (Index k = 0; k < n; ++k) {
        const Configuration c = at_time(motion, time_s[static_cast<std::size_t>(k)]);
        const Eigen::Vector3d top = point_of(c, kBorderTop), bottom = point_of(c, kBorderBottom);
        curves.opening(k) = (top - bottom).norm();
        curves.protrusion(k) = (top.z() + bottom.z()) / 2;
        curves.jaw(k) = point_of(c, kLowerIncisor).y();
    }
    return curves;
}

Agreement agreement(const VectorXd& measured, const VectorXd& moved) {
    const VectorXd m = measured.array() - measured.mean(), x = moved.array() - moved.mean();
    return {m.dot(x) / (m.norm() * x.norm()), x.norm() / m.norm()};
}

double least_time(const std::vector<double>& time_s, const VectorXd& curve, double from, double to) {
    Index least = -1;
    for (Index k = 0; k < curve.size(); ++k) {
        const double t = time_s[static_cast<std::size_t>(k)];
        if (t >= from && t <= to && (least < 0 || curve(k) < curve(least))) least = k;
    }
    if (least < 0) throw std::invalid_argument("a bilabial without samples");
    return time_s[static_cast<std::size_t>(least)];
}

std::string line(const char* format, auto... values) {
    char text[160];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

}  // namespace

EmaRecording read_ema(const fs::path& motion, const fs::path& phones) {
    const Table table = read_table(motion);
    const VectorXd time = table.values("t_s");
    return {read_phones(phones),
            {time.begin(), time.end()},
            table.sensor("UL"),
            table.sensor("LL"),
            table.sensor("JAW")};
}

EmaComparison compare(const EmaRecording& recording, const Motion& motion) {
    const auto [from, to] = speech_of(recording.phones);
    if (motion.size() < 2 || motion.time_s.front() > from || motion.time_s.back() < to) {
        throw std::invalid_argument("the motion does not cover the recording's phones");
    }
    const Curves measured = curves_of(recording), moved = curves_of(motion, recording.time_s);
    const auto first = std::lower_bound(recording.time_s.begin(), recording.time_s.end(), from);
    const auto last = std::upper_bound(recording.time_s.begin(), recording.time_s.end(), to);
    const Index begin = first - recording.time_s.begin(), count = last - first;
    const auto spoken = [&](const VectorXd& a, const VectorXd& b) {
        return agreement(a.segment(begin, count), b.segment(begin, count));
    };
    EmaComparison result{spoken(measured.opening, moved.opening),
                         spoken(measured.protrusion, moved.protrusion),
                         spoken(measured.jaw, moved.jaw),
                         {}};
    for (std::size_t i = 0; i < recording.phones.phones.size(); ++i) {
        const PhoneId phone = recording.phones.phones[i].phone;
        if (phone_info(phone).viseme != VisemeClass::kBilabial) continue;
        const double b = recording.phones.begin_s(i), e = recording.phones.end_s(i);
        result.bilabials.push_back({phone, (b + e) / 2,
                                    least_time(recording.time_s, measured.opening, b - kAround, e + kAround),
                                    least_time(recording.time_s, moved.opening, b - kAround, e + kAround)});
    }
    return result;
}

std::string report(const EmaComparison& comparison) {
    const auto figures = [](const char* name, const Agreement& a) {
        return line("%-11s r %.2f  amplitude ratio %.2f\n", name, a.correlation, a.ratio);
    };
    std::string text = figures("opening", comparison.opening) + figures("protrusion", comparison.protrusion) +
                       figures("jaw height", comparison.jaw);
    for (const ClosureTiming& c : comparison.bilabials) {
        text += line("%s at %.3f s: closes %+.0f ms from the measured closure\n",
                     phone_info(c.phone).name.data(), c.centre_s, 1000 * (c.moved_s - c.measured_s));
    }
    return text;
}

}  // namespace viaface

#include "synth/motion/via_plot.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "base/error.hpp"
#include "viapoints/spline.hpp"

namespace viaface {
namespace {

// px
constexpr double kWidth = 900, kLeft = 74, kRight = 18, kTop = 58, kBottom = 46;
constexpr double kSoundHeight = 74, kPanelHeight = 128, kBetween = 14;
constexpr double kInset = 8;       // between a trace and its panel's edge
constexpr double kPathStep = 1.5;  // along the recovered path
constexpr const char* kInk = "#1a1a1a";
constexpr const char* kGreen = "#1a8f3c";
constexpr const char* kGrey = "#8a8a8a";

std::string number(double value, int decimals = 2) {
    char digits[64];
    const double clean = std::abs(value) < 0.5 * std::pow(10, -decimals) ? 0 : value;
    const auto end =
        std::to_chars(digits, digits + sizeof digits, clean, std::chars_format::fixed, decimals).ptr;
    return {digits, end};
}

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
        }
    }
    return result;
}

std::string text_at(double x, double y, const std::string& text, const std::string& more = {}) {
    return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\"" + more + ">" + escaped(text) + "</text>\n";
}

std::string line(double x1, double y1, double x2, double y2, const std::string& style) {
    return "<line x1=\"" + number(x1) + "\" y1=\"" + number(y1) + "\" x2=\"" + number(x2) + "\" y2=\"" +
           number(y2) + "\" " + style + "/>\n";
}

// A round number of units, at most `most` of which fit into the span.
double tick_step(double span, int most) {
    const double least = span / most, decade = std::pow(10, std::floor(std::log10(least)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * decade >= least * (1 - 1e-9)) return factor * decade;
    }
    return 10 * decade;
}

int decimals_of(double step) { return std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9))); }

std::string coordinate_label(int coordinate) {
    return std::string(point_name(coordinate / 3)) + " " + "xyz"[coordinate % 3];
}

class Drawing {
  public:
    explicit Drawing(const ViaPlot& plot) : plot_(plot) {}

    std::string drawn() {
        double y = kTop;
        if (!plot_.sound.empty()) {
            sound(y);
            y += kSoundHeight + kBetween;
        }
        for (const PlottedCoordinate& coordinate : plot_.coordinates) {
            panel(coordinate, y);
            y += kPanelHeight + kBetween;
        }
        time_axis(y - kBetween);
        return head(y - kBetween + kBottom) + body_ + "</svg>\n";
    }

  private:
    double x_of(double time_s) const {
        return kLeft + (kWidth - kLeft - kRight) * (time_s - plot_.from_s) / (plot_.to_s - plot_.from_s);
    }
    bool shown(double time_s) const { return time_s >= plot_.from_s && time_s <= plot_.to_s; }

    std::string head(double height) const {
        std::string svg =
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
            "version=\"1.1\" width=\"" +
            number(kWidth, 0) + "\" height=\"" + number(height, 0) + "\" viewBox=\"0 0 " + number(kWidth, 0) +
            " " + number(height, 0) +
            "\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"12\" fill=\"" + kInk +
            "\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
        svg += text_at(kLeft, 22, plot_.title, " font-size=\"14\" font-weight=\"bold\"");
        const double y = 42;
        svg += line(kLeft, y - 4, kLeft + 26, y - 4, measured_style()) + text_at(kLeft + 32, y, "measured");
        svg += line(kLeft + 112, y - 4, kLeft + 138, y - 4, path_style()) +
               text_at(kLeft + 144, y, "recovered through the via points");
        return svg + circle(kLeft + 357, y - 4) + text_at(kLeft + 367, y, "via point");
    }

    static std::string measured_style() {
        return std::string("fill=\"none\" stroke=\"") + kInk +
               "\" stroke-width=\"2.6\" stroke-linejoin=\"round\"";
    }
    static std::string path_style() {
        return std::string("fill=\"none\" stroke=\"") + kGreen +
               "\" stroke-width=\"1.3\" stroke-linejoin=\"round\"";
    }
    static std::string circle(double x, double y) {
        return "<circle cx=\"" + number(x) + "\" cy=\"" + number(y) +
               "\" r=\"3.4\" fill=\"white\" stroke=\"" + kGreen + "\" stroke-width=\"1.4\"/>\n";
    }

    void frame(double y, double height, const std::string& label) {
        body_ += "<rect x=\"" + number(kLeft) + "\" y=\"" + number(y) + "\" width=\"" +
                 number(kWidth - kLeft - kRight) + "\" height=\"" + number(height) +
                 "\" fill=\"none\" stroke=\"" + kGrey + "\" stroke-width=\"0.8\"/>\n";
        const std::string x = number(14), middle = number(y + height / 2);
        body_ += text_at(14, y + height / 2, label,
                         " text-anchor=\"middle\" transform=\"rotate(-90 " + x + " " + middle + ")\"");
    }

    // The envelope: for each pixel the least and the largest sample.
    void sound(double y) {
        frame(y, kSoundHeight, "sound");
        int peak = 1;
        std::vector<std::array<double, 3>> columns;  // x, least, largest
        for (double x = kLeft; x < kWidth - kRight; ++x) {
            const double seconds = (plot_.to_s - plot_.from_s) / (kWidth - kLeft - kRight);
            const double begin = (plot_.from_s + (x - kLeft) * seconds) * plot_.sound_rate;
            const auto size = static_cast<double>(plot_.sound.size());
            const auto first = static_cast<std::ptrdiff_t>(std::clamp(begin, 0.0, size));
            const auto past = static_cast<std::ptrdiff_t>(
                std::clamp(std::max(begin + seconds * plot_.sound_rate, begin + 1), 0.0, size));
            if (past <= first) continue;
            const auto [least, largest] =
                std::minmax_element(plot_.sound.begin() + first, plot_.sound.begin() + past);
            peak = std::max({peak, std::abs(*least), std::abs(*largest)});
            columns.push_back({x + 0.5, static_cast<double>(*least), static_cast<double>(*largest)});
        }
        const double middle = y + kSoundHeight / 2, scale = (kSoundHeight / 2 - kInset / 2) / peak;
        body_ += std::string("<path stroke=\"") + kInk + "\" stroke-width=\"1\" d=\"";
        for (const auto& [x, least, largest] : columns) {
            body_ += "M" + number(x) + " " + number(middle - scale * largest - 0.3) + "V" +
                     number(middle - scale * least + 0.3);
        }
        body_ += "\"/>\n";
    }

    void panel(const PlottedCoordinate& coordinate, double y) {
        const MinimumJerkSpline spline(coordinate.via);
        std::vector<double> times;
        const double begin = std::max(plot_.from_s, coordinate.via.time_s.front());
        const double end = std::min(plot_.to_s, coordinate.via.time_s.back());
        const int steps = std::max(1, static_cast<int>((x_of(end) - x_of(begin)) / kPathStep));
        for (int i = 0; i <= steps; ++i) times.push_back(i < steps ? begin + (end - begin) * i / steps : end);
        const RowMatrix path = spline.at(times);

        double least = path.minCoeff(), largest = path.maxCoeff();
        std::vector<std::pair<double, double>> measured;
        for (std::size_t i = 0; i < plot_.time_s.size(); ++i) {
            if (!shown(plot_.time_s[i])) continue;
            measured.emplace_back(plot_.time_s[i], coordinate.measured[i]);
            least = std::min(least, coordinate.measured[i]);
            largest = std::max(largest, coordinate.measured[i]);
        }
        const double middle = (least + largest) / 2, span = std::max(1e-3, largest - least);
        const auto y_of = [&](double mm) {
            return y + kPanelHeight / 2 - (kPanelHeight - 2 * kInset) * (mm - middle) / span;
        };
        frame(y, kPanelHeight, coordinate_label(coordinate.coordinate) + ", mm");
        const double step = tick_step(span, 4);
        for (double tick = std::ceil(least / step) * step; tick <= largest + 1e-9 * span; tick += step) {
            body_ += line(kLeft - 4, y_of(tick), kLeft, y_of(tick), std::string("stroke=\"") + kGrey + "\"");
            body_ += text_at(kLeft - 7, y_of(tick) + 4, number(tick, decimals_of(step)),
                             " text-anchor=\"end\" font-size=\"11\"");
        }
        const auto polyline = [&](const auto& points, const std::string& style) {
            body_ += "<polyline " + style + " points=\"";
            for (const auto& [time, mm] : points) body_ += number(x_of(time)) + "," + number(y_of(mm)) + " ";
            body_ += "\"/>\n";
        };
        polyline(measured, measured_style());
        std::vector<std::pair<double, double>> recovered;
        for (std::size_t i = 0; i < times.size(); ++i)
            recovered.emplace_back(times[i], path(static_cast<Eigen::Index>(i), 0));
        polyline(recovered, path_style());
        for (std::size_t i = 0; i < coordinate.via.time_s.size(); ++i) {
            const double time = coordinate.via.time_s[i];
            if (shown(time))
                body_ += circle(x_of(time), y_of(coordinate.via.points(static_cast<Eigen::Index>(i), 0)));
        }
    }

    void time_axis(double y) {
        const double step = tick_step(plot_.to_s - plot_.from_s, 10);
        const auto first = static_cast<long>(std::ceil(plot_.from_s / step - 1e-9));
        for (long i = first; static_cast<double>(i) * step <= plot_.to_s + 1e-9; ++i) {
            const double time = static_cast<double>(i) * step;
            body_ += line(x_of(time), y, x_of(time), y + 5, std::string("stroke=\"") + kGrey + "\"");
            body_ += text_at(x_of(time), y + 19, number(time, decimals_of(step)),
                             " text-anchor=\"middle\" font-size=\"11\"");
        }
        body_ += text_at((kLeft + kWidth - kRight) / 2, y + 37, "time, s", " text-anchor=\"middle\"");
    }

    const ViaPlot& plot_;
    std::string body_;
};

}  // namespace

std::string format_via_plot(const ViaPlot& plot) {
    if (!(plot.from_s < plot.to_s)) throw std::invalid_argument("a plot shows a span of time");
    for (const PlottedCoordinate& coordinate : plot.coordinates) {
        if (coordinate.measured.size() != plot.time_s.size() || coordinate.via.points.cols() != 1)
            throw std::invalid_argument("a plotted coordinate has another shape");
    }
    return Drawing(plot).drawn();
}

std::vector<int> plotted_coordinates(const std::string& names, const std::vector<int>& measured,
                                     const std::string& field) {
    const auto is_measured = [&](int point) {
        return std::find(measured.begin(), measured.end(), point) != measured.end();
    };
    std::vector<int> coordinates;
    if (names.empty()) {
        for (const int coordinate :
             {3 * kLipTop + 1, 3 * kLipBottom + 1, 3 * kLipCornerLeft, 3 * kChin + 1}) {
            if (is_measured(coordinate / 3)) coordinates.push_back(coordinate);
        }
        if (coordinates.empty()) coordinates.push_back(3 * measured.front() + 1);
        return coordinates;
    }
    for (std::size_t begin = 0; begin <= names.size();) {
        const std::size_t end = std::min(names.find(',', begin), names.size());
        std::string name = names.substr(begin, end - begin);
        int axis = 1;
        if (name.size() > 2 && name[name.size() - 2] == '_' && name.back() >= 'x' && name.back() <= 'z') {
            axis = name.back() - 'x';
            name.resize(name.size() - 2);
        }
        const auto point = point_index(name);
        if (!point || !is_measured(*point)) {
            throw InputError(field, name,
                             "points that the motion has, as in lip_bottom_y,lip_corner_left_x,chin");
        }
        coordinates.push_back(3 * *point + axis);
        begin = end + 1;
    }
    return coordinates;
}

}  // namespace viaface

#include "viapoints/motion_c3d.hpp"

#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "viapoints/c3d_parameters.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr int kOverrun = 65535;
constexpr std::uint8_t kPointData = 0x50;

struct Layout {
    std::size_t points = 0, frames = 0, analog = 0;  // analog: samples of all channels within one frame
    std::size_t start = 0;                           // of the data in the file
    double scale = 1;                                // unit per integer; < 0: floats
    double rate = 0;                                 // Hz
    double mm_per_unit = 1;

    std::size_t number_size() const { return scale < 0 ? 4 : 2; }
    std::size_t frame_size() const { return (4 * points + analog) * number_size(); }
};

std::string shown(double value) { return std::to_string(value); }

class Reader {
  public:
    Reader(std::span<const std::uint8_t> bytes, const std::string& field, const std::string& unit)
        : bytes_(bytes, field), parameters_(bytes_, parameter_start()), unit_(unit) {}

    PointRecording read() {
        layout_ = layout();
        check_length();
        PointRecording& r = recording_;
        r.labels = labels();
        r.x_screen = screen("POINT:X_SCREEN");
        r.y_screen = screen("POINT:Y_SCREEN");
        const auto& frame = parameters_.texts("VIAFACE:FRAME");
        r.head_frame = !frame.empty() && frame.front() == "HEAD";
        const auto frames = static_cast<Index>(layout_.frames), points = static_cast<Index>(layout_.points);
        r.positions.resize(frames, 3 * points);
        r.residuals.resize(frames, points);
        for (std::size_t f = 0; f < layout_.frames; ++f) {
            r.time_s.push_back(static_cast<double>(f) / layout_.rate);
            for (std::size_t p = 0; p < layout_.points; ++p) read_point(f, p);
        }
        if (at_origin_ > 0)
            r.remarks.push_back(std::to_string(at_origin_) +
                                " samples lie at 0, 0, 0 and are not marked as missing");
        return std::move(recording_);
    }

  private:
    std::size_t parameter_start() const {
        if (bytes_.size() < kC3dBlock)
            bytes_.fail(std::to_string(bytes_.size()) + " bytes", "a header of 512");
        if (bytes_.u8(1) != kPointData)
            bytes_.fail("byte 1 is " + std::to_string(bytes_.u8(1)), "80, of a C3D file");
        if (bytes_.u8(0) < 2)
            bytes_.fail("parameters in block " + std::to_string(bytes_.u8(0)), "2 or above");
        return (bytes_.u8(0) - std::size_t{1}) * kC3dBlock;
    }

    std::size_t word(int number) const { return bytes_.u16(2 * static_cast<std::size_t>(number - 1)); }

    Layout layout() {
        Layout layout;
        layout.points = points();
        layout.frames = frames();
        layout.analog = word(3);
        layout.start = data_start();
        layout.scale = parameters_.number("POINT:SCALE").value_or(bytes_.f32(12));
        layout.rate = parameters_.number("POINT:RATE").value_or(bytes_.f32(20));
        if (!std::isfinite(layout.scale) || layout.scale == 0)
            bytes_.fail("POINT:SCALE " + shown(layout.scale), "a finite number other than 0");
        if (!(layout.rate > 0) || !(layout.rate <= 1e6))
            bytes_.fail("POINT:RATE " + shown(layout.rate), "frames per second, above 0 to 1e6");
        const auto& units = parameters_.texts("POINT:UNITS");
        const std::string unit = units.empty() || units.front().empty() ? unit_ : units.front();
        const auto mm = millimetres_per(unit);
        if (!mm) bytes_.fail("POINT:UNITS \"" + unit + "\"", "mm, cm or m");
        layout.mm_per_unit = *mm;
        return layout;
    }

    std::size_t points() const {
        const auto used = parameters_.number("POINT:USED");
        const auto in_header = static_cast<double>(word(2));
        if (used && in_header != 0 && *used != in_header)
            bytes_.fail("POINT:USED " + shown(*used), "the header's " + shown(in_header));
        const double points = used.value_or(in_header);
        if (!(points >= 1) || points > static_cast<double>(kMotionFilePoints))
            bytes_.fail(shown(points) + " points", "1 to " + std::to_string(kMotionFilePoints));
        return static_cast<std::size_t>(points);
    }

    std::size_t frames() const {
        double frames = parameters_.number("POINT:FRAMES").value_or(0);
        if (frames == 0) frames = static_cast<double>(word(5)) - static_cast<double>(word(4)) + 1;
        if (const auto trial = trial_frames();
            trial && (frames == kOverrun || frames == std::fmod(*trial, kOverrun + 1)))
            frames = *trial;
        const auto longer = parameters_.number("POINT:LONG_FRAMES");
        if (longer && frames == kOverrun) frames = *longer;
        if (!(frames >= 1) || frames > static_cast<double>(kMotionFileSamples) ||
            frames != std::floor(frames))
            bytes_.fail(shown(frames) + " frames", "1 to " + std::to_string(kMotionFileSamples));
        return static_cast<std::size_t>(frames);
    }

    std::optional<double> trial_frames() const {
        const auto field = [&](const std::string& name) -> std::optional<double> {
            const auto low = parameters_.number(name, 0);
            if (!low) return std::nullopt;
            return *low + (kOverrun + 1) * parameters_.number(name, 1).value_or(0);
        };
        const auto first = field("TRIAL:ACTUAL_START_FIELD"), last = field("TRIAL:ACTUAL_END_FIELD");
        if (!first || !last || *last < *first) return std::nullopt;
        return *last - *first + 1;
    }

    std::size_t data_start() {
        const double told = parameters_.number("POINT:DATA_START").value_or(0);
        const bool is_block = told >= 0 && told <= 0xffff;
        const std::size_t header = word(9), parameter = is_block ? static_cast<std::size_t>(told) : 0;
        const auto behind = [&](std::size_t block) {
            return block > 1 && (block - 1) * kC3dBlock > parameters_.last();
        };
        if (!behind(header) && !behind(parameter))
            bytes_.fail("data from block " + std::to_string(header), "a block behind the parameters");
        const std::size_t block = behind(header) ? header : parameter;
        if (!is_block || (parameter != 0 && parameter != header))
            recording_.remarks.push_back("the header starts the data at block " + std::to_string(header) +
                                         ", POINT:DATA_START at " +
                                         (is_block ? std::to_string(parameter) : shown(told)) +
                                         "; read from " + std::to_string(block));
        return (block - 1) * kC3dBlock;
    }

    void check_length() const {
        const std::size_t size = layout_.frame_size();
        const std::size_t room = bytes_.size() > layout_.start ? bytes_.size() - layout_.start : 0;
        if (room / size < layout_.frames)
            bytes_.fail("an end within frame " + std::to_string(room / size + 1) + " of " +
                            std::to_string(layout_.frames),
                        std::to_string(layout_.frames) + " frames of " + std::to_string(size) + " bytes");
        if (layout_.frames * layout_.points > 256u << 20)
            bytes_.fail(std::to_string(layout_.frames * layout_.points) + " positions", "at most 2^28");
    }

    std::string screen(const std::string& name) const {
        const auto& texts = parameters_.texts(name);
        return texts.empty() ? "" : texts.front();
    }

    std::vector<std::string> labels() const {
        std::vector<std::string> given;
        for (int part = 1;; ++part) {
            const auto& more = parameters_.texts("POINT:LABELS" + (part == 1 ? "" : std::to_string(part)));
            if (more.empty()) break;
            given.insert(given.end(), more.begin(), more.end());
        }
        std::vector<std::string> labels;
        for (std::size_t p = 0; p < layout_.points; ++p) {
            const bool named = p < given.size() && !given[p].empty();
            labels.push_back(unused_label(labels, named ? given[p] : "point " + std::to_string(p + 1)));
        }
        return labels;
    }

    void read_point(std::size_t frame, std::size_t point) {
        const std::size_t size = layout_.number_size(),
                          at = layout_.start + frame * layout_.frame_size() + 4 * point * size;
        const bool floats = layout_.scale < 0;
        double place[3];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            place[axis] =
                floats ? bytes_.f32(at + axis * size) : bytes_.i16(at + axis * size) * layout_.scale;
            place[axis] *= layout_.mm_per_unit;
        }
        const double word = floats ? bytes_.f32(at + 3 * size) : bytes_.i16(at + 3 * size);
        const auto f = static_cast<Index>(frame), p = static_cast<Index>(point);
        const bool there = word >= 0 && std::isfinite(place[0] + place[1] + place[2]);
        if (there && (std::abs(place[0]) > kFarthestPoint_mm || std::abs(place[1]) > kFarthestPoint_mm ||
                      std::abs(place[2]) > kFarthestPoint_mm))
            bytes_.fail("frame " + std::to_string(frame + 1) + ", " + recording_.labels[point] + " far away",
                        "a coordinate within 1e6 mm");
        for (Index axis = 0; axis < 3; ++axis)
            recording_.positions(f, 3 * p + axis) = there ? place[axis] : kNaN;
        const int residual = there ? static_cast<int>(std::min(word, 65535.0)) & 0xff : 0;
        recording_.residuals(f, p) = there ? residual * std::abs(layout_.scale) * layout_.mm_per_unit : kNaN;
        if (there && place[0] == 0 && place[1] == 0 && place[2] == 0) ++at_origin_;
    }

    C3dBytes bytes_;
    C3dParameters parameters_;
    std::string unit_;
    Layout layout_;
    PointRecording recording_;
    std::size_t at_origin_ = 0;
};

}  // namespace

bool is_c3d(std::span<const std::uint8_t> bytes) {
    return bytes.size() >= kC3dBlock && bytes[0] >= 2 && bytes[1] == kPointData;
}

PointRecording parse_c3d(std::span<const std::uint8_t> bytes, const std::string& field,
                         const std::string& unit) {
    return Reader(bytes, field, unit).read();
}

}  // namespace viaface

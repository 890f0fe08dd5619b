#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/error.hpp"
#include "viapoints/c3d_bytes.hpp"
#include "viapoints/motion_c3d.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr std::size_t kOverrun = 65535, kLabelsEach = 255, kMostBlocks = 255;
constexpr int kPoint = 1, kAnalog = 2, kPlatform = 3, kTrial = 4, kManufacturer = 5, kViaface = 6;

struct Facts {
    std::size_t frames, first_frame;
    double rate;   // Hz
    double scale;  // mm, below 0
};

Facts facts_of(const PointRecording& recording) {
    const std::vector<double>& times = recording.time_s;
    if (times.size() < 2) throw InputError("motion", "one sample", "at least two, for a C3D file's rate");
    const double rate = static_cast<double>(times.size() - 1) / (times.back() - times.front());
    for (std::size_t i = 0; i < times.size(); ++i) {
        if (std::abs(times[i] - times.front() - static_cast<double>(i) / rate) < 0.1 / rate) continue;
        throw InputError("motion", "an uneven step at " + std::to_string(times[i]) + " s",
                         "even times: a C3D file has one rate");
    }
    double farthest = 0;
    for (const double mm : recording.positions.reshaped()) {
        if (!std::isnan(mm)) farthest = std::max(farthest, std::abs(mm));
    }
    const double first = std::clamp(std::round(times.front() * rate) + 1, 1.0, 1e9);
    return {times.size(), static_cast<std::size_t>(first), rate, -std::max(farthest, 1.0) / 32000};
}

class Section {
  public:
    Section() : writer_(C3dProcessor::kIntel) {
        for (const int byte : {1, 0x50, 0, static_cast<int>(C3dProcessor::kIntel)}) writer_.u8(byte);
    }

    void group(int number, const std::string& name) {
        begin(-number, name);
        close();
    }
    void word(int group, const std::string& name, const std::vector<int>& values) {
        array(group, name, 2, values.size());
        for (const int value : values) writer_.u16(value);
        close();
    }
    void floats(int group, const std::string& name, const std::vector<double>& values) {
        array(group, name, 4, values.size());
        for (const double value : values) writer_.f32(value);
        close();
    }
    void text(int group, const std::string& name, const std::string& value) {
        array(group, name, -1, value.size(), true);
        writer_.text(value, value.size());
        close();
    }
    void texts(int group, const std::string& name, std::span<const std::string> values) {
        const std::size_t width =
            std::clamp<std::size_t>(std::ranges::max_element(values, {}, &std::string::size)->size(), 1, 255);
        begin(group, name);
        for (const std::size_t byte : {std::size_t{0xff}, std::size_t{2}, width, values.size()})
            writer_.u8(static_cast<int>(byte));
        for (const std::string& value : values) writer_.text(value, width);
        close();
    }
    // The place of the word written last, to be filled in.
    std::size_t last_word() const { return writer_.size() - 3; }

    Bytes finished(std::size_t data_start_at) {
        writer_.set_u16(link_, 0);
        writer_.fill_block();
        const std::size_t blocks = writer_.size() / kC3dBlock;
        if (blocks > kMostBlocks)
            throw InputError("motion", "too many or too long labels", "255 blocks of parameters");
        writer_.set_u8(2, static_cast<int>(blocks));
        writer_.set_u16(data_start_at, static_cast<int>(blocks + 2));
        return writer_.bytes();
    }

  private:
    void begin(int number, const std::string& name) {
        writer_.u8(static_cast<int>(name.size()));
        writer_.u8(number);
        writer_.text(name, name.size());
        link_ = writer_.size();
        writer_.u16(0);
    }
    // Values that follow: one number as such, more as a row.
    void array(int group, const std::string& name, int type, std::size_t count, bool always_row = false) {
        begin(group, name);
        writer_.u8(type);
        const bool row = always_row || count != 1;
        writer_.u8(row ? 1 : 0);
        if (row) writer_.u8(static_cast<int>(count));
    }
    void close() {
        writer_.u8(0);  // no description
        writer_.set_u16(link_, static_cast<int>(writer_.size() - link_));
    }

    C3dWriter writer_;
    std::size_t link_ = 0;
};

void add_labels(Section& section, const std::vector<std::string>& labels) {
    for (std::size_t first = 0, part = 1; first < labels.size(); first += kLabelsEach, ++part) {
        const auto some = std::span(labels).subspan(first, std::min(kLabelsEach, labels.size() - first));
        section.texts(kPoint, "LABELS" + (part == 1 ? "" : std::to_string(part)), some);
    }
}

void add_frames(Section& section, const Facts& facts) {
    if (facts.frames < kOverrun) return section.word(kPoint, "FRAMES", {static_cast<int>(facts.frames)});
    section.floats(kPoint, "FRAMES", {static_cast<double>(facts.frames)});
    const std::size_t last = facts.first_frame + facts.frames - 1;
    const auto halves = [](std::size_t n) {
        return std::vector<int>{static_cast<int>(n & 0xffff), static_cast<int>(n >> 16)};
    };
    section.group(kTrial, "TRIAL");
    section.word(kTrial, "ACTUAL_START_FIELD", halves(facts.first_frame));
    section.word(kTrial, "ACTUAL_END_FIELD", halves(last));
}

Bytes parameters(const PointRecording& recording, const Facts& facts) {
    Section section;
    section.group(kPoint, "POINT");
    section.word(kPoint, "USED", {static_cast<int>(recording.labels.size())});
    section.floats(kPoint, "SCALE", {facts.scale});
    section.floats(kPoint, "RATE", {facts.rate});
    section.word(kPoint, "DATA_START", {0});
    const std::size_t data_start_at = section.last_word();
    section.text(kPoint, "UNITS", "mm");
    add_frames(section, facts);
    add_labels(section, recording.labels);
    if (recording.head_frame) {
        section.text(kPoint, "X_SCREEN", "+X");
        section.text(kPoint, "Y_SCREEN", "+Y");
        section.group(kViaface, "VIAFACE");
        section.text(kViaface, "FRAME", "HEAD");
    }
    section.group(kAnalog, "ANALOG");
    section.word(kAnalog, "USED", {0});
    section.floats(kAnalog, "GEN_SCALE", {1});
    section.floats(kAnalog, "RATE", {facts.rate});
    section.group(kPlatform, "FORCE_PLATFORM");
    section.word(kPlatform, "USED", {0});
    section.group(kManufacturer, "MANUFACTURER");
    section.text(kManufacturer, "SOFTWARE", "viaface");
    return section.finished(data_start_at);
}

Bytes header(const PointRecording& recording, const Facts& facts, std::size_t data_block) {
    C3dWriter writer(C3dProcessor::kIntel);
    writer.u8(2);
    writer.u8(0x50);
    const auto in_word = [](std::size_t n) { return static_cast<int>(std::min(n, kOverrun)); };
    for (const int word : {in_word(recording.labels.size()), 0, in_word(facts.first_frame),
                           in_word(facts.first_frame + facts.frames - 1), 0})
        writer.u16(word);
    writer.f32(facts.scale);
    writer.u16(static_cast<int>(data_block));
    writer.u16(0);
    writer.f32(facts.rate);
    writer.fill_block();
    return writer.bytes();
}

Bytes data(const PointRecording& recording, const Facts& facts) {
    C3dWriter writer(C3dProcessor::kIntel);
    const bool residuals = recording.residuals.size() != 0;
    for (Index f = 0; f < recording.positions.rows(); ++f) {
        for (Index p = 0; p < recording.positions.cols() / 3; ++p) {
            const auto place = recording.positions.block<1, 3>(f, 3 * p);
            const bool there = place.allFinite();
            for (const double mm : place) writer.f32(there ? mm : 0);
            const double residual =
                residuals && there && recording.residuals(f, p) > 0
                    ? std::clamp(std::round(recording.residuals(f, p) / -facts.scale), 1.0, 255.0)
                    : 0;
            writer.f32(there ? residual : -1);
        }
    }
    writer.fill_block();
    return writer.bytes();
}

}  // namespace

Bytes format_c3d(const PointRecording& recording) {
    const auto points = static_cast<Index>(recording.labels.size());
    const auto samples = static_cast<Index>(recording.size());
    if (recording.positions.rows() != samples || recording.positions.cols() != 3 * points ||
        (recording.residuals.size() != 0 &&
         (recording.residuals.rows() != samples || recording.residuals.cols() != points)))
        throw std::invalid_argument("a recording's labels, times and positions differ in number");
    if (points == 0 || points > static_cast<Index>(kMotionFilePoints))
        throw InputError("motion", std::to_string(points) + " points",
                         "1 to " + std::to_string(kMotionFilePoints));
    const Facts facts = facts_of(recording);
    const Bytes middle = parameters(recording, facts);
    Bytes file = header(recording, facts, middle.size() / kC3dBlock + 2);
    for (const Bytes& part : {middle, data(recording, facts)})
        file.insert(file.end(), part.begin(), part.end());
    return file;
}

}  // namespace viaface

#include "synth/motion/motion_input.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "synth/motion/facegood.hpp"
#include "synth/motion/live_link.hpp"
#include "synth/motion/npy.hpp"
#include "synth/motion/recorded_head.hpp"
#include "synth/motion/retarget.hpp"
#include "viapoints/motion_c3d.hpp"
#include "viapoints/motion_trc.hpp"
#include "viapoints/point_csv.hpp"
#include "viapoints/point_names.hpp"
#include "viapoints/via_stream.hpp"

namespace viaface {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

std::string line(const char* format, auto... values) {
    char text[400];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

constexpr double kStreamRate = 100;      // Hz, of a stream's samples
constexpr double kLongestStream = 7200;  // s

bool is_stream(std::span<const std::uint8_t> bytes) {
    constexpr std::string_view kStart = "\x89VIA\r\n";
    return bytes.size() > kStart.size() &&
           std::string_view(reinterpret_cast<const char*>(bytes.data()), kStart.size()) == kStart;
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

PointRecording points_of(const Bytes& bytes, const std::string& field, const std::string& unit) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (is_c3d(bytes)) return parse_c3d(bytes, field, unit);
    if (is_trc(text)) return parse_trc(text, field, unit);
    return parse_point_csv(text, field, unit);
}

class Reading {
  public:
    Reading(std::string field, const Talker& talker, const MotionInputOptions& options)
        : field_(std::move(field)), talker_(talker), options_(options) {}

    MotionInput performance(const BlendRecording& recording) {
        Retargeted moved = retarget(talker_.face, talker_.poser, recording);
        std::vector<std::string> lacking;
        for (const LackingShape& shape : moved.lacking)
            lacking.push_back(line("%s (up to %.2f)", shape.name.c_str(), shape.largest));
        say("blend shapes: %zu, at full scale", recording.names.size());
        if (!lacking.empty()) input_.report.push_back("the talker lacks " + joined(lacking));
        input_.motion = seen(moved.motion, "face");
        input_.head = recorded_head(input_.motion);
        if (!input_.head.empty()) say("head: turns up to %.1f degrees", widest_turn_degrees(input_.head));
        return finished();
    }

    // A stream, sampled; spans that were damaged are missing.
    MotionInput stream(std::span<const std::uint8_t> bytes) {
        const DecodedStream decoded = decoded_stream(bytes);
        for (const StreamDamage& damage : decoded.damage) {
            if (damage.size > 0) say("damage: %s at byte %zu", damage.what.c_str(), damage.offset);
        }
        if (decoded.segments.empty()) throw InputError(field_, "no segment", "a stream with motion in it");
        Motion motion;
        const double begin = decoded.begin_s(), end = decoded.end_s();
        if (!(end - begin <= kLongestStream)) throw InputError(field_, "a longer stream", "at most 7200 s");
        for (int i = 0; begin + i / kStreamRate < end; ++i) motion.time_s.push_back(begin + i / kStreamRate);
        motion.time_s.push_back(end);
        motion.positions = decoded.positions(motion.time_s);
        input_.motion = seen(motion, "motion");
        return finished();
    }

    MotionInput points(PointRecording recording) {
        for (const std::string& remark : recording.remarks) input_.report.push_back("remark: " + remark);
        bridge(recording);
        recording = still(std::move(recording));
        const NameMap map =
            options_.map.empty() ? NameMap{} : parse_name_map(read_text(options_.map, "--map"), "--map");
        LaidOut laid = lay_out(recording, map, field_);
        std::vector<std::string> names;
        for (const auto& [label, point] : laid.named)
            names.push_back(label == point ? point : label + " as " + point);
        input_.report.push_back("points: " + joined(names));
        if (!laid.others.empty()) input_.report.push_back("kept beside them: " + joined(laid.others));
        const bool own = options_.whose == Whose::kTalkers ||
                         (options_.whose == Whose::kAsTheFileSays && recording.head_frame);
        input_.motion = own ? std::move(laid.motion) : of_person(std::move(laid.motion), recording);
        return finished();
    }

  private:
    void say(const char* format, auto... values) { input_.report.push_back(line(format, values...)); }

    void bridge(PointRecording& recording) {
        for (const Gap& gap : bridge_gaps(recording, options_.longest_gap_s, options_.long_gaps, field_))
            say("gap: %s, %.3f s from %.3f s, %s", gap.label.c_str(), gap.length_s(), gap.from_s,
                gap.bridged ? "bridged" : "left");
    }

    DecodedStream decoded_stream(std::span<const std::uint8_t> bytes) const {
        try {
            std::vector<const StreamModel*> models;
            for (const StreamModel& model : options_.stream_models) models.push_back(&model);
            return decode_stream(bytes, models);
        } catch (const InputError&) {
            throw;
        } catch (const std::runtime_error& error) {
            throw InputError(field_, error.what(), "a whole head of a via-point stream");
        }
    }

    // Without the samples at which there is no point; motion runs on between those next to them.
    Motion seen(const Motion& motion, const char* what) {
        std::vector<Index> kept;
        for (Index i = 0; i < motion.positions.rows(); ++i) {
            if (!motion.positions.row(i).array().isNaN().all()) kept.push_back(i);
        }
        if (kept.empty())
            throw InputError(field_, line("no %s at any time", what), line("%s at one time at least", what));
        Motion result;
        for (const Index i : kept) {
            const double now = motion.time_s[static_cast<std::size_t>(i)];
            if (!result.time_s.empty() && i > kept[result.size() - 1] + 1) {
                const double gap = now - result.time_s.back();
                if (gap > options_.longest_gap_s)
                    throw InputError(field_,
                                     line("no %s for %.3f s from %.3f s", what, gap, result.time_s.back()),
                                     line("gaps up to %.3f s (--longest-gap)", options_.longest_gap_s));
                say("gap: no %s for %.3f s from %.3f s, bridged", what, gap, result.time_s.back());
            }
            result.time_s.push_back(now);
        }
        result.positions = motion.positions(kept, Eigen::all);
        for (const ExtraColumn& column : motion.extra) {
            result.extra.push_back({column.name, {}});
            for (const Index i : kept)
                result.extra.back().values.push_back(column.values[static_cast<std::size_t>(i)]);
        }
        return result;
    }

    PointRecording still(PointRecording recording) {
        if (options_.head_markers.empty()) return recording;
        const bool find = options_.head_markers == std::vector<std::string>{"found"};
        head_ = head_motion(recording, find ? least_moving(recording, field_) : options_.head_markers);
        say("head: turns up to %.1f degrees, moves up to %.1f mm; residual %.2f mm rms of %s%s",
            head_.widest_turn_degrees, head_.farthest_shift_mm, head_.residual_mm,
            joined(head_.markers).c_str(), find ? ", the least moving points" : "");
        return without_head(std::move(recording), head_);
    }

    Motion of_person(Motion motion, const PointRecording& recording) {
        const Configuration talker_rest = talker_.poser.drawn_points(talker_.face.rest);
        PersonOptions options = options_.person;
        if (options.up_axis.empty()) options.up_axis = recording.y_screen;
        const Person person = measure_person(motion, talker_rest, options);
        say("axes: x, y, z point %s; the best turn of all is %.0f degrees away%s", person.axes.name.c_str(),
            person.axes.fit_degrees, person.axes.fit_degrees > 15 ? " (--axes fit takes it)" : "");
        say("rest: %.3f to %.3f s", person.rest.from_s, person.rest.to_s);
        say("scale: %.3f, %.3f, %.3f (width %s, height %s)", person.scale.x(), person.scale.y(),
            person.scale.z(), person.width_from.empty() ? "not measured" : person.width_from.c_str(),
            person.height_from.empty() ? "not measured" : person.height_from.c_str());
        input_.person = person;
        carry_head(person, talker_rest);
        return as_talker(std::move(motion), person, talker_rest);
    }

    // The head's turns in the talker's frame, about where the person's points are his.
    void carry_head(const Person& person, const Configuration& talker_rest) {
        Vector3d person_middle = Vector3d::Zero(), talker_middle = Vector3d::Zero();
        int count = 0;
        for (int p = 0; p < kPoints; ++p) {
            if (!point_of(person.rest.points, p).allFinite()) continue;
            person_middle += point_of(person.rest.points, p);
            talker_middle += point_of(talker_rest, p);
            ++count;
        }
        person_middle /= count;
        talker_middle /= count;
        const Eigen::Matrix3d& axes = person.axes.head_from_file;
        for (const RigidTurn& frame : head_.frames) {
            Eigen::Isometry3d head = Eigen::Isometry3d::Identity();
            head.linear() = axes * frame.turn.toRotationMatrix() * axes.transpose();
            head.translation() =
                axes * (frame(person_middle) - person_middle) + talker_middle - head.linear() * talker_middle;
            input_.head.push_back(head);
        }
    }

    MotionInput finished() {
        if (input_.head.empty()) {
            for (const RigidTurn& frame : head_.frames)
                input_.head.push_back(Eigen::Translation3d(frame.shift) * frame.turn);
        }
        for (const std::string& text : description_of(input_.motion)) input_.report.push_back(text);
        return std::move(input_);
    }

    std::string field_;
    const Talker& talker_;
    const MotionInputOptions& options_;
    HeadMotion head_;
    MotionInput input_;
};

// mm, of the farthest two places of a point along its box's diagonal.
double range_of(const Motion& motion, int point) {
    Vector3d least = Vector3d::Constant(1e300), most = -least;
    for (Index i = 0; i < motion.positions.rows(); ++i) {
        const Vector3d place = motion.positions.block<1, 3>(i, 3 * point).transpose();
        if (!place.allFinite()) continue;
        least = least.cwiseMin(place);
        most = most.cwiseMax(place);
    }
    return (most - least).norm();
}

}  // namespace

MotionInput read_motion(const std::filesystem::path& file, const Talker& talker,
                        const MotionInputOptions& options) {
    return motion_of(read_bytes(file, "motion", kMotionFileBytes), file.filename().string(), talker, options);
}

MotionInput motion_of(const Bytes& bytes, const std::string& field, const Talker& talker,
                      const MotionInputOptions& options) {
    if (bytes.empty()) throw InputError(field, "an empty file", "motion as CSV, C3D, TRC, npy or .via");
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    Reading reading(field, talker, options);
    if (is_npy(bytes)) return reading.performance(facegood_recording(parse_npy(bytes, field), field));
    if (is_stream(bytes)) return reading.stream(bytes);
    if (is_live_link(text)) return reading.performance(parse_live_link(text, field));
    return reading.points(points_of(bytes, field, options.unit));
}

std::vector<std::string> description_of(const Motion& motion) {
    const double span = motion.time_s.back() - motion.time_s.front();
    int points = 0, farthest = 0;
    double range = 0;
    for (int p = 0; p < kPoints; ++p) {
        if (motion.positions.middleCols<3>(3 * p).array().isNaN().all()) continue;
        ++points;
        if (range_of(motion, p) <= range) continue;
        farthest = p;
        range = range_of(motion, p);
    }
    std::vector<std::string> lines = {
        line("motion: %d of %d points, %zu samples, %.3f to %.3f s, %.2f per second", points, kPoints,
             motion.size(), motion.time_s.front(), motion.time_s.back(),
             span > 0 ? static_cast<double>(motion.size() - 1) / span : 0.0)};
    lines.push_back(
        line("range of motion: up to %.1f mm, of %s", range, std::string(point_name(farthest)).c_str()));
    return lines;
}

}  // namespace viaface

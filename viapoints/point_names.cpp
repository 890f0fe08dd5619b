#include "viapoints/point_names.hpp"

#include <algorithm>
#include <limits>

#include "base/error.hpp"
#include "viapoints/cells.hpp"

namespace viaface {
namespace {

using Eigen::Index;

const std::map<std::string, Point> kOtherNames = {{"ul", kBorderTop},      {"upper_lip", kBorderTop},
                                                  {"ll", kBorderBottom},   {"lower_lip", kBorderBottom},
                                                  {"ml", kLipCornerLeft},  {"mouth_left", kLipCornerLeft},
                                                  {"mr", kLipCornerRight}, {"mouth_right", kLipCornerRight},
                                                  {"jaw", kLowerIncisor},  {"li", kLowerIncisor},
                                                  {"tt", kTongueTip},      {"tb", kTongueBody},
                                                  {"tr", kTongueRear},     {"td", kTongueRear}};

std::optional<int> point_meant(const std::string& label, const NameMap& map) {
    if (const auto given = map.find(label); given != map.end())
        return given->second.empty() ? std::nullopt : point_index(given->second);
    const std::string name =
        in_lower_case(label.substr(label.find(':') == label.npos ? 0 : label.rfind(':') + 1));
    if (const auto point = point_index(name)) return point;
    const auto other = kOtherNames.find(name);
    return other == kOtherNames.end() ? std::nullopt : std::optional<int>(other->second);
}

void add_extra(const PointRecording& recording, std::size_t label, Motion& motion) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto values = recording.positions.col(static_cast<Index>(3 * label) + axis);
        motion.extra.push_back(
            {recording.labels[label] + "_" + "xyz"[axis] + "_mm", {values.begin(), values.end()}});
    }
}

void add_residuals(const PointRecording& recording, std::size_t label, const std::string& name,
                   Motion& motion) {
    if (recording.residuals.size() == 0) return;
    const auto values = recording.residuals.col(static_cast<Index>(label));
    motion.extra.push_back({name + "_residual_mm", {values.begin(), values.end()}});
}

}  // namespace

NameMap parse_name_map(std::string_view text, const std::string& field) {
    NameMap map;
    Lines lines(text, field);
    while (lines.next()) {
        std::string_view rest = trimmed(lines.line());
        if (rest.empty() || rest.front() == '#') continue;
        const bool pair = rest.find('=') != rest.npos;
        const std::string label(trimmed(cut(rest, '='))), name(trimmed(rest));
        if (!pair || label.empty()) lines.fail("", lines.line(), "label=name of the layout");
        if (!name.empty() && !point_index(name))
            lines.fail("", name, "a name of the layout, as chin; see LAYOUT.md");
        if (!map.emplace(label, name).second) lines.fail("", label, "each label once");
    }
    return map;
}

LaidOut lay_out(const PointRecording& recording, const NameMap& map, const std::string& field) {
    for (const auto& [label, name] : map) {
        if (std::ranges::find(recording.labels, label) == recording.labels.end())
            throw InputError("--map", label, "labels of the recording");
    }
    LaidOut result;
    Motion& motion = result.motion;
    motion.time_s = recording.time_s;
    motion.extra = recording.extra;
    motion.positions = RowMatrix::Constant(static_cast<Index>(recording.size()), kCoordinates,
                                           std::numeric_limits<double>::quiet_NaN());
    std::map<int, std::string> taken;
    for (std::size_t label = 0; label < recording.labels.size(); ++label) {
        const std::string& name = recording.labels[label];
        const auto point = point_meant(name, map);
        if (!point) {
            add_extra(recording, label, motion);
            add_residuals(recording, label, name, motion);
            result.others.push_back(name);
            continue;
        }
        const std::string point_called(point_name(*point));
        if (const auto [at, fresh] = taken.emplace(*point, name); !fresh)
            throw InputError(field, at->second + " and " + name,
                             "one label for " + point_called + " (--map)");
        motion.positions.middleCols<3>(3 * *point) =
            recording.positions.middleCols<3>(static_cast<Index>(3 * label));
        add_residuals(recording, label, point_called, motion);
        result.named.emplace_back(name, point_called);
    }
    if (result.named.empty())
        throw InputError(field, "no label of the layout", "labels as chin or UL, or a table: --map FILE");
    return result;
}

PointRecording labelled(const Motion& motion) {
    PointRecording recording;
    recording.time_s = motion.time_s;
    std::vector<Index> columns;
    for (int point = 0; point < kPoints; ++point) {
        if (motion.positions.middleCols<3>(3 * point).array().isNaN().all()) continue;
        recording.labels.emplace_back(point_name(point));
        for (Index axis = 0; axis < 3; ++axis) columns.push_back(3 * point + axis);
    }
    recording.positions = motion.positions(Eigen::all, columns);
    return recording;
}

}  // namespace viaface

#include "server/motion_options.hpp"

#include "base/error.hpp"
#include "server/via_models.hpp"
#include "viapoints/cells.hpp"

namespace viaface {
namespace {

std::vector<std::string> words_of(const std::string& text) {
    std::vector<std::string> words;
    for (const std::string_view cell : cells_of(text, ',')) words.emplace_back(cell);
    return words;
}

Eigen::Vector3d scale_of(const std::string& text) {
    std::vector<double> numbers;
    for (const std::string_view cell : cells_of(text, ','))
        numbers.push_back(finite_number(cell).value_or(0));
    if (numbers.size() == 1) numbers.resize(3, numbers[0]);
    if (numbers.size() != 3) throw InputError("--scale", text, "one number or x,y,z, above 0");
    return {numbers[0], numbers[1], numbers[2]};
}

std::pair<double, double> span_of(const std::string& text) {
    const std::size_t dash = text.find('-', 1);
    const auto from = finite_number(text.substr(0, dash));
    const auto to = dash == text.npos ? std::nullopt : finite_number(text.substr(dash + 1));
    if (!from || !to || !(*to > *from)) throw InputError("--rest", text, "T0-T1 in s, as 0.1-0.4");
    return {*from, *to};
}

Whose whose_of(const std::string& text) {
    if (text.empty()) return Whose::kAsTheFileSays;
    if (text == "talker") return Whose::kTalkers;
    if (text == "another") return Whose::kAnothers;
    throw InputError("--whose", text, "talker or another");
}

}  // namespace

MotionInputOptions MotionOptions::parsed(const std::string& talker) const {
    MotionInputOptions input;
    if (!unit.empty() && !millimetres_per(unit)) throw InputError("--unit", unit, "mm, cm or m");
    if (!(longest_gap >= 0)) throw InputError("--longest-gap", std::to_string(longest_gap), "s, from 0");
    input.unit = unit;
    input.map = map;
    input.longest_gap_s = longest_gap;
    input.long_gaps = leave_gaps ? LongGaps::kLeave : LongGaps::kRefuse;
    if (!head_markers.empty()) input.head_markers = words_of(head_markers);
    input.whose = whose_of(whose);
    input.person.axes = axes;
    if (!rest.empty()) input.person.rest_s = span_of(rest);
    if (!scale.empty()) input.person.scale = scale_of(scale);
    input.stream_models = drawn_stream_models(talker);
    return input;
}

void add_motion_options(CLI::App& app, MotionOptions& options) {
    app.add_option("motion", options.file,
                   "C3D, TRC, CSV of points (NAME_x_mm, NAME_y_mm, NAME_z_mm, ...), Live Link Face CSV, "
                   ".via, or an npy "
                   "of FACEGOOD; told by its content")
        ->required();
    app.add_option("--unit", options.unit, "mm, cm or m, where the file names none");
    app.add_option("--map", options.map, "a file of lines label=point of the layout");
    app.add_option(
        "--head-markers", options.head_markers,
        "labels of three or more markers on the skull, as a,b,c, by which the head's motion is taken "
        "out; found: the least moving points");
    app.add_option("--longest-gap", options.longest_gap,
                   "s, of gaps that are bridged; longer ones are refused")
        ->capture_default_str();
    app.add_flag("--leave-gaps", options.leave_gaps, "leave longer gaps: the points are estimated meanwhile");
    app.add_option(
        "--whose", options.whose,
        "talker: the points are the talker's, in his head frame; another: somebody else's; as the file "
        "says when absent");
    app.add_option("--axes", options.axes,
                   "of somebody else's points: found, fit (any turn), or where x, y and z point to, as "
                   "forward,left,up")
        ->capture_default_str();
    app.add_option("--rest", options.rest,
                   "of somebody else's points: T0-T1 in s, the face at rest; found when absent");
    app.add_option(
        "--scale", options.scale,
        "of somebody else's points: one number or x,y,z; by mouth width and face height when absent");
}

}  // namespace viaface

#include <iostream>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "server/commands.hpp"
#include "server/film_output.hpp"
#include "server/motion_options.hpp"
#include "server/requests.hpp"
#include "viapoints/motion_c3d.hpp"
#include "viapoints/motion_csv.hpp"
#include "viapoints/motion_trc.hpp"
#include "viapoints/point_names.hpp"

namespace viaface {
namespace {

struct ConvertOptions {
    MotionOptions motion;
    std::string talker = kDefaultTalker, output;
};

void write_motion(const std::string& output, const Motion& motion) {
    const std::string ending = std::filesystem::path(output).extension().string();
    if (ending == ".csv")
        return write_motion_csv(output, motion, {"mm, head frame: x to the talker's left, y up, z forward"});
    PointRecording points = labelled(motion);
    points.head_frame = true;
    if (ending == ".c3d") return write_whole(output, format_c3d(points));
    if (ending == ".trc") return write_whole(output, format_trc(points));
    throw InputError("output", output, "a name that ends in .csv, .c3d or .trc");
}

int run_convert(const ConvertOptions& options) {
    const auto talker = talker_at(options.talker);
    const MotionInput read = read_motion(options.motion.file, *talker, options.motion.parsed(options.talker));
    for (const std::string& line : read.report) std::cout << line << "\n";
    if (options.output.empty()) return 0;
    write_motion(options.output, read.motion);
    const bool csv = options.output.ends_with(".csv");
    if (!csv && !read.motion.extra.empty())
        std::cout << read.motion.extra.size() << " other columns are kept in .csv alone\n";
    return 0;
}

}  // namespace

Command add_motion(CLI::App& program) {
    auto options = std::make_shared<ConvertOptions>();
    CLI::App* app = program.add_subcommand("motion", "Motion files of other systems.");
    app->require_subcommand(1);
    CLI::App* convert = app->add_subcommand(
        "convert", "A motion file as motion of a talker's points; prints what was read and done.");
    add_motion_options(*convert, options->motion);
    convert->add_option("-o,--output", options->output,
                        "x.csv, x.c3d or x.trc, in mm; nothing is written when absent");
    convert
        ->add_option("--talker", options->talker,
                     "a built-in talker's name, or a talker's folder (with a / in it)")
        ->capture_default_str();
    return [options] { return run_convert(*options); };
}

}  // namespace viaface

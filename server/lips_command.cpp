#include <array>
#include <cstdio>
#include <iostream>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "server/commands.hpp"
#include "server/requests.hpp"
#include "server/subcommands.hpp"
#include "synth/lips/learned_lips.hpp"
#include "synth/lips/lip_report.hpp"
#include "synth/lips/two_view_motion.hpp"
#include "synth/talker/talker_shelf.hpp"
#include "viapoints/motion_csv.hpp"

namespace viaface {
namespace {

using Paths = std::vector<std::filesystem::path>;

struct LearningOptions {
    Paths motions;
    std::string talker = kDefaultTalker;
    LipTraining training;
};

void add_learning(CLI::App* app, LearningOptions& options) {
    app->add_option(
           "motion", options.motions,
           "motion CSV with the 16 lip points, or takes of blend shapes (Live Link Face CSV, FACEGOOD "
           "npy), retargeted through the talker's shapes")
        ->required();
    app->add_option("--talker", options.talker, "a built-in talker's name")->capture_default_str();
    app->add_option("--modes", options.training.modes,
                    "modes to keep, 1 to 48: few are robust, many accurate")
        ->check(CLI::Range(1, LipMesh::kMarkedCoordinates))
        ->capture_default_str();
    app->add_option("--noise-mm", options.training.noise_mm,
                    "standard deviation of a coordinate of the points, 0.001 to 10 mm: modes below what it "
                    "would give are dropped")
        ->check(CLI::Range(0.001, 10.0))
        ->capture_default_str();
}

Command add_train(CLI::App& lips) {
    struct Options : LearningOptions {
        std::filesystem::path output, from;
        double least_confidence = 0.9;
    };
    auto options = std::make_shared<Options>();
    CLI::App* app =
        lips.add_subcommand("train", "Learns the modes of lips from motion, or goes on from a lip model.");
    add_learning(app, *options);
    app->add_option("--from", options->from,
                    "a lip model to go on from: it counts as many frames as it was learned from");
    app->add_option("--least-confidence", options->least_confidence,
                    "0 to 1: samples of lips tracked with less are left out")
        ->check(CLI::Range(0.0, 1.0))
        ->capture_default_str();
    app->add_option("-o,--output", options->output, "the lip model to write")->required();
    return [options] {
        const auto talker = TalkerShelf(talkers_folder()).load(options->talker);
        const LipFrames frames = read_lip_frames(options->motions, *talker, options->least_confidence);
        const LipModel model = options->from.empty() ? learn_from(frames, options->training, options->motions)
                                                     : learn_on(load_lip_model(options->from), frames,
                                                                options->training, options->motions);
        write_whole(options->output, write_lip_model(model));
        std::cout << model_text(model);
        return 0;
    };
}

Command add_report(CLI::App& lips) {
    struct Options : LearningOptions {
        Paths test;
    };
    auto options = std::make_shared<Options>();
    CLI::App* app = lips.add_subcommand(
        "report",
        "Variance by mode and reconstruction from two of three coordinates, cross-validated, beside "
        "the talker's recitations and the paper.");
    add_learning(app, *options);
    app->add_option("--test", options->test, "motion that was not learned from");
    return [options] {
        const auto talker = TalkerShelf(talkers_folder()).load(options->talker);
        const LipFrames train = read_lip_frames(options->motions, *talker);
        std::optional<LipFrames> test;
        if (!options->test.empty()) test = read_lip_frames(options->test, *talker);
        std::cout << lip_report_text(
            report_lips(train, test, recited_lip_frames(*talker), options->training));
        return 0;
    };
}

Command add_triangulate(CLI::App& lips) {
    struct Options {
        std::filesystem::path first, second, cameras, output;
    };
    auto options = std::make_shared<Options>();
    CLI::App* app = lips.add_subcommand("triangulate", "Points marked in two calibrated views, as motion.");
    app->add_option("first", options->first, "CSV: time_s, NAME_u_px, NAME_v_px, ...")->required();
    app->add_option("second", options->second, "the same of the second view, at the same times")->required();
    app->add_option("--cameras", options->cameras,
                    "JSON: {\"first\": [[4 numbers] x 3], \"second\": ...}, px from head coordinates in mm")
        ->required();
    app->add_option("-o,--output", options->output, "motion CSV to write")->required();
    return [options] {
        const CameraPair cameras = parse_cameras(read_text(options->cameras, "cameras", 1u << 20));
        const TwoViewMotion made = triangulated(read_motion_csv(options->first, "first").motion,
                                                read_motion_csv(options->second, "second").motion, cameras);
        write_motion_csv(options->output, made.motion, {"triangulated from two views"});
        std::printf("rms distance in the views %.3f px\n", made.error_px);
        return 0;
    };
}

}  // namespace

Command add_lips(CLI::App& program) {
    CLI::App* app = program.add_subcommand(
        "lips", "The lip model: learned from motion of sixteen points, and what it is worth.");
    return one_of(*app, std::array<CommandAdder, 3>{add_train, add_report, add_triangulate});
}

}  // namespace viaface

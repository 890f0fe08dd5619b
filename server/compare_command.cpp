#include <iostream>

#include "base/error.hpp"
#include "server/commands.hpp"
#include "server/requests.hpp"
#include "synth/compare/compare_ema.hpp"
#include "synth/say/recital.hpp"
#include "synth/talker/talker_shelf.hpp"

namespace viaface {
namespace {

constexpr double kMotionRate = 200;  // Hz

// The talker speaks the recording's phones at the recording's own times.
Motion spoken(const Codex& codex, const PhoneSequence& phones) {
    const Recital recital = recite(codex, {.words = {}, .phones = phones, .word_of_phone = {}, .sound = {}});
    Motion motion;
    for (int n = 0; n / kMotionRate <= phones.end_s(phones.phones.size() - 1); ++n)
        motion.time_s.push_back(n / kMotionRate);
    motion.positions = recital.motion.at(motion.time_s);
    return motion;
}

}  // namespace

Command add_compare(CLI::App& program) {
    struct Options {
        std::string motion, phones, talker = kDefaultTalker;
    };
    auto options = std::make_shared<Options>();
    CLI::App* app = program.add_subcommand(
        "compare",
        "A talker beside articulography of the same sentence at its own phone times: correlation and "
        "amplitude ratio of lip opening, protrusion and jaw height; closures.");
    app->add_option("motion", options->motion,
                    "CSV with t_s and the sensors UL, LL, JAW in mm, x forward, y left, z up")
        ->required();
    app->add_option("phones", options->phones, "phone times: \"begin end PHONE\" in s, a line each")
        ->required();
    app->add_option("--talker", options->talker, "a built-in talker's name")->capture_default_str();
    return [options] {
        const EmaRecording recording = read_ema(options->motion, options->phones);
        const auto talker = TalkerShelf(talkers_folder()).load(options->talker);
        std::cout << report(compare(recording, spoken(talker->codex, recording.phones)));
        return 0;
    };
}

}  // namespace viaface

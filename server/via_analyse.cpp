#include <chrono>
#include <cstdio>

#include "server/via_command.hpp"
#include "viapoints/analysis.hpp"
#include "viapoints/motion_csv.hpp"

namespace viaface {

Command add_via_analyse(CLI::App& via) {
    struct Options {
        std::string motion;
        double max_error_mm = 0.5;
    };
    auto options = std::make_shared<Options>();
    CLI::App* app = via.add_subcommand(
        "analyse", "The via points of a recorded motion, from which it is recovered within a bound.");
    app->add_option("motion", options->motion, "motion CSV in mm")->required();
    app->add_option("--max-error", options->max_error_mm, "bound in mm for each point at each sample")
        ->capture_default_str();
    return [options] {
        const Motion motion = read_motion_csv(options->motion).motion;
        const auto start = std::chrono::steady_clock::now();
        const Analysis analysis = analyse_in_full(motion, {options->max_error_mm});
        const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        const double seconds = motion.time_s.back() - motion.time_s.front();
        std::printf("%zu via points, %.2f per s\nlargest error %.3f mm, rms %.3f mm\n%.0f x real time\n",
                    analysis.track.time_s.size(), static_cast<double>(analysis.track.time_s.size()) / seconds,
                    analysis.max_error_mm, analysis.rms_error_mm, seconds / took);
        return 0;
    };
}

}  // namespace viaface

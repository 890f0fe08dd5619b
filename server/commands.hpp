// The commands of the program. Each adds its options to the command line and returns what runs when it was
// called; what runs returns the exit status. Results go to stdout, progress to stderr.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>

namespace viaface {

using Command = std::function<int()>;

Command add_say(CLI::App& program);
Command add_serve(CLI::App& program);
Command add_talker(CLI::App& program);
Command add_align(CLI::App& program);
Command add_codex(CLI::App& program);
Command add_compare(CLI::App& program);
Command add_bench(CLI::App& program);
Command add_via(CLI::App& program);
Command add_motion(CLI::App& program);
Command add_render(CLI::App& program);
Command add_lips(CLI::App& program);
Command add_track(CLI::App& program);

// The folder of the built-in talkers: $VIAFACE_TALKERS, else the one of the source tree the program was built
// from.
std::filesystem::path talkers_folder();

}  // namespace viaface

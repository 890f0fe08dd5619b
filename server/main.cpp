// viaface: text in, a talking-face video out.

#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "server/commands.hpp"

namespace {

constexpr int kBadInput = 2;

int run(int argc, char** argv) {
    CLI::App program(
        "Text in, a talking-face video out; between them the motion of measured points on a face.",
        "viaface");
    program.set_version_flag("--version", "viaface " VIAFACE_VERSION);
    program.require_subcommand(1);
    using Adder = viaface::Command (*)(CLI::App&);
    const Adder adders[] = {viaface::add_say, viaface::add_serve, viaface::add_talker, viaface::add_compare,
                            viaface::add_bench};
    std::vector<std::pair<const CLI::App*, viaface::Command>> commands;
    for (const Adder add : adders) {
        viaface::Command command = add(program);
        commands.emplace_back(program.get_subcommands({}).back(), std::move(command));
    }
    try {
        program.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return program.exit(error, std::cout, std::cerr) == 0 ? 0 : kBadInput;
    }
    for (const auto& [app, command] : commands) {
        if (app->parsed()) return command();
    }
    return kBadInput;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const viaface::InputError& error) {
        std::fprintf(stderr, "viaface: %s\n", error.what());
        return kBadInput;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "viaface: %s\n", viaface::describe(error).c_str());
        return EXIT_FAILURE;
    }
}

std::filesystem::path viaface::talkers_folder() {
    const char* given = std::getenv("VIAFACE_TALKERS");
    return given != nullptr ? given : VIAFACE_TALKERS_FOLDER;
}

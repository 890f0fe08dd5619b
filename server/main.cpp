// viaface: text in, a talking-face video out.

#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "server/commands.hpp"

namespace {

constexpr int kBadInput = 2;

[[noreturn]] void refuse_command(const CLI::App& program) {
    std::string commands;
    for (const CLI::App* command : program.get_subcommands({}))
        commands += (commands.empty() ? "" : ", ") + command->get_name();
    const auto given = program.remaining();
    throw viaface::InputError("command", given.empty() ? "" : given.front(), commands);
}

// What the option that a message is about would take.
std::string allowed_instead(const CLI::App& program, const std::string& message) {
    std::string allowed, called = "viaface";
    const CLI::App* app = &program;
    while (!app->get_subcommands().empty()) {
        app = app->get_subcommands().front();
        called += " " + app->get_name();
    }
    for (const CLI::Option* option : app->get_options()) {
        if (message.find(option->get_name() + " ") == std::string::npos &&
            message.find(option->get_name() + ":") == std::string::npos)
            continue;
        allowed += "allowed: " + option->get_name() + " takes " + option->get_description() + "\n";
    }
    return allowed + "See " + called + " --help\n";
}

int run(int argc, char** argv) {
    CLI::App program(
        "Text in, a talking-face video out; between them the motion of measured points on a face.",
        "viaface");
    program.set_version_flag("--version", "viaface " VIAFACE_VERSION);
    program.require_subcommand(1);
    using Adder = viaface::Command (*)(CLI::App&);
    const Adder adders[] = {viaface::add_say,    viaface::add_serve, viaface::add_talker,
                            viaface::add_align,  viaface::add_codex, viaface::add_compare,
                            viaface::add_bench,  viaface::add_via,   viaface::add_motion,
                            viaface::add_render, viaface::add_lips,  viaface::add_track};
    std::vector<std::pair<const CLI::App*, viaface::Command>> commands;
    for (const Adder add : adders) {
        viaface::Command command = add(program);
        commands.emplace_back(program.get_subcommands({}).back(), std::move(command));
    }
    try {
        program.parse(argc, argv);
    } catch (const CLI::Success& asked) {
        return program.exit(asked, std::cout, std::cerr);
    } catch (const CLI::ParseError& error) {
        if (program.get_subcommands().empty()) refuse_command(program);
        std::fprintf(stderr, "viaface: %s\n%s", error.what(), allowed_instead(program, error.what()).c_str());
        return kBadInput;
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

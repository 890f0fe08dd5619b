#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <iostream>
#include <vector>

#include "server/commands.hpp"
#include "synth/talker/talker_shelf.hpp"

namespace viaface {
namespace {

int list_talkers() {
    const TalkerShelf shelf(talkers_folder());
    for (const auto& name : shelf.names()) {
        const auto description = shelf.description(name);
        std::cout << name << "\t" << description.value("summary", "") << "\n";
    }
    return 0;
}

// Making a talker is another program: the model that performs the recitations is not linked into this one.
int run_training(std::vector<std::string> arguments) {
    const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "viaface_train";
    std::vector<char*> argv;
    arguments.insert(arguments.begin(), program.string());
    for (auto& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    std::cout << std::flush;
    ::execv(program.c_str(), argv.data());
    throw std::runtime_error("starting " + program.filename().string() + ": " + std::strerror(errno));
}

}  // namespace

Command add_talker(CLI::App& program) {
    struct Options {
        std::string scans = "../shared/data/ict_facekit", output;
        CLI::App *list = nullptr, *make = nullptr;
    };
    auto options = std::make_shared<Options>();
    CLI::App* app = program.add_subcommand("talker", "Lists the talkers, or makes one.");
    app->require_subcommand(1);
    options->list = app->add_subcommand("list", "The built-in talkers.");
    options->make = app->add_subcommand(
        "make", "Makes the built-in talker again from its scans and performed recitations.");
    options->make->add_option("--scans", options->scans, "folder of the blend-shape head")
        ->capture_default_str();
    options->make->add_option("-o,--output", options->output,
                              "the talker's folder (default: the built-in momo)");
    return [options] {
        if (options->list->parsed()) return list_talkers();
        const std::string output =
            options->output.empty() ? (talkers_folder() / "momo").string() : options->output;
        return run_training({"make", options->scans, output});
    };
}

}  // namespace viaface

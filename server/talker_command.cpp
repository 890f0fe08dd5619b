#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <iostream>
#include <vector>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "facemodel/png.hpp"
#include "server/commands.hpp"
#include "server/film_output.hpp"
#include "synth/say/sheet.hpp"
#include "synth/talker/talker_shelf.hpp"

namespace viaface {
namespace {

constexpr const char* kScansHelp =
    "A folder of scans may hold scans.json; all of its fields may be left out:\n"
    "  \"postures\": {\"neutral\": \"face.ply\", \"a\": \"a.ply\", \"jawOpen\": \"open.ply\", ...}\n"
    "      files by name; the built-in talkers' postures (a, i, u, e, o, m_pressed, f, ...) and named "
    "shapes\n"
    "      (jawOpen, eyeBlink_L, ...) take their places, others are added\n"
    "  \"units\": \"m\", \"cm\", \"mm\", \"inch\" or millimetres to the unit\n"
    "  \"axes\": {\"up\": \"+y\", \"forward\": \"-z\"}\n"
    "  \"mirrored\": true\n"
    "  \"colour\": \"face.png\"\n"
    "  \"landmarks\": {\"nose\": [x, y, z], ...}\n"
    "  \"cylinder\": {\"step\": 0.1, \"angle_from_deg\": 0, \"angle_to_deg\": 360, \"bottom\": 0, \"top\": "
    "300}\n"
    "      of a range map (.pgm)";

int list_talkers() {
    const TalkerShelf shelf(talkers_folder());
    for (const auto& name : shelf.names()) {
        const auto description = shelf.description(name);
        std::cout << name << "\t" << description.value("summary", "") << "\n";
    }
    return 0;
}

int write_sheet(const std::string& talker, const std::string& file) {
    write_whole(file, encode_png(contact_sheet(*talker_at(talker))));
    return 0;
}

// Making a talker is another program: the model that performs the recitations is not linked into this one.
int run_beside(const char* name, std::vector<std::string> arguments) {
    const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / name;
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
        std::string sheet_of, sheet;
        std::string scans = "../shared/data/ict_facekit", output, person;
        CLI::App *list = nullptr, *make = nullptr, *sheet_command = nullptr;
    };
    auto options = std::make_shared<Options>();
    CLI::App* app = program.add_subcommand("talker", "Lists the talkers, or makes one.");
    app->require_subcommand(1);
    options->list = app->add_subcommand("list", "The built-in talkers.");
    options->make = app->add_subcommand(
        "make",
        "Makes a talker: of a scan, with a built-in talker's motion, or, from a blend-shape head, a "
        "built-in talker again with its performed recitations.");
    options->make->footer(kScansHelp);
    options->make->add_option("folder,--scans", options->scans, "folder of scans, or of the blend-shape head")
        ->capture_default_str();
    options->make->add_option("-o,--output", options->output,
                              "the talker's folder (default: the built-in talker's own)");
    options->make->add_option("--person", options->person,
                              "which built-in talker to make again (default: momo)");
    options->sheet_command = app->add_subcommand(
        "sheet", "Writes a contact sheet: what the talker looks like at rest, in speech and from the side.");
    options->sheet_command
        ->add_option("talker", options->sheet_of,
                     "a built-in talker's name, or a talker's folder (with a / in it)")
        ->required();
    options->sheet_command->add_option("-o,--output", options->sheet, "x.png")->required();
    return [options] {
        if (options->list->parsed()) return list_talkers();
        if (options->sheet_command->parsed()) return write_sheet(options->sheet_of, options->sheet);
        const bool blend_head = std::filesystem::exists(options->scans + "/generic_neutral_mesh.obj");
        const bool named = !options->person.empty();
        const std::string person = named ? options->person : "momo";
        const std::string built_in = (talkers_folder() / person).string();
        if (!blend_head && options->output.empty())
            throw InputError("--output", "", "a folder for the talker that is made of the scan");
        if (!blend_head && named)
            throw InputError("--person", person, "none: a talker of a scan has the scan's face");
        if (!blend_head) return run_beside("viaface_adapt", {options->scans, options->output, built_in});
        const std::string output = options->output.empty() ? built_in : options->output;
        return run_beside("viaface_train", {"make", options->scans, output, person});
    };
}

}  // namespace viaface

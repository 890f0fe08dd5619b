#include <charconv>
#include <cstdio>
#include <iostream>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "server/commands.hpp"
#include "server/film_output.hpp"
#include "server/requests.hpp"
#include "synth/learn/held_out.hpp"
#include "synth/learn/learnt_talker.hpp"
#include "synth/learn/performed_takes.hpp"
#include "synth/learn/sentences.hpp"
#include "synth/learn/take_files.hpp"
#include "synth/motion/motion_input.hpp"
#include "viapoints/codex_file.hpp"

namespace viaface {
namespace {

struct CodexOptions {
    std::string folder, talker = kDefaultTalker, output, share = "20%", voice = "rms", sentences;
    std::size_t count = 0;
    CLI::App *learn = nullptr, *check = nullptr, *perform = nullptr;
};

void tell(const std::string& line) { std::fprintf(stderr, "viaface: %s\n", line.c_str()); }

double share_of(const std::string& text) {
    double percent = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), percent);
    const std::string rest(end, text.data() + text.size());
    if (error != std::errc() || (rest != "" && rest != "%"))
        throw InputError("--left-out", text, "a share such as 20%");
    return rest == "%" ? percent / 100 : percent;
}

// Takes are one talker's: where they are another person's points, one scale is for all.
std::optional<Eigen::Vector3d> common_scale(const std::filesystem::path& folder, const Talker& talker) {
    std::vector<Person> persons;
    for (const TakeFiles& files : find_takes(folder, "recordings")) {
        const MotionInput input = read_motion(files.motion, talker);
        if (input.person) persons.push_back(*input.person);
    }
    return persons.empty() ? std::nullopt : std::optional(median_scale(persons));
}

RecordedTakes takes_of(const CodexOptions& options) {
    const auto talker = talker_at(options.talker);
    MotionInputOptions reading{.person = {.scale = common_scale(options.folder, *talker)}};
    const auto read = [&](const std::filesystem::path& file, const PhoneSequence& phones) {
        const std::size_t last = phones.phones.size() - 1;
        reading.person.quiet_s = {{phones.begin_s(0), phones.end_s(0)},
                                  {phones.begin_s(last), phones.end_s(last)}};
        MotionInput input = read_motion(file, *talker, reading);
        for (const std::string& line : input.report) tell(file.filename().string() + ": " + line);
        return std::move(input.motion);
    };
    return read_takes(options.folder, "recordings", read, tell);
}

int learn(const CodexOptions& options) {
    const RecordedTakes takes = takes_of(options);
    tell("learning");
    const LearntTalker talker = make_talker(takes, talker_folder(options.talker), options.output);
    std::cout << as_text(talker);
    return 0;
}

int check(const CodexOptions& options) {
    const double share = share_of(options.share);
    const RecordedTakes takes = takes_of(options);
    tell("learning from the others");
    std::cout << as_text(check_held_out(takes, share, "--left-out"));
    return 0;
}

int perform(const CodexOptions& options) {
    const auto talker = talker_folder(options.talker);
    const auto file =
        options.sentences.empty() ? talker / "corpus.txt" : std::filesystem::path(options.sentences);
    std::vector<std::string> texts = read_sentences(file);
    if (options.count > 0 && options.count < texts.size()) texts.resize(options.count);
    const auto description = read_talker_json(talker);
    const Codex codex = read_codex(read_bytes(talker / "codex.via", "--talker"));
    export_takes(
        codex, texts, options.voice, options.folder,
        "recitation by the talker " + description.at("name").get<std::string>() + ", voice " + options.voice,
        [](double share) {
            std::fprintf(stderr, "\rviaface: %3.0f%%%s", 100 * share, share >= 1 ? "\n" : "");
        });
    return 0;
}

}  // namespace

Command add_codex(CLI::App& program) {
    auto options = std::make_shared<CodexOptions>();
    CLI::App* app =
        program.add_subcommand("codex", "Learns a talker's motion from recordings, and checks it.");
    app->require_subcommand(1);
    constexpr const char* kFolder =
        "folder of recordings: motion (.csv, .c3d, .trc, .via), sound (.wav, .flac) and words (.TextGrid or "
        ".txt) "
        "of the same name";
    options->learn =
        app->add_subcommand("learn", "A new talker: the face of another, motion from recordings.");
    options->learn->add_option("recordings", options->folder, kFolder)->required();
    options->learn->add_option("-o,--output", options->output, "the new talker's folder")->required();
    options->learn
        ->add_option("--talker", options->talker, "whose face: a name, or a folder (with a / in it)")
        ->capture_default_str();
    options->check = app->add_subcommand(
        "check", "Learns from some recordings, speaks the others, and prints how far they are apart.");
    options->check->add_option("recordings", options->folder, kFolder)->required();
    options->check
        ->add_option("--talker", options->talker, "in whose head frame: a name, or a folder (with a / in it)")
        ->capture_default_str();
    options->check->add_option("--left-out", options->share, "share of the recordings, 1% to 50%")
        ->capture_default_str();
    options->perform = app->add_subcommand(
        "export", "A talker's recitations as recordings: motion, sound, TextGrid and text of each sentence.");
    options->perform->add_option("output", options->folder, "a new folder")->required();
    options->perform->add_option("--talker", options->talker, "a name, or a folder (with a / in it)")
        ->capture_default_str();
    options->perform->add_option("--sentences", options->sentences,
                                 "a file with a sentence per line (default: the talker's own corpus)");
    options->perform->add_option("--count", options->count, "only the first so many sentences; 0 for all")
        ->capture_default_str();
    options->perform->add_option("--voice", options->voice, "rms, slt, awb or kal16")->capture_default_str();
    return [options] {
        if (options->learn->parsed()) return learn(*options);
        return options->check->parsed() ? check(*options) : perform(*options);
    };
}

}  // namespace viaface

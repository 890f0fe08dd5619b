// viaface_train make SCANS OUTPUT [PERSON]: a built-in talker, momo or who is named, from the scans and
// performed recitations, which the others have from momo's; shapes and codex, in place of make: its face and
// estimators alone, or its codex; viaface_train stream DATA TALKER: the stream model of a talker that is
// made. A program of its own, so that the model that performs is not linked into what speaks.

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "facemodel/gltf.hpp"
#include "synth/learn/sentences.hpp"
#include "synth/talker/talker.hpp"
#include "synth/training/bake.hpp"
#include "synth/training/corpus.hpp"
#include "synth/training/follow_modes.hpp"
#include "synth/training/learn.hpp"
#include "synth/training/left_out.hpp"
#include "synth/training/make_face.hpp"
#include "synth/training/people.hpp"
#include "synth/training/report.hpp"
#include "synth/training/stream_lesson.hpp"
#include "viapoints/codex_file.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCopyright =
    "Shapes computed from the ICT Face Model Light, Copyright (c) 2020 USC Institute for Creative "
    "Technologies, MIT licence; "
    "meshes, textures and motion by the viaface authors, MIT licence";

constexpr const char* kStreamProvenance =
    "Basis and statistics of via-point streams: from the talker's own speech, from its named shapes, and "
    "from "
    "two recordings of blend-shape weights (FACEGOOD, MIT licence) as its points move in them. No recorded "
    "motion is kept.";

void tell(const std::string& what) { std::fprintf(stderr, "viaface: %s\n", what.c_str()); }

nlohmann::json description(const Person& person) {
    auto told = talker_description(
        person.name, person.summary + "; the motion is performed by a model, not measured from a person");
    told["voice"] = person.voice;
    told["provenance"] = {
        {"shape",
         "Computed from posed scans of the ICT Face Model Light (ICT-FaceKit) on meshes of this "
         "project's own. No scan of one person."},
        {"textures", "Painted by procedure; no photograph."},
        {"motion",
         "Performed by a gestural model for the timing of a speech synthesiser (Flite, voice rms); not "
         "measured from a person."},
        {"corpus", "Sentences written for this project, and strings of phones made by rule."}};
    told["licence"] = "MIT";
    told["notice"] =
        "Copyright (c) 2020 USC Institute for Creative Technologies (ICT Face Model Light, MIT "
        "licence); the notice stands whole in NOTICE.";
    return told;
}

Landmarks landmarks_of(const HeadToFace& source) {
    const BlendHead& head = source.head();
    const Nodes rest = source.resting(head.generic());
    Landmarks places;
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = rest.row(head.landmarks().at(i)).transpose();
    return places;
}

void print_distances(const HeadToFace& source) {
    std::printf(
        "display face: asked to drawn, each posture left out of modes and estimators, mm\n%-18s %8s %8s "
        "%8s\n",
        "posture", "mean", "p95", "max");
    for (const DrawnDistance& d : left_out_distances(source)) {
        std::printf("%-18s %8.2f %8.2f %8.2f\n", d.name.c_str(), d.mean_mm, d.ninety_fifth_mm, d.largest_mm);
    }
}

void make_shapes(const BlendHead& head, const Person& person, const fs::path& output) {
    tell("fitting the display mesh");
    const HeadToFace source(head, person.looks.hair);
    print_distances(source);
    Face face = make_face(source);
    tell("baking textures");
    bake_surfaces(face, source.canvas(), landmarks_of(source), person.looks);
    const PoseTraining training = pose_training(source, face);
    follow_modes(face, source, training);
    write_whole(output / "face.glb", write_glb(face, kCopyright));
    write_whole(output / "estimators.bin", write_training(training));
}

Codex performed_codex(const BlendHead& head, const fs::path& corpus) {
    tell("speaking the corpus for its timing");
    return learn_codex(Performer(head), timed_corpus(read_sentences(corpus), generated_strings()), tell);
}

// Shapes move everyone's nodes alike: a person's recitations are momo's from the person's own rest.
Codex carried_codex(const BlendHead& head, const fs::path& momo) {
    const Codex codex = read_codex(read_bytes(momo / "codex.via", "momo"));
    ConfigurationBasis basis = codex.basis;
    basis.mean += head.points(head.neutral().nodes) - head.points(head.generic());
    return make_codex(basis, codex.rest, codex.recitations, codex.provenance + " From another face's rest.",
                      codex.scatter_mm);
}

void make_codex(const BlendHead& head, const Person& person, const fs::path& corpus, const fs::path& output) {
    const Codex codex =
        person.identity.empty() ? performed_codex(head, corpus) : carried_codex(head, corpus.parent_path());
    write_whole(output / "codex.via", write_codex(codex));
    const Coverage coverage = coverage_of(codex);
    std::printf("codex: %zu units, %d phones, %d diphones, %d triphones; %zu diphones missing\n",
                codex.units.size(), coverage.phones, coverage.diphones, coverage.triphones,
                coverage.missing_diphones.size());
    const SpokenShares shares = spoken_shares(codex, timed_corpus(read_sentences(VIAFACE_HELD_OUT), {}));
    std::printf(
        "on sentences outside the corpus: %.1f%% exact triphones, %.1f%% by viseme class, %.1f%% halves\n",
        100 * shares.exact, 100 * shares.of_class, 100 * shares.half);
}

int make_stream(const fs::path& data, const fs::path& talker) {
    teach_stream(talker, data, read_sentences(VIAFACE_CORPUS), tell);
    nlohmann::json told = nlohmann::json::parse(read_text(talker / "talker.json", "talker"));
    told["files"]["stream"] = "stream.bin";
    told["provenance"]["stream"] = kStreamProvenance;
    write_whole(talker / "talker.json", std::string_view(told.dump(2) + "\n"));
    return 0;
}

int shapes(const fs::path& scans, const fs::path& output, const Person& person) {
    fs::create_directories(output);
    make_shapes(BlendHead(scans, person.identity), person, output);
    return 0;
}

int codex(const fs::path& scans, const fs::path& output, const Person& person) {
    fs::create_directories(output);
    make_codex(BlendHead(scans, person.identity), person, fs::path(VIAFACE_CORPUS), output);
    write_whole(output / "talker.json", std::string_view(description(person).dump(2) + "\n"));
    return 0;
}

int make(const fs::path& scans, const fs::path& output, const Person& person) {
    if (person.identity.empty()) std::printf("%s\n", atr_report(BlendHead(scans)).c_str());
    shapes(scans, output, person);
    codex(scans, output, person);
    return make_stream(scans.parent_path(), output);
}

}  // namespace
}  // namespace viaface

int main(int argc, char** argv) {
    try {
        const std::string step = argc == 4 || argc == 5 ? argv[1] : "";
        const viaface::Person& person = viaface::person_named(argc == 5 ? argv[4] : "momo");
        if (step == "make") return viaface::make(argv[2], argv[3], person);
        if (step == "shapes") return viaface::shapes(argv[2], argv[3], person);
        if (step == "codex") return viaface::codex(argv[2], argv[3], person);
        if (step == "stream" && argc == 4) return viaface::make_stream(argv[2], argv[3]);
        throw viaface::InputError("arguments", argc > 1 ? argv[1] : "",
                                  "make, shapes or codex, SCANS OUTPUT [PERSON]; or stream DATA TALKER");
    } catch (const viaface::InputError& error) {
        std::fprintf(stderr, "viaface: %s\n", error.what());
        return 2;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "viaface: %s\n", viaface::describe(error).c_str());
        return 1;
    }
}

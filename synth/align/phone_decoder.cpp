#include "synth/align/phone_decoder.hpp"

#include <pocketsphinx/pocketsphinx.h>
#include <sphinxbase/err.h>
#include <sphinxbase/fsg_model.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <memory>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <string>

#include "base/bytes.hpp"

namespace viaface {
namespace {

struct Release {
    void operator()(cmd_ln_t* settings) const { cmd_ln_free_r(settings); }
    void operator()(ps_decoder_t* decoder) const { ps_free(decoder); }
    void operator()(fsg_model_t* grammar) const { fsg_model_free(grammar); }
};
template <class T>
using Handle = std::unique_ptr<T, Release>;

constexpr const char* kSilence = "<sil>";
constexpr double kUsualBeam = 1e-48;  // where no path is much worse than the best for long
constexpr double kScoreScale = 1024;  // the decoder keeps 2^-10 of its logarithms

void check(bool done, const std::string& what) {
    if (!done) throw std::runtime_error("PocketSphinx: " + what + " failed");
}

// The library ends the program when a file of the model cannot be read.
void check_model() {
    for (const char* name : {"mdef", "means", "variances", "sendump", "transition_matrices", "noisedict"}) {
        const auto file = std::filesystem::path(VIAFACE_SPHINX_MODEL) / name;
        if (!std::filesystem::is_regular_file(file)) {
            throw std::runtime_error("no acoustic model at " + file.string() +
                                     ": Debian's pocketsphinx-en-us holds it");
        }
    }
}

Handle<ps_decoder_t> new_decoder(double beam) {
    const std::string width = (std::ostringstream() << beam).str();

    static std::once_flag quiet;
    std::call_once(quiet, [] { err_set_logfp(nullptr); });
    check_model();
    const Handle<cmd_ln_t> settings(
        cmd_ln_init(nullptr, ps_args(), 1, "-hmm", VIAFACE_SPHINX_MODEL, "-remove_silence", "no", "-cmn",
                    "batch", "-dither", "no", "-fsgusefiller", "no", "-fsgusealtpron", "no", "-beam",
                    width.c_str(), "-pbeam", width.c_str(), "-wbeam", width.c_str(), "-maxhmmpf", "-1",
                    "-wip", "1", "-lw", "1", "-bestpath", "no", nullptr));
    check(settings != nullptr, "reading the settings");
    Handle<ps_decoder_t> decoder(ps_init(settings.get()));
    check(decoder != nullptr, "starting");
    return decoder;
}

// The model's own name of a phone: it has no ax.
std::string sphinx_name(PhoneId phone) {
    std::string name(phone_info(phone).name);
    if (name == "ax") name = "ah";
    std::transform(name.begin(), name.end(), name.begin(), [](char c) { return std::toupper(c); });
    return name;
}

std::string word_of(std::size_t arc) { return "arc" + std::to_string(arc); }

void set_grammar(ps_decoder_t* decoder, const PhoneGraph& graph) {
    for (std::size_t i = 0; i < graph.arcs.size(); ++i) {
        if (graph.arcs[i].phone == kPause) continue;
        check(ps_add_word(decoder, word_of(i).c_str(), sphinx_name(graph.arcs[i].phone).c_str(), 0) >= 0,
              "adding the phone " + sphinx_name(graph.arcs[i].phone));
    }
    const Handle<fsg_model_t> grammar(fsg_model_init("phones", ps_get_logmath(decoder), 1, graph.states));
    grammar->start_state = 0;
    grammar->final_state = graph.states - 1;
    for (std::size_t i = 0; i < graph.arcs.size(); ++i) {
        const auto& [from, to, phone] = graph.arcs[i];
        const std::string word = phone == kPause ? kSilence : word_of(i);
        fsg_model_trans_add(grammar.get(), from, to, 0, fsg_model_word_add(grammar.get(), word.c_str()));
    }
    for (const auto& [from, to] : graph.skips) fsg_model_null_trans_add(grammar.get(), from, to, 0);
    check(ps_set_fsg(decoder, "phones", grammar.get()) == 0, "setting the grammar");
    check(ps_set_search(decoder, "phones") == 0, "choosing the grammar");
}

std::vector<std::int16_t> with_a_bit_of_noise(std::span<const std::int16_t> sound) {
    std::vector<std::int16_t> noisy(sound.begin(), sound.end());
    for (std::size_t i = 0; i < noisy.size(); ++i) {
        const std::uint64_t place = i;
        const std::span bytes(reinterpret_cast<const std::uint8_t*>(&place), sizeof place);
        if (noisy[i] < 32767) noisy[i] = static_cast<std::int16_t>(noisy[i] + (fnv1a(bytes) >> 40 & 1));
    }
    return noisy;
}

std::vector<HeardPhone> path_of(ps_decoder_t* decoder, const PhoneGraph& graph) {
    std::vector<HeardPhone> path;
    for (ps_seg_t* segment = ps_seg_iter(decoder); segment; segment = ps_seg_next(segment)) {
        const std::string_view word = ps_seg_word(segment);
        HeardPhone heard;
        if (word.starts_with("arc")) {
            std::from_chars(word.data() + 3, word.data() + word.size(), heard.arc);
            heard.phone = graph.arcs.at(static_cast<std::size_t>(heard.arc)).phone;
        } else if (word != kSilence) {
            continue;  // a skip
        }
        int last = 0, language = 0, backoff = 0, acoustic = 0;
        ps_seg_frames(segment, &heard.first_frame, &last);
        ps_seg_prob(segment, &acoustic, &language, &backoff);
        heard.frames = last + 1 - heard.first_frame;
        heard.score = kScoreScale * logmath_log_to_ln(ps_get_logmath(decoder), acoustic);
        path.push_back(heard);
    }
    return path;
}

// A path that the sound was too short for ends elsewhere.
bool is_whole(const std::vector<HeardPhone>& path, const PhoneGraph& graph) {
    if (path.empty()) return false;
    int state = 0;
    for (const HeardPhone& heard : path) {
        if (heard.arc >= 0) state = graph.arcs[static_cast<std::size_t>(heard.arc)].to;
    }
    const auto leads_to_end = [&](int from, int to) { return from == state && to == graph.states - 1; };
    return state == graph.states - 1 ||
           std::any_of(graph.arcs.begin(), graph.arcs.end(),
                       [&](auto& a) { return a.phone == kPause && leads_to_end(a.from, a.to); }) ||
           std::any_of(graph.skips.begin(), graph.skips.end(),
                       [&](auto& s) { return leads_to_end(s.first, s.second); });
}

}  // namespace

std::vector<HeardPhone> likeliest_path(std::span<const std::int16_t> sound, const PhoneGraph& graph) {
    const auto decoder = new_decoder(graph.beam);
    set_grammar(decoder.get(), graph);
    const auto noisy = with_a_bit_of_noise(sound);
    check(ps_start_utt(decoder.get()) == 0, "beginning");
    check(ps_process_raw(decoder.get(), noisy.data(), noisy.size(), 0, 1) >= 0, "listening");
    check(ps_end_utt(decoder.get()) == 0, "ending");
    auto path = path_of(decoder.get(), graph);
    if (!is_whole(path, graph)) path.clear();
    return path;
}

PhoneGraph any_phones() {
    PhoneGraph graph{2, {}, {{0, 1}}, kUsualBeam};
    for (std::size_t phone = 0; phone < phone_table().size(); ++phone) {
        if (phone_table()[phone].name != "ax") graph.arcs.push_back({0, 0, static_cast<PhoneId>(phone)});
    }
    return graph;
}

}  // namespace viaface

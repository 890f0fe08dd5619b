#include "synth/speech/flite_voice.hpp"

#include <algorithm>
#include <array>
#include <mutex>

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "synth/speech/c_locale.hpp"
#include "synth/speech/flite_phones.hpp"
#include "synth/speech/flite_utterance.hpp"
#include "synth/speech/phone_timing.hpp"
#include "synth/speech/repeatable_noise.hpp"
#include "synth/speech/spoken_phones.hpp"

extern "C" {
cst_voice* register_cmu_us_rms(const char* folder);
cst_voice* register_cmu_us_slt(const char* folder);
cst_voice* register_cmu_us_awb(const char* folder);
cst_voice* register_cmu_us_kal16(const char* folder);
}

namespace viaface {
namespace {

struct KnownVoice {
    std::string_view name;
    cst_voice* (*open)(const char* folder);
};

constexpr std::array<KnownVoice, 4> kVoices = {{{"rms", register_cmu_us_rms},
                                                {"slt", register_cmu_us_slt},
                                                {"awb", register_cmu_us_awb},
                                                {"kal16", register_cmu_us_kal16}}};

// One thread's turn in Flite.
class Turn {
    static std::mutex& one_at_a_time() {
        static std::mutex mutex;
        return mutex;
    }
    std::lock_guard<std::mutex> lock_{one_at_a_time()};
    CLocale plain_numbers_;
};

}  // namespace

std::vector<std::string> FliteVoice::names() {
    std::vector<std::string> names;
    for (const KnownVoice& voice : kVoices) names.emplace_back(voice.name);
    return names;
}

FliteVoice::FliteVoice(std::string_view name) : name_(name) {
    const auto known =
        std::find_if(kVoices.begin(), kVoices.end(), [&](const auto& v) { return v.name == name; });
    if (known == kVoices.end()) throw InputError("voice", name_, "rms, slt, awb, kal16");
    const Turn turn;
    flite_init();
    voice_ = known->open(nullptr);
}

Utterance FliteVoice::speak(const std::string& sentence, const Prosody& prosody) const {
    check_prosody(prosody);
    const Turn turn;
    seed_noise(fnv1a({reinterpret_cast<const std::uint8_t*>(sentence.data()), sentence.size()}));
    const FliteUtterance utterance = new_utterance_of(voice_, prosody, sentence.c_str());
    run(utterance.get(), utt_synth);
    Utterance said = read_off(utterance.get());
    if (said.words.empty()) throw InputError("text", sentence, "text with words that can be spoken");
    said = with_edges(std::move(said));
    check_utterance(said);
    return said;
}

Utterance FliteVoice::speak_phones(std::span<const RequestedPhone> phones, const Prosody& prosody) const {
    check_prosody(prosody);
    const Turn turn;
    seed_noise(0);
    const FliteUtterance utterance = spoken_by_flite(voice_, phones, prosody);
    const Utterance said = with_pauses_asked_for(with_edges(read_off(utterance.get())), phones);
    check_utterance(said);
    return said;
}

}  // namespace viaface

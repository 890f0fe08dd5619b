#include "synth/speech/flite_voice.hpp"

#include <flite/flite.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <mutex>

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "synth/speech/c_locale.hpp"
#include "synth/speech/phone_timing.hpp"
#include "synth/speech/repeatable_noise.hpp"
#include "synth/speech/spoken_phones.hpp"

extern "C" {
#include <flite/cst_cg.h>

cst_voice* register_cmu_us_rms(const char* folder);
cst_voice* register_cmu_us_slt(const char* folder);
cst_voice* register_cmu_us_awb(const char* folder);
cst_voice* register_cmu_us_kal16(const char* folder);
cst_wave* __real_mlsa_resynthesis(const cst_track*, const cst_track*, cst_cg_db*, cst_audio_streaming_info*,
                                  int);
}

namespace {

// What the vocoder of the statistical voices does in this thread's turn.
struct Vocoder {
    float pitch = 1;
    bool mute = false;  // phones are timed without making their sound
};
thread_local Vocoder vocoder;

}  // namespace

// Flite's own f0_shift moves the mean of F0 and leaves its range (slt, awb) or does nothing (rms). So
// programs are linked with --wrap=mlsa_resynthesis: here channel 0 of the track (F0 in Hz, 0 where unvoiced)
// is scaled as a whole.
extern "C" cst_wave* __wrap_mlsa_resynthesis(const cst_track* track, const cst_track* strengths,
                                             cst_cg_db* voice, cst_audio_streaming_info* streaming,
                                             int speed) {
    if (vocoder.mute) return nullptr;  // Flite goes on with an empty wave
    for (int i = 0; i < track->num_frames; ++i) track->frames[i][0] *= vocoder.pitch;
    return __real_mlsa_resynthesis(track, strengths, voice, streaming, speed);
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

struct Delete {
    void operator()(cst_utterance* utterance) const { delete_utterance(utterance); }
    void operator()(cst_val* value) const { delete_val(value); }
};
using FliteUtterance = std::unique_ptr<cst_utterance, Delete>;
using FliteValue = std::unique_ptr<cst_val, Delete>;

// A step of Flite, whose errors would leave the program if they had nowhere to jump to.
void run(cst_utterance* utterance, cst_uttfunc step) {
    jmp_buf here;
    cst_errjmp = &here;
    const bool done = setjmp(here) == 0 && step && step(utterance);
    cst_errjmp = nullptr;
    if (!done) throw std::runtime_error("Flite failed to speak");
}

// The step that the voice names, or else Flite's own.
void run(cst_utterance* utterance, const char* hook, cst_uttfunc otherwise) {
    const cst_val* step = feat_val(utterance->features, hook);
    run(utterance, step ? val_uttfunc(step) : otherwise);
}

bool is_statistical(const cst_voice* voice) { return feat_present(voice->features, "cg_db"); }

// Prosody is set on the utterance, never on the voice that others share.
FliteUtterance new_utterance_of(cst_voice* voice, const Prosody& prosody, const char* text = nullptr) {
    FliteUtterance utterance(new_utterance());
    if (text) feat_set_string(utterance->features, "input_text", text);
    utt_init(utterance.get(), voice);
    feat_set_float(utterance->features, "duration_stretch", static_cast<float>(1 / prosody.rate));
    vocoder = {static_cast<float>(prosody.pitch), false};
    if (!is_statistical(voice)) feat_set_float(utterance->features, "f0_shift", vocoder.pitch);
    return utterance;
}

const cst_item* segments_of(const cst_utterance* utterance) {
    return relation_head(utt_relation(utterance, "Segment"));
}

double end_of(const cst_item* segment) {
    const cst_val* end = item_feat(segment, "end");
    if (!end || CST_VAL_TYPE(end) != CST_VAL_TYPE_FLOAT)
        throw std::runtime_error("Flite gave a phone no time");
    return val_float(end);
}

std::string text_feature(const cst_item* item, const char* name) {
    const cst_val* value = item_feat_present(item, name) ? item_feat(item, name) : nullptr;
    return value && val_stringp(value) ? val_string(value) : "";
}

// ---- what Flite said, read off ----

const cst_item* syllable_of(const cst_item* segment) {
    const cst_item* place = item_as(segment, "SylStructure");
    return place ? item_parent(place) : nullptr;
}

std::vector<SpokenPhone> spoken_phones(const cst_utterance* utterance) {
    std::vector<SpokenPhone> spoken;
    const cst_item* word = nullptr;
    for (const cst_item* segment = segments_of(utterance); segment; segment = item_next(segment)) {
        SpokenPhone phone;
        phone.name = text_feature(segment, "name");
        phone.end_s = end_of(segment);
        if (const cst_item* syllable = syllable_of(segment)) {
            phone.in_word = true;
            phone.stress = text_feature(syllable, "stress");
            const cst_item* owner = item_parent(syllable);
            if (owner && owner != word) phone.word = text_feature(owner, "name");
            if (owner) word = owner;
        }
        spoken.push_back(std::move(phone));
    }
    return spoken;
}

Waveform sound_of(cst_utterance* utterance) {
    if (!feat_present(utterance->features, "wave")) throw std::runtime_error("Flite made no sound");
    const cst_wave* wave = utt_wave(utterance);
    return {wave->sample_rate, {wave->samples, wave->samples + wave->num_samples}};
}

Utterance read_off(cst_utterance* utterance) {
    return utterance_of(spoken_phones(utterance), sound_of(utterance));
}

// ---- phones with durations ----

cst_item* append_word(cst_utterance* utterance, const std::string& text) {
    cst_item* token = relation_append(utt_relation(utterance, "Token"), nullptr);
    item_set_string(token, "name", text.c_str());
    item_set_string(token, "punc", ",");
    item_set_string(token, "prepunctuation", "");
    item_set_string(token, "whitespace", " ");
    cst_item* word = item_add_daughter(token, nullptr);
    item_set_string(word, "name", text.c_str());
    item_set_string(word, "gpos", "content");
    relation_append(utt_relation(utterance, "Word"), word);
    cst_item* phrase = relation_append(utt_relation(utterance, "Phrase"), nullptr);
    item_set_string(phrase, "name", "BB");
    item_add_daughter(phrase, word);
    return relation_append(utt_relation(utterance, "SylStructure"), word);
}

cst_item* append_syllable(cst_utterance* utterance, cst_item* word) {
    cst_item* syllable = relation_append(utt_relation(utterance, "Syllable"), nullptr);
    item_set_string(syllable, "stress", "0");
    return item_add_daughter(word, syllable);
}

constexpr const char* kIndex = "requested_phone";

// The relations that Flite's text analysis would have made.
void lay_out(cst_utterance* utterance, std::span<const RequestedPhone> phones) {
    for (const char* name : {"Token", "Word", "Phrase", "Syllable", "SylStructure", "Segment"}) {
        utt_relation_create(utterance, name);
    }
    cst_item* word = nullptr;
    cst_item* syllable = nullptr;
    for (std::size_t i = 0; i < phones.size(); ++i) {
        cst_item* segment = relation_append(utt_relation(utterance, "Segment"), nullptr);
        item_set_string(segment, "name", std::string(phone_info(phones[i].phone).name).c_str());
        item_set_int(segment, kIndex, static_cast<int>(i));
        if (phones[i].phone == kPause) continue;
        if (begins_word(phones, i)) word = append_word(utterance, spelt_word(phones, i));
        if (begins_syllable(phones, i)) syllable = append_syllable(utterance, word);
        if (phones[i].stress > 0) item_set_string(syllable, "stress", phones[i].stress == 1 ? "1" : "2");
        item_add_daughter(syllable, segment);
    }
}

// The statistical voices ask their token for a stretch once for each state, in order, and give a state its
// end after that: the state that asks is the first without one.
struct Stretches {
    std::vector<FliteValue> of_phone;
    const cst_item* state = nullptr;
};
thread_local Stretches* stretches = nullptr;

const cst_val* stretch_of_asking_state(const cst_item* token) {
    const cst_item*& state = stretches->state;
    if (!state) state = relation_head(utt_relation(item_utt(token), "HMMstate"));
    while (item_next(state) && item_feat_present(state, "end")) state = item_next(state);
    const cst_item* segment = item_parent(item_as(state, "segstate"));
    return stretches->of_phone[static_cast<std::size_t>(item_feat_int(segment, kIndex))].get();
}

FliteUtterance speak_stretched(cst_voice* voice, std::span<const RequestedPhone> phones,
                               const Prosody& prosody, std::span<const double> factors, bool mute) {
    FliteUtterance utterance = new_utterance_of(voice, prosody);
    lay_out(utterance.get(), phones);
    Stretches own;
    for (const double factor : factors) own.of_phone.emplace_back(float_val(static_cast<float>(factor)));
    stretches = &own;
    vocoder.mute = mute;
    ff_register(utterance->ffunctions, "local_duration_stretch", stretch_of_asking_state);
    run(utterance.get(), "intonation_func", cart_intonation);
    run(utterance.get(), "wave_synth_func", nullptr);
    return utterance;
}

std::vector<double> ends_of(const cst_utterance* utterance) {
    std::vector<double> ends;  // s
    for (const cst_item* segment = segments_of(utterance); segment; segment = item_next(segment)) {
        ends.push_back(end_of(segment));
    }
    return ends;
}

std::vector<double> durations_of(const cst_utterance* utterance) {
    std::vector<double> durations;  // ms
    double begin = 0;
    for (const double end : ends_of(utterance)) {
        durations.push_back(1000 * (end - begin));
        begin = end;
    }
    return durations;
}

// No state gets shorter than a frame, so that a stretch does less than it says.
FliteUtterance speak_by_stretching(cst_voice* voice, std::span<const RequestedPhone> phones,
                                   const Prosody& prosody) {
    const auto factors = stretches_for(phones, [&](std::span<const double> factors) {
        return durations_of(speak_stretched(voice, phones, prosody, factors, true).get());
    });
    return speak_stretched(voice, phones, prosody, factors, false);
}

void set_durations(cst_utterance* utterance, std::span<const RequestedPhone> phones) {
    const auto ends = ends_asked_for(ends_of(utterance), phones);
    auto end = ends.begin();
    for (cst_item* segment = relation_head(utt_relation(utterance, "Segment")); segment;
         segment = item_next(segment)) {
        item_set_float(segment, "end", static_cast<float>(*end++));
    }
}

FliteUtterance speak_by_units(cst_voice* voice, std::span<const RequestedPhone> phones,
                              const Prosody& prosody) {
    FliteUtterance utterance = new_utterance_of(voice, prosody);
    lay_out(utterance.get(), phones);
    run(utterance.get(), "intonation_func", cart_intonation);
    run(utterance.get(), "duration_model_func", cart_duration);
    set_durations(utterance.get(), phones);
    run(utterance.get(), "f0_model_func", nullptr);
    run(utterance.get(), "wave_synth_func", nullptr);
    return utterance;
}

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
    const FliteUtterance utterance = is_statistical(voice_) ? speak_by_stretching(voice_, phones, prosody)
                                                            : speak_by_units(voice_, phones, prosody);
    const Utterance said = with_pauses_asked_for(with_edges(read_off(utterance.get())), phones);
    check_utterance(said);
    return said;
}

}  // namespace viaface

#include "synth/speech/flite_voice.hpp"

#include <flite/flite.h>
#include <locale.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <mutex>

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "synth/speech/repeatable_noise.hpp"

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

// One thread's turn in Flite: numbers are read and printed as in C, whatever the program's locale is.
class Turn {
  public:
    Turn() : lock_(one_at_a_time()), plain_(newlocale(LC_ALL_MASK, "C", nullptr)), own_(uselocale(plain_)) {}
    ~Turn() {
        uselocale(own_);
        freelocale(plain_);
    }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

  private:
    static std::mutex& one_at_a_time() {
        static std::mutex mutex;
        return mutex;
    }
    std::lock_guard<std::mutex> lock_;
    locale_t plain_, own_;
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

void append_phone(Utterance& said, const cst_item* segment, std::int64_t end) {
    auto& phones = said.phones.phones;
    const std::int64_t begin = phones.empty() ? 0 : phones.back().end;
    const PhoneId phone = parse_phone(text_feature(segment, "name")).phone;
    const cst_item* syllable = phone == kPause ? nullptr : item_parent(item_as(segment, "SylStructure"));
    if (!syllable && !phones.empty() && phones.back().phone == kPause) {
        phones.back().end = end;
        return;
    }
    const std::string stress = syllable ? text_feature(syllable, "stress") : "";
    const int level = phone_info(phone).vowel && (stress == "1" || stress == "2") ? stress[0] - '0' : 0;
    phones.push_back({phone, level, begin, end});
    said.word_of_phone.push_back(syllable ? static_cast<int>(said.words.size()) - 1 : -1);
    if (syllable) said.words.back().end = end;
}

void append_word_when_new(Utterance& said, const cst_item* segment, const cst_item*& word) {
    const cst_item* place = item_as(segment, "SylStructure");
    const cst_item* owner = place && item_parent(place) ? item_parent(item_parent(place)) : nullptr;
    if (!owner || owner == word) return;
    word = owner;
    const std::int64_t begin = said.phones.phones.empty() ? 0 : said.phones.phones.back().end;
    said.words.push_back({text_feature(owner, "name"), begin, begin});
}

Waveform sound_of(cst_utterance* utterance) {
    if (!feat_present(utterance->features, "wave")) throw std::runtime_error("Flite made no sound");
    const cst_wave* wave = utt_wave(utterance);
    return {wave->sample_rate, {wave->samples, wave->samples + wave->num_samples}};
}

// Waves end some ms before the last phone does, or in the middle of the last pause: the phones decide.
Utterance read_off(cst_utterance* utterance) {
    Utterance said;
    said.sound = sound_of(utterance);
    said.phones.sample_rate = said.sound.sample_rate;
    const cst_item* word = nullptr;
    for (const cst_item* segment = segments_of(utterance); segment; segment = item_next(segment)) {
        append_word_when_new(said, segment, word);
        append_phone(said, segment, std::llround(end_of(segment) * said.sound.sample_rate));
    }
    if (said.phones.phones.empty()) throw std::runtime_error("Flite spoke no phones");
    said.sound.samples.resize(static_cast<std::size_t>(said.phones.phones.back().end), 0);
    return said;
}

Utterance with_edges(Utterance said) {
    const double rate = said.sound.sample_rate;
    said = with_pause_length(std::move(said), 0, std::llround(kLeadIn * rate));
    return with_pause_length(std::move(said), said.phones.phones.size() - 1, std::llround(kLeadOut * rate));
}

// ---- phones with durations ----

// Consonants go with the vowel after them; those after the last vowel of a word close it.
bool begins_syllable(std::span<const RequestedPhone> phones, std::size_t i) {
    if (i == 0 || phones[i - 1].phone == kPause) return true;
    const auto pause =
        std::find_if(phones.begin() + i, phones.end(), [](const auto& p) { return p.phone == kPause; });
    const bool vowel_ahead =
        std::any_of(phones.begin() + i, pause, [](const auto& p) { return phone_info(p.phone).vowel; });
    return vowel_ahead && phone_info(phones[i - 1].phone).vowel;
}

std::string spelt(std::span<const RequestedPhone> phones, std::size_t first) {
    std::string word;
    for (std::size_t i = first; i < phones.size() && phones[i].phone != kPause; ++i) {
        word += (word.empty() ? "" : "-") + std::string(phone_info(phones[i].phone).name);
    }
    return word;
}

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
        if (i == 0 || phones[i - 1].phone == kPause) word = append_word(utterance, spelt(phones, i));
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

double worst_error(std::span<const double> durations, std::span<const RequestedPhone> phones) {
    double worst = 0;
    for (std::size_t i = 0; i < phones.size(); ++i) {
        if (phones[i].phone != kPause && phones[i].duration) {
            worst = std::max(worst, std::abs(durations[i] - *phones[i].duration));
        }
    }
    return worst;
}

std::vector<double> durations_of(const cst_utterance* utterance) {
    std::vector<double> durations;  // ms
    double begin = 0;
    for (const cst_item* segment = segments_of(utterance); segment; segment = item_next(segment)) {
        durations.push_back(1000 * (end_of(segment) - begin));
        begin = end_of(segment);
    }
    return durations;
}

// No state gets shorter than a frame, so that a stretch does less than it says: it is corrected until it
// fits.
FliteUtterance speak_by_stretching(cst_voice* voice, std::span<const RequestedPhone> phones,
                                   const Prosody& prosody) {
    constexpr int kMostRounds = 60;
    constexpr double kCloseEnough = 0.5;  // ms
    std::vector<double> factors(phones.size(), 1);
    for (int round = 0; round < kMostRounds; ++round) {
        const auto durations = durations_of(speak_stretched(voice, phones, prosody, factors, true).get());
        if (worst_error(durations, phones) <= kCloseEnough) {
            return speak_stretched(voice, phones, prosody, factors, false);
        }
        for (std::size_t i = 0; i < phones.size(); ++i) {
            if (phones[i].duration) factors[i] *= *phones[i].duration / durations[i];
        }
    }
    throw std::runtime_error("Flite did not meet the durations of the phones");
}

void set_durations(cst_utterance* utterance, std::span<const RequestedPhone> phones) {
    double own_end = 0, end = 0;
    std::size_t i = 0;
    for (cst_item* segment = relation_head(utt_relation(utterance, "Segment")); segment;
         segment = item_next(segment)) {
        const double own = end_of(segment) - own_end;
        own_end += own;
        end += phones[i].duration && phones[i].phone != kPause ? *phones[i].duration / 1000 : own;
        item_set_float(segment, "end", static_cast<float>(end));
        ++i;
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

Utterance with_pauses_asked_for(Utterance said, std::span<const RequestedPhone> phones) {
    for (std::size_t i = 0; i < phones.size(); ++i) {
        if (phones[i].phone != kPause || !phones[i].duration) continue;
        said = with_pause_length(std::move(said), i,
                                 std::llround(*phones[i].duration * said.sound.sample_rate / 1000));
    }
    return said;
}

void check_factor(const char* field, double value) {
    if (!(value >= kLeast && value <= kMost)) throw InputError(field, std::to_string(value), "0.5 to 2");
}

}  // namespace

void check_prosody(const Prosody& prosody) {
    check_factor("rate", prosody.rate);
    check_factor("pitch", prosody.pitch);
}

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
    const bool statistical = feat_present(voice_->features, "cg_db");
    const FliteUtterance utterance =
        statistical ? speak_by_stretching(voice_, phones, prosody) : speak_by_units(voice_, phones, prosody);
    Utterance said = with_edges(read_off(utterance.get()));
    said = with_pauses_asked_for(std::move(said), phones);
    check_utterance(said);
    return said;
}

}  // namespace viaface

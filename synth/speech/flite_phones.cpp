#include "synth/speech/flite_phones.hpp"

#include <string>
#include <vector>

#include "synth/speech/flite_vocoder.hpp"
#include "synth/speech/phone_timing.hpp"

namespace viaface {
namespace {

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
    vocoder().mute = mute;
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
    for (cst_item* segment = segments_of(utterance); segment; segment = item_next(segment)) {
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

FliteUtterance spoken_by_flite(cst_voice* voice, std::span<const RequestedPhone> phones,
                               const Prosody& prosody) {
    return is_statistical(voice) ? speak_by_stretching(voice, phones, prosody)
                                 : speak_by_units(voice, phones, prosody);
}

}  // namespace viaface

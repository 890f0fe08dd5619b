#include "synth/speech/flite_utterance.hpp"

#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "synth/speech/flite_diphones.hpp"
#include "synth/speech/flite_vocoder.hpp"
#include "synth/speech/spoken_phones.hpp"

extern "C" {
#include <flite/cst_diphone.h>
}

namespace {

thread_local std::string complaint;  // the first of a step

}  // namespace

// Flite would print it on stderr and go on; programs are linked with --wrap=cst_errmsg.
extern "C" int __wrap_cst_errmsg(const char* format, ...) {
    char line[200];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    if (complaint.empty()) complaint.assign(line, std::strcspn(line, "\n"));
    return 0;
}

namespace viaface {
namespace {

std::string text_feature(const cst_item* item, const char* name) {
    const cst_val* value = item_feat_present(item, name) ? item_feat(item, name) : nullptr;
    return value && val_stringp(value) ? val_string(value) : "";
}

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

}  // namespace

bool is_statistical(const cst_voice* voice) { return feat_present(voice->features, "cg_db"); }

FliteUtterance new_utterance_of(cst_voice* voice, const Prosody& prosody, const char* text) {
    FliteUtterance utterance(new_utterance());
    if (text) feat_set_string(utterance->features, "input_text", text);
    utt_init(utterance.get(), voice);
    feat_set_float(utterance->features, "duration_stretch", static_cast<float>(1 / prosody.rate));
    vocoder() = {static_cast<float>(prosody.pitch), false};
    if (!is_statistical(voice)) {
        feat_set_float(utterance->features, "f0_shift", vocoder().pitch);
        feat_set(utterance->features, "diphone_db", diphone_db_val(&whole_diphones()));
    }
    return utterance;
}

void run(cst_utterance* utterance, cst_uttfunc step) {
    complaint.clear();
    jmp_buf here;
    cst_errjmp = &here;
    const bool done = setjmp(here) == 0 && step && step(utterance);
    cst_errjmp = nullptr;
    if (!done || !complaint.empty()) throw std::runtime_error("Flite failed to speak: " + complaint);
}

void run(cst_utterance* utterance, const char* hook, cst_uttfunc otherwise) {
    const cst_val* step = feat_val(utterance->features, hook);
    run(utterance, step ? val_uttfunc(step) : otherwise);
}

cst_item* segments_of(const cst_utterance* utterance) {
    return relation_head(utt_relation(utterance, "Segment"));
}

double end_of(const cst_item* segment) {
    const cst_val* end = item_feat(segment, "end");
    if (!end || CST_VAL_TYPE(end) != CST_VAL_TYPE_FLOAT)
        throw std::runtime_error("Flite gave a phone no time");
    return val_float(end);
}

Utterance read_off(cst_utterance* utterance) {
    return utterance_of(spoken_phones(utterance), sound_of(utterance));
}

}  // namespace viaface

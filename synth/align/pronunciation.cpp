#include "synth/align/pronunciation.hpp"

#include "synth/speech/flite_voice.hpp"
#include "synth/speech/phone_timing.hpp"
#include "synth/speech/text.hpp"

namespace viaface {
namespace {

constexpr const char* kQuickVoice = "kal16";

void append(Pronunciation& all, const Utterance& said) {
    const int first_word = static_cast<int>(all.words.size());
    for (const Word& word : said.words) all.words.push_back(word.text);
    for (std::size_t i = 0; i < said.phones.phones.size(); ++i) {
        if (said.word_of_phone[i] < 0) continue;
        all.phones.push_back({said.phones.phones[i].phone, said.phones.phones[i].stress});
        all.word_of_phone.push_back(first_word + said.word_of_phone[i]);
    }
}

}  // namespace

Pronunciation pronounced(std::string_view transcript) {
    const FliteVoice voice(kQuickVoice);
    Pronunciation all;
    for (const std::string& sentence : sentences(transcript)) append(all, voice.speak(sentence));
    return all;
}

Pronunciation pronounced_phones(std::string_view text) {
    const std::vector<RequestedPhone> phones = parse_phones(text);
    Pronunciation all;
    for (std::size_t i = 0; i < phones.size(); ++i) {
        if (phones[i].phone == kPause) continue;
        if (begins_word(phones, i)) all.words.push_back(spelt_word(phones, i));
        all.phones.push_back({phones[i].phone, phones[i].stress});
        all.word_of_phone.push_back(static_cast<int>(all.words.size()) - 1);
    }
    return all;
}

}  // namespace viaface

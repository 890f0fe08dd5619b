#include "synth/speech/spoken_phones.hpp"

#include <cmath>
#include <stdexcept>

namespace viaface {
namespace {

void append(Utterance& said, const SpokenPhone& spoken, std::int64_t end) {
    auto& phones = said.phones.phones;
    const std::int64_t begin = phones.empty() ? 0 : phones.back().end;
    if (spoken.word) said.words.push_back({*spoken.word, begin, begin});
    const PhoneId phone = parse_phone(spoken.name).phone;
    const bool in_word = phone != kPause && spoken.in_word;
    if (!in_word && !phones.empty() && phones.back().phone == kPause) {
        phones.back().end = end;
        return;
    }
    const bool stressed =
        in_word && phone_info(phone).vowel && (spoken.stress == "1" || spoken.stress == "2");
    phones.push_back({phone, stressed ? spoken.stress[0] - '0' : 0, begin, end});
    said.word_of_phone.push_back(in_word ? static_cast<int>(said.words.size()) - 1 : -1);
    if (in_word) said.words.back().end = end;
}

}  // namespace

Utterance utterance_of(std::span<const SpokenPhone> spoken, Waveform sound) {
    Utterance said;
    said.sound = std::move(sound);
    said.phones.sample_rate = said.sound.sample_rate;
    for (const SpokenPhone& phone : spoken) {
        append(said, phone, std::llround(phone.end_s * said.sound.sample_rate));
    }
    if (said.phones.phones.empty()) throw std::runtime_error("no phones were spoken");
    said.sound.samples.resize(static_cast<std::size_t>(said.phones.phones.back().end), 0);
    return said;
}

Utterance with_edges(Utterance said) {
    const double rate = said.sound.sample_rate;
    said = with_pause_length(std::move(said), 0, std::llround(kLeadIn * rate));
    const std::size_t last = said.phones.phones.size() - 1;
    return with_pause_length(std::move(said), last, std::llround(kLeadOut * rate));
}

}  // namespace viaface

// English speech by Flite 2.2 (Debian's flite1-dev, linked statically): a sentence, or phones with exact
// durations, becomes an Utterance. Equal requests give equal bytes, in any thread and whatever was spoken
// before.
//
// rms, slt and awb are statistical voices [Black06]: their sound moves in frames of 5 ms, and asked-for
// durations are met by stretching each phone's states until the phones are within 1 ms. kal16 joins diphones
// [Black00], made complete in flite_diphones.hpp, and meets durations to the sample.
//
// Threads: Flite counts references without locks, so one lock lets one utterance at a time through the whole
// of it (at 0.01 to 0.02 of real time, so that one core speaks for some 50 films). Any thread may use any
// voice.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "synth/speech/prosody.hpp"
#include "synth/speech/requested_phones.hpp"
#include "synth/speech/utterance.hpp"

struct cst_voice_struct;

namespace viaface {

inline constexpr std::string_view kDefaultVoice = "rms";

class FliteVoice {
  public:
    // InputError("voice", name, ...) for a name that names() lacks.
    explicit FliteVoice(std::string_view name = kDefaultVoice);

    static std::vector<std::string> names();
    const std::string& name() const { return name_; }

    // One sentence of sentences() in text.hpp, which keeps away what Flite cannot bear.
    // InputError("text", ...) when nothing in it can be spoken.
    Utterance speak(const std::string& sentence, const Prosody& prosody = {}) const;

    // Phones of parse_phones(). Durations asked for hold whatever the rate; each run between pauses is a
    // word.
    Utterance speak_phones(std::span<const RequestedPhone> phones, const Prosody& prosody = {}) const;

  private:
    std::string name_;
    cst_voice_struct* voice_;  // Flite's own, alive until the program ends
};

}  // namespace viaface

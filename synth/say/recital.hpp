// The way through from text to motion, one sentence at a time: sentence -> Utterance -> units of the codex ->
// via points -> minimum-jerk spline. Times inside a recital count from its own first sample.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "synth/speech/flite_voice.hpp"
#include "viapoints/codex_select.hpp"
#include "viapoints/spline.hpp"

namespace viaface {

// What is said and who is heard. Exactly one of text, phones and recorded is given.
struct SpeechRequest {
    std::string text;  // English; see synth/speech/text.hpp for its limits
    std::string
        phones;  // "ax b:90 aa1:220"; see synth/speech/requested_phones.hpp; at most kLongestText bytes
    std::shared_ptr<const Utterance> recorded;  // spoken by a person; voice and prosody are without effect
    std::string voice = std::string(kDefaultVoice);
    Prosody prosody;
};

// The request checked, and cut into what is spoken at a time. Const and thread-safe after construction.
class Script {
  public:
    explicit Script(SpeechRequest request);  // InputError naming the field

    std::size_t size() const { return sentences_.empty() ? 1 : sentences_.size(); }
    Utterance utterance(std::size_t sentence) const;

  private:
    SpeechRequest request_;
    FliteVoice voice_;
    std::vector<std::string> sentences_;  // empty when phones or a recording are given
    std::vector<RequestedPhone> phones_;
};

struct Recital {
    Utterance utterance;
    Selection selection;
    ViaPointTrack track;  // [via points x 114], mm, head frame
    MinimumJerkSpline motion;
};

// Of the utterance only its phones matter.
Recital recite(const Codex& codex, Utterance utterance);

}  // namespace viaface

#include "synth/say/recital.hpp"

#include "base/error.hpp"
#include "synth/speech/text.hpp"
#include "viapoints/codex_speak.hpp"

namespace viaface {

Script::Script(SpeechRequest request) : request_(std::move(request)), voice_(request_.voice) {
    check_prosody(request_.prosody);
    if (request_.text.empty() + request_.phones.empty() + !request_.recorded != 2) {
        throw InputError(request_.phones.empty() ? "text" : "phones", request_.phones,
                         "one of text and phones, not empty");
    }
    if (request_.phones.size() > kLongestText) {
        throw InputError("phones", std::to_string(request_.phones.size()) + " bytes",
                         "at most " + std::to_string(kLongestText) + " bytes");
    }
    if (request_.recorded) {
        check_utterance(*request_.recorded);
    } else if (request_.phones.empty()) {
        sentences_ = sentences(request_.text);
    } else {
        phones_ = parse_phones(request_.phones);
    }
}

Utterance Script::utterance(std::size_t sentence) const {
    if (request_.recorded) return *request_.recorded;
    if (!phones_.empty()) return voice_.speak_phones(phones_, request_.prosody);
    return voice_.speak(sentences_.at(sentence), request_.prosody);
}

Recital recite(const Codex& codex, Utterance utterance) {
    Selection selection = select_units(codex, utterance.phones);
    ViaPointTrack track = speak(codex, utterance.phones, selection);
    track.points = to_points(codex.basis, track.points);
    MinimumJerkSpline motion(track, SplineEnd::at_rest(), SplineEnd::at_rest());
    return {std::move(utterance), std::move(selection), std::move(track), std::move(motion)};
}

}  // namespace viaface

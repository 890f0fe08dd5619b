#include "synth/align/align.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.hpp"
#include "synth/align/phone_decoder.hpp"

namespace viaface {
namespace {

constexpr int kFewestFrames = 3;                       // of a phone: one for each state of its model
constexpr double kEvenLoss = 0.7, kLossSteepness = 3;  // nats a frame; 1 / nats

// Phones in a chain; before every word and after the last, a pause or nothing.
struct Chain {
    PhoneGraph graph{1, {}, {}};
    std::vector<int> phone_of_arc;  // [arcs], -1 for pauses

    void add(PhoneId phone, int index) {
        graph.arcs.push_back({graph.states - 1, graph.states, phone});
        phone_of_arc.push_back(index);
        ++graph.states;
    }
    void maybe_pause() {
        graph.skips.emplace_back(graph.states - 1, graph.states);
        add(kPause, -1);
    }
};

bool begins_word(const Pronunciation& said, std::size_t phone) {
    return phone == 0 || said.word_of_phone[phone] != said.word_of_phone[phone - 1];
}

Chain chain_of(const Pronunciation& said) {
    Chain chain;
    for (std::size_t i = 0; i < said.phones.size(); ++i) {
        if (begins_word(said, i)) chain.maybe_pause();
        chain.add(said.phones[i].phone, static_cast<int>(i));
    }
    chain.maybe_pause();
    return chain;
}

// The phones' own part of the path, one for each phone said.
std::vector<HeardPhone> heard_phones(const Recording& recording, const Pronunciation& said,
                                     const std::string& field) {
    const double seconds = recording.sound.seconds();
    const auto path = std::ssize(recording.at_16_khz) / kDecoderStep < kFewestFrames * std::ssize(said.phones)
                          ? std::vector<HeardPhone>()
                          : likeliest_path(recording.at_16_khz, chain_of(said).graph);
    std::vector<HeardPhone> phones;
    std::copy_if(path.begin(), path.end(), std::back_inserter(phones), [](auto& h) { return h.arc >= 0; });
    if (phones.size() != said.phones.size()) {
        char value[80];
        std::snprintf(value, sizeof value, "%.2f s of sound for %zu phones", seconds, said.phones.size());
        throw InputError(field, value, "a recording that says the transcript, at least 30 ms a phone");
    }
    return phones;
}

// Puts phones after each other on the recording's clock, with pauses in the gaps.
class Labels {
  public:
    explicit Labels(const Waveform& sound) {
        said_.sound = sound;
        said_.phones.sample_rate = sound.sample_rate;
    }

    void add(const HeardPhone& heard, const StressedPhone& phone, int word, const std::string& text) {
        const std::int64_t begin = std::max<std::int64_t>(sample_of(heard.first_frame), kShortest);
        pause_until(begin);
        const std::int64_t end = std::min(sample_of(heard.first_frame + heard.frames), total() - kShortest);
        if (word == std::ssize(said_.words)) said_.words.push_back({text, begin, end});
        said_.words.back().end = end;
        append(phone, word, begin, end);
    }

    Utterance finish() {
        pause_until(total());
        check_utterance(said_);
        return std::move(said_);
    }

  private:
    static constexpr std::int64_t kShortest = 2;  // samples of the first and the last pause

    std::int64_t total() const { return std::ssize(said_.sound.samples); }
    std::int64_t sample_of(int frame) const {
        const std::int64_t rate = said_.sound.sample_rate;
        return ((std::int64_t{frame} * kDecoderStep + kDecoderDelay) * rate + kDecoderRate / 2) /
               kDecoderRate;
    }
    void pause_until(std::int64_t end) {
        const std::int64_t begin = said_.phones.phones.empty() ? 0 : said_.phones.phones.back().end;
        if (end > begin) append({kPause, 0}, -1, begin, end);
    }
    void append(const StressedPhone& phone, int word, std::int64_t begin, std::int64_t end) {
        said_.phones.phones.push_back({phone.phone, phone.stress, begin, end});
        said_.word_of_phone.push_back(word);
    }

    Utterance said_;
};

// ln P of a path over frames [begin, end), a phone's score spread evenly over its frames.
double score_in(const std::vector<HeardPhone>& path, int begin, int end) {
    double sum = 0;
    for (const HeardPhone& heard : path) {
        const int from = std::max(begin, heard.first_frame);
        const int common = std::min(end, heard.first_frame + heard.frames) - from;
        if (common > 0) sum += heard.score * common / heard.frames;
    }
    return sum;
}

void add_losses(Alignment& alignment, const std::vector<HeardPhone>& phones, const Pronunciation& said,
                const std::vector<HeardPhone>& any) {
    double sum = 0, frames = 0;
    for (std::size_t first = 0; first < phones.size();) {
        std::size_t last = first;
        double score = phones[first].score;
        while (last + 1 < phones.size() && !begins_word(said, last + 1)) score += phones[++last].score;
        const int begin = phones[first].first_frame, end = phones[last].first_frame + phones[last].frames;
        const double loss = score_in(any, begin, end) - score;
        alignment.loss.push_back(loss / (end - begin));
        sum += loss;
        frames += end - begin;
        first = last + 1;
    }
    alignment.mean_loss = sum / frames;
    alignment.confidence = 1 / (1 + std::exp(kLossSteepness * (alignment.mean_loss - kEvenLoss)));
}

}  // namespace

Alignment align_anyhow(const Recording& recording, const Pronunciation& said, const std::string& field) {
    const std::vector<HeardPhone> phones = heard_phones(recording, said, field);
    Labels labels(recording.sound);
    for (std::size_t i = 0; i < phones.size(); ++i) {
        const int word = said.word_of_phone[i];
        labels.add(phones[i], said.phones[i], word, said.words[static_cast<std::size_t>(word)]);
    }
    Alignment alignment;
    alignment.utterance = labels.finish();
    add_losses(alignment, phones, said, likeliest_path(recording.at_16_khz, any_phones()));
    return alignment;
}

Alignment align(const Recording& recording, const Pronunciation& said, const std::string& field) {
    Alignment alignment = align_anyhow(recording, said, field);
    if (!(alignment.confidence >= kLeastConfidence)) {
        char value[80], allowed[120];
        std::snprintf(value, sizeof value, "confidence %.2f", alignment.confidence);
        std::snprintf(allowed, sizeof allowed,
                      "the words that the recording says: a confidence of at least %.2f", kLeastConfidence);
        throw InputError(field, value, allowed);
    }
    return alignment;
}

}  // namespace viaface

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
constexpr double kUnsaidLoss = 12, kBreaths = 0.1;     // nats a frame for all of the speech; share of it
constexpr double kLoud = 0.03;                         // of the words' power: -15 dB

bool is_phone(const HeardPhone& heard) { return heard.arc >= 0; }

// Phones in a chain; before every word and after the last, a pause or nothing.
struct Chain {
    PhoneGraph graph{1, {}, {}};

    void add(PhoneId phone) {
        graph.arcs.push_back({graph.states - 1, graph.states, phone});
        ++graph.states;
    }
    void maybe_pause() {
        graph.skips.emplace_back(graph.states - 1, graph.states);
        add(kPause);
    }
};

bool begins_word(const Pronunciation& said, std::size_t phone) {
    return phone == 0 || said.word_of_phone[phone] != said.word_of_phone[phone - 1];
}

Chain chain_of(const Pronunciation& said) {
    Chain chain;
    for (std::size_t i = 0; i < said.phones.size(); ++i) {
        if (begins_word(said, i)) chain.maybe_pause();
        chain.add(said.phones[i].phone);
    }
    chain.maybe_pause();
    return chain;
}

// The likeliest path, pauses with it: one phone heard for each phone said.
std::vector<HeardPhone> heard_path(const Recording& recording, const Pronunciation& said,
                                   const std::string& field) {
    auto path = std::ssize(recording.at_16_khz) / kDecoderStep < kFewestFrames * std::ssize(said.phones)
                    ? std::vector<HeardPhone>()
                    : likeliest_path(recording.at_16_khz, chain_of(said).graph);
    if (std::count_if(path.begin(), path.end(), is_phone) != std::ssize(said.phones)) {
        char value[80];
        std::snprintf(value, sizeof value, "%.2f s of sound for %zu phones", recording.sound.seconds(),
                      said.phones.size());
        throw InputError(field, value, "a recording that says the transcript, at least 30 ms a phone");
    }
    return path;
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

struct Frame {
    double score = 0;  // ln P, a phone's own spread evenly over its frames
    bool is_phone = false;
};

std::vector<Frame> frames_of(const std::vector<HeardPhone>& path) {
    std::vector<Frame> frames;
    for (const HeardPhone& heard : path) {
        frames.resize(static_cast<std::size_t>(heard.first_frame));
        frames.insert(frames.end(), static_cast<std::size_t>(heard.frames),
                      {heard.score / heard.frames, is_phone(heard)});
    }
    return frames;
}

std::vector<double> powers_of(std::span<const std::int16_t> at_16_khz, std::size_t frames) {
    std::vector<double> powers(frames);
    for (std::size_t i = 0; i < frames; ++i) {
        const std::size_t begin = std::min(at_16_khz.size(), i * kDecoderStep + kDecoderDelay);
        for (const double s :
             at_16_khz.subspan(begin).first(std::min<std::size_t>(kDecoderStep, at_16_khz.size() - begin)))
            powers[i] += s * s;
    }
    return powers;
}

// What the transcript loses against any phones, over its words and over what any phones hear beside them.
struct Losses {
    std::vector<Frame> said, any;  // [frames]
    std::vector<double> power;     // [frames]
    double power_of_words = 0;     // of a mean frame

    Losses(std::span<const std::int16_t> at_16_khz, const std::vector<HeardPhone>& path)
        : said(frames_of(path)), any(frames_of(likeliest_path(at_16_khz, any_phones()))) {
        const std::size_t all = std::max(said.size(), any.size());
        said.resize(all);
        any.resize(all);
        power = powers_of(at_16_khz, all);
        double frames = 0;
        for (std::size_t i = 0; i < said.size(); ++i) {
            power_of_words += said[i].is_phone * power[i];
            frames += said[i].is_phone;
        }
        power_of_words /= frames;
    }

    double in(std::size_t begin, std::size_t end) const {
        double sum = 0;
        for (std::size_t i = begin; i < end; ++i) sum += any[i].score - said[i].score;
        return sum / static_cast<double>(end - begin);
    }
    // Any phones hear noise in a pause too, but not as loud as the words.
    bool is_unsaid(std::size_t i) const {
        return any[i].is_phone && !said[i].is_phone && power[i] > kLoud * power_of_words;
    }
    double in_speech() const {
        double sum = 0, frames = 0;
        for (std::size_t i = 0; i < said.size(); ++i) {
            if (!said[i].is_phone && !is_unsaid(i)) continue;
            sum += any[i].score - said[i].score;
            ++frames;
        }
        return sum / frames;
    }
    double unsaid() const {
        double speech = 0, unsaid = 0;
        for (std::size_t i = 0; i < any.size(); ++i) {
            speech += said[i].is_phone || is_unsaid(i);
            unsaid += is_unsaid(i);
        }
        return unsaid / speech;
    }
};

void add_losses(Alignment& alignment, const std::vector<HeardPhone>& phones, const Pronunciation& said,
                const Losses& losses) {
    for (std::size_t first = 0; first < phones.size();) {
        std::size_t last = first;
        while (last + 1 < phones.size() && !begins_word(said, last + 1)) ++last;
        alignment.loss.push_back(
            losses.in(static_cast<std::size_t>(phones[first].first_frame),
                      static_cast<std::size_t>(phones[last].first_frame + phones[last].frames)));
        first = last + 1;
    }
    alignment.mean_loss = losses.in_speech();
    alignment.unsaid = losses.unsaid();
    const double loss = alignment.mean_loss + kUnsaidLoss * std::max(0.0, alignment.unsaid - kBreaths);
    alignment.confidence = 1 / (1 + std::exp(kLossSteepness * (loss - kEvenLoss)));
}

}  // namespace

Alignment align_anyhow(const Recording& recording, const Pronunciation& said, const std::string& field) {
    const auto path = heard_path(recording, said, field);
    std::vector<HeardPhone> phones;
    std::copy_if(path.begin(), path.end(), std::back_inserter(phones), is_phone);
    Labels labels(recording.sound);
    for (std::size_t i = 0; i < phones.size(); ++i) {
        const int word = said.word_of_phone[i];
        labels.add(phones[i], said.phones[i], word, said.words[static_cast<std::size_t>(word)]);
    }
    Alignment alignment;
    alignment.utterance = labels.finish();
    add_losses(alignment, phones, said, Losses(recording.at_16_khz, path));
    return alignment;
}

Alignment align(const Recording& recording, const Pronunciation& said, const std::string& field) {
    Alignment alignment = align_anyhow(recording, said, field);
    if (!(alignment.confidence >= kLeastConfidence)) {
        char value[100], allowed[120];
        std::snprintf(value, sizeof value, "confidence %.2f, %.0f%% of the speech heard is outside its words",
                      alignment.confidence, 100 * alignment.unsaid);
        std::snprintf(allowed, sizeof allowed,
                      "the words that the recording says: a confidence of at least %.2f", kLeastConfidence);
        throw InputError(field, value, allowed);
    }
    return alignment;
}

}  // namespace viaface

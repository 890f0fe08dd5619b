#include "synth/training/learn.hpp"

#include "synth/speech/flite_voice.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr std::size_t kBasisEvery =
    16;  // recitation samples per sample of the basis's training, and of its check
constexpr const char* kProvenance =
    "Performed by a gestural model of speech (targets, dominances and time constants per phone) on a "
    "blend-shape head, "
    "timed by the Flite voice rms. Not measured on any person.";

RowMatrix stacked(const std::vector<Configuration>& configurations) {
    RowMatrix rows(std::ssize(configurations), kCoordinates);
    for (Index i = 0; i < rows.rows(); ++i)
        rows.row(i) = configurations[static_cast<std::size_t>(i)].transpose();
    return rows;
}

// Every sixteenth sample for the training and the ones halfway between for the check.
ConfigurationBasis basis_of(const Performer& performer, const std::vector<PhoneSequence>& corpus,
                            double error_mm) {
    std::vector<Configuration> training, held_out;
    std::size_t sample = 0;
    for (const PhoneSequence& phones : corpus) {
        const ChannelMotion motion = gesture(phones);
        for (Index k = 0; k < motion.channels.rows(); ++k, ++sample) {
            const std::size_t phase = sample % kBasisEvery;
            if (phase != 0 && phase != kBasisEvery / 2) continue;
            (phase == 0 ? training : held_out)
                .push_back(performer.configuration(motion.channels.row(k).transpose()));
        }
    }
    return choose_basis(stacked(training), stacked(held_out), error_mm);
}

}  // namespace

std::vector<PhoneSequence> timed_corpus(const std::vector<std::string>& sentences,
                                        const std::vector<std::string>& strings) {
    const FliteVoice voice;
    std::vector<PhoneSequence> corpus;
    for (const std::string& sentence : sentences) corpus.push_back(voice.speak(sentence).phones);
    for (const std::string& phones : strings)
        corpus.push_back(voice.speak_phones(parse_phones(phones)).phones);
    return corpus;
}

Codex learn_codex(const Performer& performer, const std::vector<PhoneSequence>& corpus,
                  const std::function<void(const std::string&)>& progress, const LearningOptions& options) {
    const auto perform = [&](std::size_t i) {
        return Take{"recitation " + std::to_string(i), corpus[i], performer.perform(corpus[i])};
    };
    LearntCodex learnt = learn_from_takes(basis_of(performer, corpus, options.basis_error_mm),
                                          performer.resting(), corpus.size(), perform, kProvenance, options);
    if (progress) progress(summary(learnt));
    return std::move(learnt.codex);
}

}  // namespace viaface

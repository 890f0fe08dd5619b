#include "synth/training/learn.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <set>
#include <thread>

#include "synth/speech/flite_voice.hpp"
#include "viapoints/analysis.hpp"
#include "viapoints/codex_cut.hpp"
#include "viapoints/codex_select.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr std::size_t kBasisEvery =
    16;  // recitation samples per sample of the basis's training, and of its check
constexpr double kShortestUnit = 0.014;  // Flite says some ax and d in three frames of 5 ms
constexpr const char* kProvenance =
    "Performed by a gestural model of speech (targets, dominances and time constants per phone) on a "
    "blend-shape head, "
    "timed by the Flite voice rms. Not measured on any person.";

// job(i) for every i, on all cores; results do not depend on which core does what.
void in_parallel(std::size_t count, const std::function<void(std::size_t)>& job) {
    const std::size_t workers = std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::exception_ptr> failures(workers);
    {
        std::vector<std::jthread> threads;
        for (std::size_t w = 0; w < workers; ++w) {
            threads.emplace_back([&, w] {
                try {
                    for (std::size_t i = w; i < count; i += workers) job(i);
                } catch (...) {
                    failures[w] = std::current_exception();
                }
            });
        }
    }
    for (const auto& failure : failures) {
        if (failure) std::rethrow_exception(failure);
    }
}

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

CutRecitation recite(const Performer& performer, const ConfigurationBasis& basis, const PhoneSequence& phones,
                     double error_mm) {
    const Motion motion = performer.perform(phones);
    CutLimits limits;
    limits.shortest_s = kShortestUnit;
    return cut_recitation(
        basis,
        {phones, motion.time_s, to_components(basis, motion.positions), analyse(motion, basis, {error_mm})},
        limits);
}

std::string summary(const std::vector<CutRecitation>& cuts, const ConfigurationBasis& basis) {
    std::size_t phones = 0, dropped = 0, via = 0;
    double farthest = 0, seconds = 0;
    for (const CutRecitation& cut : cuts) {
        phones += cut.recitation.size();
        dropped += cut.dropped.size();
        for (const RecitedPhone& phone : cut.recitation) via += phone.via.size();
        seconds += duration_of(cut.recitation);
        farthest = std::max(farthest, cut.farthest_mm);
    }
    std::array<char, 240> text;
    std::snprintf(text.data(), text.size(),
                  "%zu recitations, %.0f s: %zu phones (%zu left out), %td components, %zu via points "
                  "(%.1f per s), farthest from the motion %.2f mm",
                  cuts.size(), seconds, phones, dropped, basis.size(), via,
                  static_cast<double>(via) / seconds, farthest);
    return text.data();
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
    const ConfigurationBasis basis = basis_of(performer, corpus, options.basis_error_mm);
    std::vector<CutRecitation> cuts(corpus.size());
    in_parallel(corpus.size(), [&](std::size_t i) {
        cuts[i] = recite(performer, basis, corpus[i], options.motion_error_mm);
    });
    if (progress) progress(summary(cuts, basis));
    std::vector<Recitation> recitations;
    for (CutRecitation& cut : cuts) recitations.push_back(std::move(cut.recitation));
    const Eigen::VectorXd rest = to_components(basis, performer.rest().transpose()).row(0).transpose();
    return make_codex(basis, rest, std::move(recitations), kProvenance);
}

Coverage coverage_of(const Codex& codex) {
    std::set<PhoneId> phones;
    std::set<std::pair<PhoneId, PhoneId>> diphones;
    std::set<std::array<PhoneId, 3>> triphones;
    for (const TriphoneUnit& unit : codex.units) {
        phones.insert(unit.centre);
        diphones.insert({unit.left, unit.centre});
        diphones.insert({unit.centre, unit.right});
        triphones.insert({unit.left, unit.centre, unit.right});
    }
    diphones.erase({kPause, kPause});
    Coverage coverage{static_cast<int>(phones.size()),
                      static_cast<int>(diphones.size()),
                      static_cast<int>(triphones.size()),
                      {}};
    for (std::size_t a = 0; a < phone_table().size(); ++a) {
        for (std::size_t b = 0; b < phone_table().size(); ++b) {
            const std::pair pair{static_cast<PhoneId>(a), static_cast<PhoneId>(b)};
            if (pair == std::pair{kPause, kPause} || diphones.contains(pair)) continue;
            coverage.missing_diphones.push_back(std::string(phone_table()[a].name) + "-" +
                                                std::string(phone_table()[b].name));
        }
    }
    return coverage;
}

SpokenShares spoken_shares(const Codex& codex, const std::vector<PhoneSequence>& sequences) {
    std::array<double, 3> counts{};
    double slots = 0;
    for (const PhoneSequence& phones : sequences) {
        const Selection selection = select_units(codex, phones);
        for (std::size_t level = 0; level < 3; ++level) counts[level] += selection.phones_at_level[level];
        slots += static_cast<double>(selection.slots.size());
    }
    return {counts[0] / slots, counts[1] / slots, counts[2] / slots};
}

}  // namespace viaface

#include "synth/learn/codex_learning.hpp"

#include <algorithm>
#include <cstdio>
#include <set>

#include "base/error.hpp"
#include "synth/learn/parallel.hpp"
#include "viapoints/analysis.hpp"
#include "viapoints/codex_cut.hpp"
#include "viapoints/codex_select.hpp"

namespace viaface {
namespace {

CutRecitation cut(const ConfigurationBasis& basis, const Take& take, const LearningOptions& options) {
    CutLimits limits;
    limits.shortest_s = options.shortest_s;
    return cut_recitation(basis,
                          {take.phones, take.motion.time_s, to_components(basis, take.motion.positions),
                           analyse(take.motion, basis, {options.motion_error_mm})},
                          limits);
}

}  // namespace

LearntCodex learn_from_takes(ConfigurationBasis basis, const Configuration& rest, std::size_t takes,
                             const std::function<Take(std::size_t)>& take, std::string provenance,
                             const LearningOptions& options) {
    std::vector<CutRecitation> cuts(takes);
    std::vector<std::string> names(takes);
    in_parallel(takes, [&](std::size_t i) {
        const Take each = take(i);
        names[i] = each.name;
        try {
            cuts[i] = cut(basis, each, options);
        } catch (const InputError& error) {
            throw InputError(error.field(), each.name + ": " + error.value(), error.allowed());
        }
    });
    LearntCodex learnt;
    std::vector<Recitation> recitations;
    for (std::size_t i = 0; i < takes; ++i) {
        for (const DroppedPhone& phone : cuts[i].dropped)
            learnt.dropped.push_back(names[i] + ": " + phone.reason);
        learnt.farthest_mm = std::max(learnt.farthest_mm, cuts[i].farthest_mm);
        recitations.push_back(std::move(cuts[i].recitation));
    }
    const Eigen::VectorXd at_rest = to_components(basis, rest.transpose()).row(0).transpose();
    learnt.codex = make_codex(std::move(basis), at_rest, std::move(recitations), std::move(provenance));
    return learnt;
}

std::string summary(const LearntCodex& learnt) {
    std::size_t phones = 0, via = 0;
    double seconds = 0;
    for (const Recitation& recitation : learnt.codex.recitations) {
        phones += recitation.size();
        for (const RecitedPhone& phone : recitation) via += phone.via.size();
        seconds += duration_of(recitation);
    }
    std::array<char, 240> text;
    std::snprintf(text.data(), text.size(),
                  "%zu recitations, %.0f s: %zu phones (%zu left out), %td components, %zu via points "
                  "(%.1f per s), farthest from the motion %.2f mm",
                  learnt.codex.recitations.size(), seconds, phones, learnt.dropped.size(),
                  learnt.codex.basis.size(), via, static_cast<double>(via) / seconds, learnt.farthest_mm);
    return text.data();
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
                      {},
                      {}};
    for (std::size_t a = 0; a < phone_table().size(); ++a) {
        if (!phones.contains(static_cast<PhoneId>(a)))
            coverage.missing_phones.emplace_back(phone_table()[a].name);
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

SpokenShares shares_by_others(const Codex& codex) {
    const auto looks_alike = [](PhoneId a, PhoneId b) {
        return phone_info(a).viseme == phone_info(b).viseme;
    };
    SpokenShares counts;
    for (auto first = codex.units.begin(); first != codex.units.end();) {
        const auto last =
            std::find_if(first, codex.units.end(), [&](auto& u) { return u.centre != first->centre; });
        for (auto unit = first; unit != last; ++unit) {
            bool exact = false, of_class = false;
            for (auto other = first; other != last; ++other) {
                if (other->recitation == unit->recitation) continue;
                exact = exact || (other->left == unit->left && other->right == unit->right);
                of_class = of_class ||
                           (looks_alike(other->left, unit->left) && looks_alike(other->right, unit->right));
            }
            (exact ? counts.exact : of_class ? counts.of_class : counts.half) += 1;
        }
        first = last;
    }
    const double all = std::max(1.0, static_cast<double>(codex.units.size()));
    return {counts.exact / all, counts.of_class / all, counts.half / all};
}

}  // namespace viaface

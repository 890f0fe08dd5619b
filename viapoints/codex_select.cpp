#include "viapoints/codex_select.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>

namespace viaface {
namespace {

bool other_class(PhoneId a, PhoneId b) { return phone_info(a).viseme != phone_info(b).viseme; }

// Units of one kind: [first, last) of codex.units.
struct UnitRange {
    std::int32_t first, last;
};

template <class Key>
UnitRange units_of(const Codex& codex, const PhoneSlot& slot, const Key& key) {
    const auto& units = codex.units;
    const auto first =
        std::partition_point(units.begin(), units.end(), [&](const auto& u) { return key(u) < key(slot); });
    const auto last =
        std::partition_point(first, units.end(), [&](const auto& u) { return key(u) == key(slot); });
    return {static_cast<std::int32_t>(first - units.begin()),
            static_cast<std::int32_t>(last - units.begin())};
}

double own_cost(const PhoneContext& have, const PhoneContext& want, const SelectionCosts& costs) {
    const double octaves = std::abs(std::log2(have.duration_s / want.duration_s));
    return costs.octave * octaves + (have.stress != want.stress ? costs.stress : 0);
}

double side_cost(bool same, PhoneId outer_have, PhoneId outer_want, const SelectionCosts& costs) {
    return (same ? 0 : costs.same_class) + (other_class(outer_have, outer_want) ? costs.outer_context : 0);
}
double left_cost(const PhoneContext& have, const PhoneContext& want, const SelectionCosts& costs) {
    return side_cost(have.left == want.left, have.left2, want.left2, costs);
}
double right_cost(const PhoneContext& have, const PhoneContext& want, const SelectionCosts& costs) {
    return side_cost(have.right == want.right, have.right2, want.right2, costs);
}

// The cheapest `limit`, in the order of cost, then of units.
void keep_cheapest(std::vector<Candidate>& candidates, std::size_t limit) {
    const auto key = [](const Candidate& c) { return std::tie(c.cost, c.left, c.right); };
    const auto cheaper = [&](const Candidate& a, const Candidate& b) { return key(a) < key(b); };
    const auto middle = candidates.begin() + static_cast<std::ptrdiff_t>(std::min(limit, candidates.size()));
    std::partial_sort(candidates.begin(), middle, candidates.end(), cheaper);
    candidates.erase(middle, candidates.end());
}

double distance_mm(const Eigen::Ref<const Eigen::RowVectorXd>& difference) {
    return difference.norm() / std::sqrt(kPoints);
}

// What one slot asks for, and what each unit lacks of it.
class Target {
  public:
    Target(const Codex& codex, const PhoneSlot& slot, int sample_rate, const SelectionCosts& costs)
        : codex_(codex),
          slot_(slot),
          costs_(costs),
          context_(context_of(slot, sample_rate)),
          same_centre_(units_of(codex, slot, [](const auto& of) { return of.centre; })) {}

    std::vector<Candidate> exact() const {
        const auto key = [](const auto& of) { return std::tie(of.centre, of.left, of.right); };
        return matching(units_of(codex_, slot_, key), UnitLevel::kExact, true, true);
    }
    std::vector<Candidate> of_class() const { return matching(same_centre_, UnitLevel::kClass, true, true); }
    std::vector<Candidate> halves() const;

  private:
    // Units of the phone; where it was never recited, of phones of its class, or else of all vowels or all
    // consonants. Sorted by place in the codex.
    std::vector<Candidate> standing_in() const;
    // The half units for one side: of its context's class, or of any context where there is none.
    std::vector<Candidate> halves_for(const std::vector<Candidate>& units, bool left) const;

    // Those whose contexts on the asked sides are at least of the class.
    std::vector<Candidate> matching(UnitRange range, UnitLevel level, bool left, bool right) const {
        std::vector<Candidate> found;
        for (std::int32_t i = range.first; i < range.last; ++i) {
            const TriphoneUnit& unit = codex_.units[static_cast<std::size_t>(i)];
            if (left && other_class(unit.left, slot_.left)) continue;
            if (right && other_class(unit.right, slot_.right)) continue;
            const PhoneContext have = context_of(codex_, unit);
            double cost = own_cost(have, context_, costs_);
            if (left) cost += left_cost(have, context_, costs_);
            if (right) cost += right_cost(have, context_, costs_);
            found.push_back({i, i, level, cost});
        }
        return found;
    }
    double nucleus_distance(std::int32_t left, std::int32_t right) const {
        const RecitedPhone &a = body_of(codex_, left), &b = body_of(codex_, right);
        return distance_mm(a.points.row(a.nucleus) - b.points.row(b.nucleus));
    }

    const Codex& codex_;
    const PhoneSlot& slot_;
    const SelectionCosts& costs_;
    PhoneContext context_;
    UnitRange same_centre_;
};

// 0 for the phone itself, 1 for one of its class, 2 for another vowel or consonant.
int remoteness(PhoneId phone, PhoneId wanted) {
    if (phone == wanted) return 0;
    if (!other_class(phone, wanted)) return 1;
    const bool pause = phone == kPause || wanted == kPause;
    return !pause && phone_info(phone).vowel == phone_info(wanted).vowel ? 2 : 3;
}

std::vector<Candidate> Target::standing_in() const {
    for (int remote = 0; remote < 3; ++remote) {
        std::vector<Candidate> found;
        for (std::int32_t i = 0; i < std::ssize(codex_.units); ++i) {
            const TriphoneUnit& unit = codex_.units[static_cast<std::size_t>(i)];
            if (remoteness(unit.centre, slot_.centre) != remote) continue;
            const double own = own_cost(context_of(codex_, unit), context_, costs_);
            found.push_back({i, i, UnitLevel::kHalf, own + remote * costs_.other_centre});
        }
        if (!found.empty()) return found;
    }
    return {};
}

std::vector<Candidate> Target::halves_for(const std::vector<Candidate>& units, bool left) const {
    std::vector<Candidate> of_class, of_any;
    for (Candidate half : units) {
        const TriphoneUnit& unit = codex_.units[static_cast<std::size_t>(half.left)];
        const PhoneContext have = context_of(codex_, unit);
        half.cost += left ? left_cost(have, context_, costs_) : right_cost(have, context_, costs_);
        const bool other = left ? other_class(have.left, slot_.left) : other_class(have.right, slot_.right);
        if (other) half.cost += costs_.other_context;
        (other ? of_any : of_class).push_back(half);
    }
    return of_class.empty() ? of_any : of_class;
}

std::vector<Candidate> Target::halves() const {
    constexpr std::size_t kPerSide = 12;
    const std::vector<Candidate> units = standing_in();
    std::vector<Candidate> lefts = halves_for(units, true), rights = halves_for(units, false);
    keep_cheapest(lefts, kPerSide);
    keep_cheapest(rights, kPerSide);
    std::vector<Candidate> pairs;
    for (const Candidate& l : lefts) {
        for (const Candidate& r : rights) {
            const double cost = costs_.half + (l.cost + r.cost) / 2 + nucleus_distance(l.left, r.right);
            pairs.push_back({l.left, r.right, UnitLevel::kHalf, cost});
        }
    }
    return pairs;
}

}  // namespace

PhoneContext context_of(const PhoneSlot& slot, int sample_rate) {
    return {slot.left2,  slot.left,   slot.right,
            slot.right2, slot.stress, static_cast<double>(slot.end - slot.begin) / sample_rate};
}

PhoneContext context_of(const Codex& codex, const TriphoneUnit& unit) {
    return {unit.left2, unit.left, unit.right, unit.right2, unit.stress, body_of(codex, unit).duration_s};
}

double unlikeness(const PhoneContext& a, const PhoneContext& b, const SelectionCosts& costs) {
    const int others = other_class(a.left, b.left) + other_class(a.right, b.right);
    return own_cost(a, b, costs) + left_cost(a, b, costs) + right_cost(a, b, costs) +
           others * costs.other_context;
}

std::vector<Candidate> candidates_of(const Codex& codex, const PhoneSlot& slot, int sample_rate,
                                     const SelectionCosts& costs) {
    const Target target(codex, slot, sample_rate, costs);
    std::vector<Candidate> found = target.exact();
    if (found.empty()) found = target.of_class();
    if (found.empty()) found = target.halves();
    if (found.empty()) {
        throw std::runtime_error("the codex has neither " +
                                 triphone_name(slot.left, slot.centre, slot.right) +
                                 " nor phones that could stand in");
    }
    keep_cheapest(found, kMaxCandidates);
    return found;
}

double join_cost(const Codex& codex, const Candidate& from, const Candidate& to,
                 const SelectionCosts& costs) {
    const Eigen::Index k = codex.rest.size();
    const auto position = codex.begins.row(to.left).head(k) - codex.ends.row(from.right).head(k);
    const auto velocity = codex.begins.row(to.left).tail(k) - codex.ends.row(from.right).tail(k);
    return std::sqrt((position.squaredNorm() + costs.velocity_s * costs.velocity_s * velocity.squaredNorm()) /
                     kPoints);
}

namespace {

// The columns of the trellis so far: candidates, where the cheapest path to each came from, and what it cost.
struct Trellis {
    std::vector<std::vector<Candidate>> candidates;
    std::vector<std::vector<std::size_t>> came_from;
    std::vector<double> cost;  // of the paths to the newest candidates

    void append(const Codex& codex, std::vector<Candidate> newest, const SelectionCosts& costs) {
        std::vector<double> next;
        std::vector<std::size_t> from;
        for (const Candidate& candidate : newest) {
            double cheapest = candidates.empty() ? 0 : std::numeric_limits<double>::infinity();
            std::size_t best = 0;
            for (std::size_t b = 0; b < cost.size(); ++b) {
                const double through = cost[b] + join_cost(codex, candidates.back()[b], candidate, costs);
                if (through < cheapest) std::tie(cheapest, best) = std::pair(through, b);
            }
            next.push_back(cheapest + candidate.cost);
            from.push_back(best);
        }
        candidates.push_back(std::move(newest));
        came_from.push_back(std::move(from));
        cost = std::move(next);
    }
};

}  // namespace

Selection select_units(const Codex& codex, const PhoneSequence& phones, const SelectionCosts& costs) {
    Selection selection{slots_of(phones), {}};
    if (selection.slots.size() == 1) return selection;
    Trellis trellis;
    for (const PhoneSlot& slot : selection.slots) {
        trellis.append(codex, candidates_of(codex, slot, phones.sample_rate, costs), costs);
    }
    const auto last = std::min_element(trellis.cost.begin(), trellis.cost.end());
    selection.cost = *last;
    selection.units.resize(selection.slots.size());
    auto at = static_cast<std::size_t>(last - trellis.cost.begin());
    for (std::size_t i = selection.slots.size(); i-- > 0; at = trellis.came_from[i][at]) {
        selection.units[i] = trellis.candidates[i][at];
        ++selection.phones_at_level[static_cast<std::size_t>(selection.units[i].level)];
    }
    return selection;
}

}  // namespace viaface

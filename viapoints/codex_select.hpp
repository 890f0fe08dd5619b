// Chooses the codex's units for a sequence of phones: the cheapest path through the candidates of every slot,
// by Viterbi. All costs are in mm: what a mismatch is worth as a jump of the face.
//
// The centre phone is kept wherever it was recited at all. Candidates come from the first level that has any:
//   exact  the triphone itself;
//   class  contexts of the same viseme classes;
//   half   the part up to the nucleus of one unit, of the left context (or its class, or else any), and the
//          part after it of another, of the right context likewise. A phone that was never recited is spoken
//          by one of its class here, or else by any vowel for a vowel and any consonant for a consonant.
// Each level gives at most kMaxCandidates, the cheapest by target cost; ties go to the unit that stands first
// in the codex.
#pragma once

#include <array>
#include <vector>

#include "viapoints/codex.hpp"

namespace viaface {

inline constexpr std::size_t kMaxCandidates = 24;

struct SelectionCosts {
    double same_class = 1;       // mm, a context that is another phone of the same class, each side
    double outer_context = 0.3;  // mm, the next phone but one is of another class, each side
    double octave = 1;           // mm per factor of 2 in duration
    double stress = 0.7;         // mm, a vowel stressed otherwise
    double velocity_s = 0.02;    // s: a jump in velocity counts as what it becomes in this time
    double other_context = 2;    // mm, a half whose context is of another class
    double other_centre = 3;     // mm, a half of another phone of the class; twice for one of another class
    double half = 1;             // mm, for every half unit, beside the distance of the two nuclei
};

// What a phone stands in, whether recited or asked for.
struct PhoneContext {
    PhoneId left2 = kPause, left = kPause, right = kPause, right2 = kPause;
    int stress = 0;
    double duration_s = 0;
};
PhoneContext context_of(const PhoneSlot& slot, int sample_rate);
PhoneContext context_of(const Codex& codex, const TriphoneUnit& unit);

// mm, how unlike two contexts of one phone are: all of the costs of units that stand in whole.
double unlikeness(const PhoneContext& a, const PhoneContext& b, const SelectionCosts& costs = {});

enum class UnitLevel : std::uint8_t { kExact, kClass, kHalf };

struct Candidate {
    std::int32_t left = 0, right = 0;  // indices into codex.units; equal but for halves
    UnitLevel level = UnitLevel::kExact;
    double cost = 0;  // mm, target cost
};

// Throws std::runtime_error naming the triphone when the codex has no phone that could stand in.
std::vector<Candidate> candidates_of(const Codex& codex, const PhoneSlot& slot, int sample_rate,
                                     const SelectionCosts& costs = {});

// The jump from the end of one to the begin of the next: distance of the moving points, root mean square over
// the layout, and the same of their velocities; 0 for phones recited one after the other.
double join_cost(const Codex& codex, const Candidate& from, const Candidate& to,
                 const SelectionCosts& costs = {});

struct Selection {
    std::vector<PhoneSlot> slots;
    std::vector<Candidate> units;             // one per slot; none for a sequence of one pause
    double cost = 0;                          // mm, target and join costs summed
    std::array<int, 3> phones_at_level = {};  // how many slots were spoken from each UnitLevel
};

Selection select_units(const Codex& codex, const PhoneSequence& phones, const SelectionCosts& costs = {});

}  // namespace viaface

// The codex: what a talker's face does for a phone between two others, held as via points cut out of
// recitations. It is the only thing that speaks at run time [ATR98, "Text-To-Audible-Visible Speech"].
//
// A unit is a centre phone in its left and right context. Its via points lie inside the centre phone, at
// relative times 0 (its begin) to 1 (its end, exclusive), so that a closure stays inside its phone whatever
// the phone's duration. What a neighbour anticipates is in the neighbour's unit, which was cut in that
// context. One via point of each phone is its nucleus: the closure of a bilabial or labiodental, else where
// the face is stillest.
//
// A pause between two phrases is the end of one and the beginning of the next: two slots, (l, pau, pau) and
// (pau, pau, r), halves of the pause. A sentence begins and ends in a pause; beyond lies pau.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "viapoints/basis.hpp"
#include "viapoints/phones.hpp"
#include "viapoints/spline.hpp"
#include "viapoints/track.hpp"
#include "viapoints/via_spacing.hpp"

namespace viaface {

// A phone in its context, to be spoken or recited.
struct PhoneSlot {
    PhoneId left2 = kPause, left = kPause, centre = kPause, right = kPause, right2 = kPause;
    int stress = 0;
    std::int64_t begin = 0, end = 0;  // samples, [begin, end)
    std::size_t phone = 0;            // index into the sequence; both halves of a pause name the pause
};

// One slot per phone; neighbouring pauses count as one, and a pause inside the sequence gives two slots.
// Throws std::invalid_argument when the sequence is empty, has gaps or phones under two samples, or does not
// begin and end in a pause.
std::vector<PhoneSlot> slots_of(const PhoneSequence& phones);

// A phone of a recitation with the via points that lie in it.
struct RecitedPhone {
    PhoneId phone = kPause;
    int stress = 0;
    bool usable = true;  // false: an outlier, kept only as its neighbours' context
    double duration_s = 0;
    std::vector<double> via = {};  // strictly rising, [0, 1): relative to the phone
    RowMatrix points = {};         // [via x k], components
    int nucleus = 0;               // index into via; 0 when there is none
};

// In order and gapless, pauses inside split in two as slots_of does, both ends at rest.
using Recitation = std::vector<RecitedPhone>;

struct TriphoneUnit {
    PhoneId left = kPause, centre = kPause, right = kPause;
    PhoneId left2 = kPause, right2 = kPause;
    int stress = 0;
    std::int32_t recitation = 0, place = 0;  // its body is codex.recitations[recitation][place]
};

struct Codex {
    ConfigurationBasis basis;
    Eigen::VectorXd rest;  // [k], components of the posture at rest
    std::vector<Recitation> recitations;
    std::string provenance;  // UTF-8: whose motion this is
    // Given, a phone is spoken by all units that are like it (codex_consensus.hpp), not by the chosen one
    // alone: mm, what units of the very same context differ by, beside the costs of codex_select.hpp.
    std::optional<double> scatter_mm;

    // Made from the above by make_codex: the usable phones by centre, left, right, then recitation and place,
    // and the motion where each begins and ends: position in mm (components), then velocity in mm/s.
    std::vector<TriphoneUnit> units;
    RowMatrix begins, ends;                  // [units x 2k]
    std::vector<MinimumJerkSpline> motions;  // of the recitations, where there is a scatter
};

// The shape checked (std::invalid_argument says what is wrong), the units sorted and their joins computed
// from the spline of each recitation. The basis has to be orthonormal: distances of components are then
// distances of points.
Codex make_codex(ConfigurationBasis basis, Eigen::VectorXd rest, std::vector<Recitation> recitations,
                 std::string provenance, std::optional<double> scatter_mm = std::nullopt);

inline const RecitedPhone& body_of(const Codex& codex, const TriphoneUnit& unit) {
    return codex.recitations[static_cast<std::size_t>(unit.recitation)][static_cast<std::size_t>(unit.place)];
}
inline const RecitedPhone& body_of(const Codex& codex, std::int32_t unit) {
    return body_of(codex, codex.units[static_cast<std::size_t>(unit)]);
}

ViaRank nucleus_rank(PhoneId phone);  // what the phone's nucleus is worth beside other via points

double duration_of(const Recitation& recitation);      // s
ViaPointTrack track_of(const Recitation& recitation);  // components, from time 0 at its first phone's begin

std::string triphone_name(PhoneId left, PhoneId centre, PhoneId right);  // "ae-p+s"

}  // namespace viaface

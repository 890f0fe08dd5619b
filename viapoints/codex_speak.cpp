#include "viapoints/codex_speak.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "viapoints/codex_consensus.hpp"
#include "viapoints/via_spacing.hpp"

namespace viaface {
namespace {

struct Via {
    double at;  // relative to the phone, then samples
    Eigen::RowVectorXd point;
    ViaRank rank;
    int run = 0;
};

Via via_of(const RecitedPhone& phone, int via) {
    const ViaRank rank = via == phone.nucleus ? nucleus_rank(phone.phone) : ViaRank::kPassing;
    return {phone.via[static_cast<std::size_t>(via)], phone.points.row(via), rank};
}

std::vector<Via> whole(const RecitedPhone& phone) {
    std::vector<Via> vias;
    for (int i = 0; i < std::ssize(phone.via); ++i) vias.push_back(via_of(phone, i));
    return vias;
}

// The two nuclei meet half way in time and place; what comes before and after is stretched to that.
std::vector<Via> joined(const RecitedPhone& left, const RecitedPhone& right) {
    const Via a = via_of(left, left.nucleus), b = via_of(right, right.nucleus);
    const Via nucleus{(a.at + b.at) / 2, (a.point + b.point) / 2, a.rank};
    std::vector<Via> vias;
    for (int i = 0; i < left.nucleus; ++i) {
        vias.push_back(via_of(left, i));
        vias.back().at *= nucleus.at / a.at;
    }
    vias.push_back(nucleus);
    for (int i = right.nucleus + 1; i < std::ssize(right.via); ++i) {
        vias.push_back(via_of(right, i));
        vias.back().at = 1 - (1 - vias.back().at) * (1 - nucleus.at) / (1 - b.at);
    }
    return vias;
}

// The samples in which a slot is spoken. The first and the last are widened outwards to kRestReach.
struct Stage {
    double begin, end;
};

Stage stage_of(const std::vector<PhoneSlot>& slots, std::size_t i, double reach) {
    Stage stage{static_cast<double>(slots[i].begin), static_cast<double>(slots[i].end)};
    if (i == 0) stage.begin = std::min(stage.begin, stage.end - reach);
    if (i + 1 == slots.size()) stage.end = std::max(stage.end, stage.begin + reach);
    return stage;
}

std::vector<Via> in_phone(std::vector<Via> vias, const Stage& stage) {
    for (Via& via : vias) via.at = stage.begin + via.at * (stage.end - stage.begin);
    return vias;
}

// At the pace of its unit, which took `recited` samples; `leads` to speech or follows it.
std::vector<Via> in_pause(std::vector<Via> vias, const Stage& stage, bool leads, double recited,
                          const Via& rest, double reach) {
    const double used = std::min(stage.end - stage.begin, recited);
    const double begin = leads ? stage.end - used : stage.begin;
    vias = in_phone(std::move(vias), {begin, begin + used});
    if (stage.end - stage.begin - used >= reach) {
        vias.insert(leads ? vias.begin() : vias.end(), rest);
        (leads ? vias.front() : vias.back()).at = leads ? begin - reach : begin + used + reach;
    }
    return vias;
}

// The times of the chosen units' via points, the places that all alike agree on.
void agree(const Codex& codex, const PhoneContext& asked, PhoneId centre, double duration_s,
           std::vector<Via>& vias) {
    const AlikeUnits alike = alike_units(codex, centre, asked);
    if (alike.units.empty()) return;
    PhoneInstants instants{{}, vias.front().at, duration_s};
    for (const Via& via : vias) {
        instants.at.push_back(via.at);
        if (via.rank != ViaRank::kPassing) instants.nucleus = via.at;
    }
    const RowMatrix agreed = agreed_motion(codex, alike, kriging_weights(alike, *codex.scatter_mm), instants);
    for (std::size_t i = 0; i < vias.size(); ++i) {
        vias[i].point = agreed.row(static_cast<Eigen::Index>(i));
        if (vias[i].rank == ViaRank::kBilabial) vias[i].point = with_lips_together(codex, vias[i].point);
    }
}

std::vector<Via> in_slot(const Codex& codex, const PhoneSlot& slot, const Candidate& unit, const Stage& stage,
                         int sample_rate) {
    const RecitedPhone& left = body_of(codex, unit.left);
    const RecitedPhone& right = body_of(codex, unit.right);
    std::vector<Via> vias = unit.left == unit.right ? whole(left) : joined(left, right);
    const double recited_s = (left.duration_s + right.duration_s) / 2;
    if (codex.scatter_mm) agree(codex, context_of(slot, sample_rate), left.phone, recited_s, vias);
    if (slot.centre != kPause) return in_phone(std::move(vias), stage);
    const Via rest{0, codex.rest.transpose(), ViaRank::kRest};
    return in_pause(std::move(vias), stage, slot.left == kPause, recited_s * sample_rate, rest,
                    kRestReach * sample_rate);
}

bool recited_together(const Codex& codex, const Candidate& from, const Candidate& to) {
    const TriphoneUnit& a = codex.units[static_cast<std::size_t>(from.right)];
    const TriphoneUnit& b = codex.units[static_cast<std::size_t>(to.left)];
    return a.recitation == b.recitation && a.place + 1 == b.place;
}

RankedTrack on_clock(const std::vector<Via>& vias, int sample_rate) {
    RankedTrack ranked{{{}, RowMatrix(std::ssize(vias), vias.front().point.size())}, {}, {}};
    for (const Via& via : vias) {
        ranked.track.points.row(std::ssize(ranked.rank)) = via.point;
        ranked.track.time_s.push_back(std::round(via.at) / sample_rate);
        ranked.rank.push_back(via.rank);
        ranked.run.push_back(via.run);
    }
    return ranked;
}

ViaPointTrack graded(const ViaPointTrack& track, int sample_rate) {
    const MonotoneCubic between(track);
    std::vector<double> times = track.time_s;
    for (const double time : grading_times(track.time_s, kMaxViaGapRatio))
        times.push_back(std::round(time * sample_rate) / sample_rate);
    std::sort(times.begin(), times.end());
    ViaPointTrack result{std::move(times), {}};
    result.points.resize(std::ssize(result.time_s), track.points.cols());
    for (Eigen::Index i = 0; i < result.points.rows(); ++i) {
        result.points.row(i) = between.at(result.time_s[static_cast<std::size_t>(i)]);
    }
    return result;
}

}  // namespace

ViaPointTrack speak(const Codex& codex, const PhoneSequence& phones, const Selection& selection) {
    const auto& slots = selection.slots;
    if (slots.empty() || (selection.units.size() != slots.size() && slots.size() > 1)) {
        throw std::invalid_argument("speak: one unit per slot wanted");
    }
    const double reach = kRestReach * phones.sample_rate;
    const Eigen::RowVectorXd rest = codex.rest.transpose();
    std::vector<Via> vias{{stage_of(slots, 0, reach).begin, rest, ViaRank::kRest}};
    int run = 0;
    for (std::size_t i = 0; i < selection.units.size(); ++i) {
        if (i > 0 && !recited_together(codex, selection.units[i - 1], selection.units[i])) ++run;
        for (Via& via :
             in_slot(codex, slots[i], selection.units[i], stage_of(slots, i, reach), phones.sample_rate)) {
            via.run = run;
            vias.push_back(std::move(via));
        }
    }
    vias.push_back({stage_of(slots, slots.size() - 1, reach).end, rest, ViaRank::kRest, run});
    const RankedTrack spaced = thinned(on_clock(vias, phones.sample_rate), kMinViaGap, kMinViaGapInRun);
    return graded(spaced.track, phones.sample_rate);
}

}  // namespace viaface

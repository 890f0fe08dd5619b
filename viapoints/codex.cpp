#include "viapoints/codex.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

namespace viaface {
namespace {

constexpr double kMostScatter = 1000;         // mm
constexpr double kClosestRecitedVia = 0.001;  // s: closer ones bring the spline's system near its limits

void check(bool holds, const std::string& what) {
    if (!holds) throw std::invalid_argument("codex: " + what);
}

void check_sequence(const std::vector<TimedPhone>& phones) {
    const auto wrong = [](const std::string& what) {
        throw std::invalid_argument("phone sequence: " + what);
    };
    if (phones.empty()) wrong("it is empty");
    for (std::size_t i = 0; i < phones.size(); ++i) {
        if (phones[i].phone >= phone_table().size())
            wrong("phone " + std::to_string(i) + " is not in the table");
        if (phones[i].end - phones[i].begin < 2)
            wrong("phone " + std::to_string(i) + " is under two samples long");
        if (i > 0 && phones[i].begin != phones[i - 1].end) {
            wrong("phone " + std::to_string(i) + " does not begin where the one before ends");
        }
    }
    if (phones.front().phone != kPause || phones.back().phone != kPause)
        wrong("it has to begin and end in a pause");
}

// A pause followed by a pause is one pause.
std::vector<PhoneSlot> without_contexts(const std::vector<TimedPhone>& phones) {
    std::vector<PhoneSlot> slots;
    for (std::size_t i = 0; i < phones.size(); ++i) {
        const TimedPhone& phone = phones[i];
        if (phone.phone == kPause && !slots.empty() && slots.back().centre == kPause) {
            slots.back().end = phone.end;
        } else {
            PhoneSlot slot;
            std::tie(slot.centre, slot.stress) = std::tuple(phone.phone, phone.stress);
            std::tie(slot.begin, slot.end, slot.phone) = std::tuple(phone.begin, phone.end, i);
            slots.push_back(slot);
        }
    }
    return slots;
}

std::vector<PhoneSlot> with_inner_pauses_halved(const std::vector<PhoneSlot>& whole) {
    std::vector<PhoneSlot> slots;
    for (std::size_t i = 0; i < whole.size(); ++i) {
        slots.push_back(whole[i]);
        const bool inner_pause = whole[i].centre == kPause && i > 0 && i + 1 < whole.size();
        if (!inner_pause) continue;
        const std::int64_t middle = whole[i].begin + (whole[i].end - whole[i].begin) / 2;
        slots.back().end = middle;
        slots.push_back(whole[i]);
        slots.back().begin = middle;
    }
    return slots;
}

// The phones beside slot i; past a pause lies pause.
template <class PhoneAt>
void set_contexts(auto& to, const PhoneAt& phone_at, std::ptrdiff_t i) {
    to.left = phone_at(i - 1);
    to.right = phone_at(i + 1);
    to.left2 = to.left == kPause ? kPause : phone_at(i - 2);
    to.right2 = to.right == kPause ? kPause : phone_at(i + 2);
}

void check_phone(const RecitedPhone& phone, Eigen::Index k, const std::string& where) {
    check(phone.phone < phone_table().size(), where + " is not in the phone table");
    check(phone.stress >= 0 && phone.stress <= 2, where + " has no stress from 0 to 2");
    check(std::isfinite(phone.duration_s) && phone.duration_s > 0, where + " has no length");
    const auto count = static_cast<Eigen::Index>(phone.via.size());
    check(phone.points.rows() == count && (count == 0 || phone.points.cols() == k),
          where + " holds points of another shape than its times");
    check(phone.points.allFinite(), where + " holds a point that is not finite");
    check(phone.nucleus >= 0 && phone.nucleus < std::max<Eigen::Index>(count, 1),
          where + " has no such nucleus");
    check(!phone.usable || count > 0, where + " is usable but has no via point");
    for (std::size_t i = 0; i < phone.via.size(); ++i) {
        const double before = i == 0 ? 0 : phone.via[i - 1];
        check(phone.via[i] >= 0 && phone.via[i] < 1 && (i == 0 || phone.via[i] > before),
              where + " has via times that do not rise within [0, 1)");
    }
}

void check_recitation(const Recitation& recitation, Eigen::Index k, const std::string& name) {
    for (std::size_t p = 0; p < recitation.size(); ++p) {
        check_phone(recitation[p], k, "phone " + std::to_string(p) + " of " + name);
    }
    const ViaPointTrack track = track_of(recitation);
    check(track.time_s.size() >= 2, name + " holds fewer than two via points");
    for (std::size_t i = 1; i < track.time_s.size(); ++i) {
        check(track.time_s[i] - track.time_s[i - 1] >= kClosestRecitedVia,
              name + " holds via points closer than 1 ms");
    }
}

void check_shapes(const Codex& codex) {
    const Eigen::Index k = codex.basis.modes.cols();
    check(codex.basis.modes.rows() == kCoordinates && k > 0, "the basis is not [114 x k]");
    check(codex.basis.modes.allFinite() && codex.rest.allFinite(),
          "the basis or the posture at rest is not finite");
    for (Eigen::Index i = 0; i < kCoordinates; ++i) {
        const bool lacks_point = std::isnan(codex.basis.mean[i]) && codex.basis.modes.row(i).isZero(0);
        check(std::isfinite(codex.basis.mean[i]) || lacks_point, "the mean of the basis is not finite");
    }
    check(codex.rest.size() == k, "the posture at rest is not [k]");
    const Eigen::MatrixXd gram = codex.basis.modes.transpose() * codex.basis.modes;
    check(!codex.scatter_mm || (*codex.scatter_mm >= 0 && *codex.scatter_mm <= kMostScatter),
          "the scatter is outside 0 to 1000 mm");
    check((gram - Eigen::MatrixXd::Identity(k, k)).cwiseAbs().maxCoeff() < 1e-6,
          "the basis is not orthonormal");
    for (std::size_t r = 0; r < codex.recitations.size(); ++r) {
        check_recitation(codex.recitations[r], k, "recitation " + std::to_string(r));
    }
}

void append_units(const Recitation& recitation, std::size_t index, std::vector<TriphoneUnit>& units) {
    const auto phone_at = [&](std::ptrdiff_t i) {
        return i < 0 || i >= std::ssize(recitation) ? kPause : recitation[static_cast<std::size_t>(i)].phone;
    };
    for (std::size_t p = 0; p < recitation.size(); ++p) {
        if (!recitation[p].usable) continue;
        TriphoneUnit unit;
        unit.centre = recitation[p].phone;
        unit.stress = recitation[p].stress;
        unit.recitation = static_cast<std::int32_t>(index);
        unit.place = static_cast<std::int32_t>(p);
        set_contexts(unit, phone_at, static_cast<std::ptrdiff_t>(p));
        units.push_back(unit);
    }
}

// Position and velocity at every phone's begin, and at the end of the last. [phones + 1 x 2k]
RowMatrix states_of(const Recitation& recitation, const MinimumJerkSpline& spline) {
    const Eigen::Index k = spline.track().points.cols();
    RowMatrix states(static_cast<Eigen::Index>(recitation.size()) + 1, 2 * k);
    double time = 0;
    for (Eigen::Index i = 0; i < states.rows(); ++i) {
        states.row(i).head(k) = spline.at(time).transpose();
        states.row(i).tail(k) = spline.at(time, 1).transpose();
        if (i + 1 < states.rows()) time += recitation[static_cast<std::size_t>(i)].duration_s;
    }
    return states;
}

void set_joins(Codex& codex) {
    const Eigen::Index k = codex.basis.modes.cols();
    std::vector<RowMatrix> states;
    for (const Recitation& recitation : codex.recitations) {
        MinimumJerkSpline spline(track_of(recitation), SplineEnd::at_rest(), SplineEnd::at_rest());
        states.push_back(states_of(recitation, spline));
        if (codex.scatter_mm) codex.motions.push_back(std::move(spline));
    }
    codex.begins.resize(std::ssize(codex.units), 2 * k);
    codex.ends.resize(std::ssize(codex.units), 2 * k);
    for (Eigen::Index u = 0; u < std::ssize(codex.units); ++u) {
        const TriphoneUnit& unit = codex.units[static_cast<std::size_t>(u)];
        const RowMatrix& of_recitation = states[static_cast<std::size_t>(unit.recitation)];
        codex.begins.row(u) = of_recitation.row(unit.place);
        codex.ends.row(u) = of_recitation.row(unit.place + 1);
    }
}

}  // namespace

std::vector<PhoneSlot> slots_of(const PhoneSequence& phones) {
    check_sequence(phones.phones);
    std::vector<PhoneSlot> slots = with_inner_pauses_halved(without_contexts(phones.phones));
    const auto phone_at = [&](std::ptrdiff_t i) {
        return i < 0 || i >= std::ssize(slots) ? kPause : slots[static_cast<std::size_t>(i)].centre;
    };
    for (std::size_t i = 0; i < slots.size(); ++i)
        set_contexts(slots[i], phone_at, static_cast<std::ptrdiff_t>(i));
    return slots;
}

ViaRank nucleus_rank(PhoneId phone) {
    const VisemeClass viseme = phone_info(phone).viseme;
    if (viseme == VisemeClass::kBilabial) return ViaRank::kBilabial;
    return viseme == VisemeClass::kLabiodental ? ViaRank::kLabiodental : ViaRank::kNucleus;
}

double duration_of(const Recitation& recitation) {
    double sum = 0;
    for (const RecitedPhone& phone : recitation) sum += phone.duration_s;
    return sum;
}

ViaPointTrack track_of(const Recitation& recitation) {
    Eigen::Index rows = 0, k = 0;
    for (const RecitedPhone& phone : recitation) {
        rows += phone.points.rows();
        k = std::max(k, phone.points.cols());
    }
    ViaPointTrack track{{}, RowMatrix(rows, k)};
    double begin = 0;
    for (const RecitedPhone& phone : recitation) {
        for (Eigen::Index i = 0; i < phone.points.rows(); ++i) {
            track.points.row(std::ssize(track.time_s)) = phone.points.row(i);
            track.time_s.push_back(begin + phone.via[static_cast<std::size_t>(i)] * phone.duration_s);
        }
        begin += phone.duration_s;
    }
    return track;
}

Codex make_codex(ConfigurationBasis basis, Eigen::VectorXd rest, std::vector<Recitation> recitations,
                 std::string provenance, std::optional<double> scatter_mm) {
    Codex codex{std::move(basis),
                std::move(rest),
                std::move(recitations),
                std::move(provenance),
                scatter_mm,
                {},
                {},
                {},
                {}};
    check_shapes(codex);
    for (std::size_t r = 0; r < codex.recitations.size(); ++r)
        append_units(codex.recitations[r], r, codex.units);
    const auto key = [](const TriphoneUnit& u) {
        return std::tie(u.centre, u.left, u.right, u.recitation, u.place);
    };
    std::sort(codex.units.begin(), codex.units.end(),
              [&](const TriphoneUnit& a, const TriphoneUnit& b) { return key(a) < key(b); });
    set_joins(codex);
    return codex;
}

std::string triphone_name(PhoneId left, PhoneId centre, PhoneId right) {
    const auto name = [](PhoneId id) { return std::string(phone_info(id).name); };
    return name(left) + "-" + name(centre) + "+" + name(right);
}

}  // namespace viaface

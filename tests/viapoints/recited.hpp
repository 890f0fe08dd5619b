// Small recitations with known motion: every phone has a target, coloured by its neighbours, and the face
// moves between the targets at phone centres by minimum jerk. Bilabials press the lips: the first component
// is far below contact there only.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "base/decompositions.hpp"
#include "viapoints/codex_cut.hpp"
#include "viapoints/spline.hpp"

namespace viaface::recited {

inline constexpr int kModes = 10;
inline constexpr double kContact = -2;  // first component: lips meet below this
inline constexpr int kRate = 16000;     // Hz

class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15ull + 1) {}
    double uniform(double low, double high) {
        state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
        return low + (high - low) * static_cast<double>(state_ >> 11) / 9007199254740992.0;
    }
    int below(int count) { return static_cast<int>(uniform(0, count)); }

  private:
    std::uint64_t state_;
};

inline ConfigurationBasis lip_basis() {
    Random random(7);
    Eigen::MatrixXd raw(kCoordinates, kModes);
    for (auto& value : raw.reshaped()) value = random.uniform(-1, 1);
    raw.col(0).setZero();
    raw(3 * kInnerTop + 1, 0) = 0.3;
    for (const Point p : {kInnerBottom, kBorderBottom, kLipBottom, kChin, kLowerIncisor})
        raw(3 * p + 1, 0) = -1;
    ConfigurationBasis basis{Configuration::Zero(), thin_qr(raw).q};
    if (basis.modes(3 * kInnerTop + 1, 0) < 0) basis.modes.col(0) *= -1;
    return basis;
}

inline PhoneId id(std::string_view name) { return parse_phone(name).phone; }

inline bool presses(PhoneId phone) { return phone_info(phone).viseme == VisemeClass::kBilabial; }

inline Eigen::VectorXd target(PhoneId phone) {
    if (phone == kPause) return Eigen::VectorXd::Zero(kModes);
    Random random(100 + phone);
    Eigen::VectorXd c(kModes);
    for (double& value : c) value = random.uniform(-8, 8);
    c[0] = presses(phone) ? -9 : random.uniform(4, 18);
    return c;
}

inline std::vector<PhoneId> phone_set() {
    return {id("p"), id("m"), id("f"), id("s"), id("t"), id("aa"), id("iy"), id("uw"), id("l")};
}

// Phones as (id, seconds); pauses are written out.
struct Said {
    PhoneId phone;
    double duration_s;
};

inline PhoneSequence sequence(const std::vector<Said>& said) {
    PhoneSequence phones{kRate, {}};
    std::int64_t begin = 0;
    for (const Said& s : said) {
        const auto length = static_cast<std::int64_t>(s.duration_s * kRate);
        const int stress = phone_info(s.phone).vowel ? 1 : 0;
        phones.phones.push_back({s.phone, stress, begin, begin + length});
        begin += length;
    }
    return phones;
}

inline PhoneSequence random_sentence(std::uint64_t seed, int length) {
    Random random(seed);
    const auto set = phone_set();
    std::vector<Said> said{{kPause, random.uniform(0.25, 0.5)}};
    for (int i = 0; i < length; ++i) {
        PhoneId phone = set[static_cast<std::size_t>(random.below(std::ssize(set)))];
        if (i > 0 && i % 9 == 0 && i + 1 < length) phone = kPause;
        if (presses(phone) && presses(said.back().phone)) phone = id("aa");
        said.push_back({phone, phone == kPause ? random.uniform(0.15, 0.4) : random.uniform(0.06, 0.16)});
    }
    said.push_back({kPause, random.uniform(0.25, 0.5)});
    return sequence(said);
}

// The motion itself, as a spline through targets, and what a recording and its analysis would hold of it.
inline MinimumJerkSpline motion_of(const PhoneSequence& phones) {
    const auto slots = slots_of(phones);
    ViaPointTrack track;
    std::vector<Eigen::VectorXd> points;
    for (const PhoneSlot& slot : slots) {
        const double begin = static_cast<double>(slot.begin) / kRate,
                     length = static_cast<double>(slot.end - slot.begin) / kRate;
        if (slot.centre == kPause) {
            const bool leads = slot.left == kPause;
            for (const double u : leads ? std::vector{0.0, 0.5} : std::vector{0.5, 1.0}) {
                if (!track.time_s.empty() && track.time_s.back() > begin + u * length - 1e-9) continue;
                track.time_s.push_back(begin + u * length);
                points.push_back(Eigen::VectorXd::Zero(kModes));
            }
            continue;
        }
        Eigen::VectorXd c = target(slot.centre);
        if (!presses(slot.centre)) c += 0.15 * (target(slot.left) + target(slot.right));
        for (const double u : presses(slot.centre) ? std::vector{0.35, 0.65} : std::vector{0.5}) {
            track.time_s.push_back(begin + u * length);
            points.push_back(c);
        }
    }
    track.points.resize(std::ssize(points), kModes);
    for (Eigen::Index i = 0; i < track.points.rows(); ++i)
        track.points.row(i) = points[static_cast<std::size_t>(i)].transpose();
    return MinimumJerkSpline(track, SplineEnd::at_rest(), SplineEnd::at_rest());
}

inline RecitationTake take_of(const PhoneSequence& phones, double via_step_s = 0.07) {
    const MinimumJerkSpline motion = motion_of(phones);
    const double end = phones.end_s(phones.phones.size() - 1);
    RecitationTake take{phones, {}, {}, {}};
    for (int i = 0; i * 0.005 <= end + 0.005; ++i) take.time_s.push_back(i * 0.005);
    take.components = motion.at(take.time_s);
    for (int i = 0; i * via_step_s <= end; ++i) take.track.time_s.push_back(i * via_step_s);
    take.track.points = motion.at(take.track.time_s);
    return take;
}

inline Codex codex_of(int sentences, int length = 20) {
    const ConfigurationBasis basis = lip_basis();
    std::vector<Recitation> recitations;
    for (int i = 0; i < sentences; ++i) {
        recitations.push_back(
            cut_recitation(basis, take_of(random_sentence(static_cast<std::uint64_t>(i), length)))
                .recitation);
    }
    return make_codex(basis, Eigen::VectorXd::Zero(kModes), recitations, "spoken by a test");
}

}  // namespace viaface::recited

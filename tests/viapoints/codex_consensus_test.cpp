// Units that are alike speak together.
#include "viapoints/codex_consensus.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/viapoints/recited.hpp"
#include "viapoints/codex_speak.hpp"
#include "viapoints/lip_rows.hpp"

namespace viaface {
namespace {

using namespace recited;

Codex codex_of_recitations(std::vector<Recitation> recitations,
                           std::optional<double> scatter_mm = std::nullopt) {
    return make_codex(lip_basis(), Eigen::VectorXd::Zero(kModes), std::move(recitations), "", scatter_mm);
}

Recitation recitation_of(const PhoneSequence& phones) {
    return cut_recitation(lip_basis(), take_of(phones)).recitation;
}

Recitation with_noise(Recitation recitation, std::uint64_t seed, double most_mm) {
    Random random(seed);
    for (RecitedPhone& phone : recitation)
        for (double& value : phone.points.reshaped()) value += random.uniform(-most_mm, most_mm);
    return recitation;
}

RowMatrix spoken(const Codex& codex, const PhoneSequence& phones) {
    const MinimumJerkSpline spline(speak(codex, phones, select_units(codex, phones)), SplineEnd::at_rest(),
                                   SplineEnd::at_rest());
    std::vector<double> times;
    for (double time = 0; time < phones.end_s(phones.phones.size() - 1); time += 0.01) times.push_back(time);
    return spline.at(times);
}

std::vector<std::int32_t> units_of_centre(const Codex& codex, PhoneId centre) {
    std::vector<std::int32_t> units;
    for (std::int32_t i = 0; i < std::ssize(codex.units); ++i)
        if (codex.units[static_cast<std::size_t>(i)].centre == centre) units.push_back(i);
    return units;
}

TEST(CodexConsensus, UnlikenessIsADistance) {
    const Codex codex = codex_of(4);
    const auto units = units_of_centre(codex, id("t"));
    ASSERT_GT(units.size(), 5u);
    for (const auto a : units) {
        const PhoneContext at = context_of(codex, codex.units[static_cast<std::size_t>(a)]);
        EXPECT_EQ(unlikeness(at, at), 0);
        for (const auto b : units) {
            const PhoneContext bt = context_of(codex, codex.units[static_cast<std::size_t>(b)]);
            EXPECT_NEAR(unlikeness(at, bt), unlikeness(bt, at), 1e-12);
            for (const auto c : units) {
                const PhoneContext ct = context_of(codex, codex.units[static_cast<std::size_t>(c)]);
                EXPECT_LE(unlikeness(at, bt), unlikeness(at, ct) + unlikeness(ct, bt) + 1e-12);
            }
        }
    }
}

TEST(CodexConsensus, WeightsSumToOneAndLeaveAUnitItsOwnContextWhereNothingScatters) {
    const Codex codex = codex_of(4);
    for (const auto unit : units_of_centre(codex, id("s"))) {
        const AlikeUnits alike =
            alike_units(codex, id("s"), context_of(codex, codex.units[static_cast<std::size_t>(unit)]));
        ASSERT_GT(alike.units.size(), 5u);
        EXPECT_EQ(alike.units.front(), unit);
        for (const double scatter : kScatters)
            EXPECT_NEAR(kriging_weights(alike, scatter).sum(), 1, 1e-9) << scatter;
        EXPECT_NEAR(kriging_weights(alike, 0)[0], 1, 1e-4);
        const Eigen::VectorXd equal = kriging_weights(alike, 1e5);
        EXPECT_LT(equal.maxCoeff() - equal.minCoeff(), 1e-3);
    }
}

// The weights are the minimum of the expected error, 2 w.gamma(asked) - w' gamma w, among those of sum 1.
TEST(CodexConsensus, NoOtherWeightsOfSumOneExpectASmallerError) {
    const Codex codex = codex_of(4);
    PhoneContext asked =
        context_of(codex, codex.units[static_cast<std::size_t>(units_of_centre(codex, id("l")).front())]);
    asked.left = id("uw");
    asked.duration_s = 0.1;
    const AlikeUnits alike = alike_units(codex, id("l"), asked);
    const auto n = alike.to_asked.size();
    constexpr double kScatter = 0.7;
    Eigen::MatrixXd gamma = (alike.between.array() + kScatter).matrix();
    gamma.diagonal().setZero();
    const auto expected = [&](const Eigen::VectorXd& w) {
        return 2 * w.dot((alike.to_asked.array() + kScatter).matrix()) - w.dot(gamma * w);
    };
    const Eigen::VectorXd best = kriging_weights(alike, kScatter);
    Random random(3);
    for (int trial = 0; trial < 50; ++trial) {
        Eigen::VectorXd other(n);
        for (double& value : other) value = random.uniform(-0.1, 0.1);
        other.array() -= other.mean();
        EXPECT_GT(expected(best + other), expected(best));
    }
}

TEST(CodexConsensus, EqualRecitationsAreSpokenAsOneOfThem) {
    std::vector<Said> each_phone_once{{kPause, 0.3}};
    for (const PhoneId phone : phone_set()) each_phone_once.push_back({phone, 0.1});
    each_phone_once.push_back({kPause, 0.3});
    const PhoneSequence phones = sequence(each_phone_once);
    const Recitation once = recitation_of(phones);
    const RowMatrix alone = spoken(codex_of_recitations({once}), phones);
    for (const double scatter : kScatters) {
        const RowMatrix together = spoken(codex_of_recitations({once, once, once}, scatter), phones);
        EXPECT_LT((together - alone).cwiseAbs().maxCoeff(), 1e-6) << scatter;
    }
    EXPECT_EQ(with_scatter(codex_of_recitations({once, once, once})).scatter_mm, 0);
}

TEST(CodexConsensus, NoisyCopiesComeNearerToTheTruthThanAnyOfThem) {
    constexpr int kCopies = 8;
    const PhoneSequence phones = random_sentence(6, 20);
    const Recitation clean = recitation_of(phones);
    const RowMatrix truth = spoken(codex_of_recitations({clean}), phones);
    std::vector<Recitation> copies;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::uint64_t seed = 0; seed < kCopies; ++seed) {
        copies.push_back(with_noise(clean, seed, 6));
        nearest = std::min(nearest, (spoken(codex_of_recitations({copies.back()}), phones) - truth).norm());
    }
    const Codex together = with_scatter(codex_of_recitations(copies));
    EXPECT_LT((spoken(together, phones) - truth).norm(), 0.6 * nearest);
    EXPECT_EQ(spoken(together, phones), spoken(with_scatter(codex_of_recitations(copies)), phones));
}

TEST(CodexConsensus, ScatterIsFoundWhereThereIsNoiseAndNotWhereThereIsNone) {
    std::vector<Recitation> clean, noisy;
    for (std::uint64_t i = 0; i < 12; ++i) {
        clean.push_back(recitation_of(random_sentence(i, 20)));
        noisy.push_back(with_noise(clean.back(), i, 12));
    }
    EXPECT_LT(*with_scatter(codex_of_recitations(clean)).scatter_mm,
              *with_scatter(codex_of_recitations(noisy)).scatter_mm);
    EXPECT_EQ(with_scatter(codex_of_recitations({noisy.front()})).scatter_mm, 0);
}

// Closures at another place in their phone are as deep together as each is.
TEST(CodexConsensus, ClosuresMeetAtTheirNuclei) {
    const PhoneSequence phones =
        sequence({{kPause, 0.3}, {id("aa"), 0.12}, {id("p"), 0.1}, {id("aa"), 0.12}, {kPause, 0.3}});
    std::vector<Recitation> recitations(2, recitation_of(phones));
    for (int r = 0; r < 2; ++r) {
        RecitedPhone& closure = recitations[static_cast<std::size_t>(r)][2];
        closure.via = {0.1, r == 0 ? 0.3 : 0.7, 0.9};
        closure.points = RowMatrix::Zero(3, kModes);
        closure.points(1, 0) = -9;
        closure.nucleus = 1;
    }
    const Codex codex = codex_of_recitations(recitations, 1.0);
    const PhoneSlot slot = slots_of(phones)[2];
    const AlikeUnits alike = alike_units(codex, id("p"), context_of(slot, kRate));
    ASSERT_EQ(alike.units.size(), 2u);
    const RowMatrix agreed = agreed_motion(codex, alike, kriging_weights(alike, 1), {{0.5}, 0.5, 0.1});
    EXPECT_NEAR(agreed(0, 0), -9, 1e-9);
}

// A film that catches no closure: p is spoken with lips that press each other, by the least change.
TEST(CodexConsensus, BilabialsCloseThoughNoRecordingDoes) {
    const PhoneSequence phones =
        sequence({{kPause, 0.3}, {id("aa"), 0.12}, {id("p"), 0.1}, {id("aa"), 0.12}, {kPause, 0.3}});
    Recitation open = recitation_of(phones);
    const Eigen::RowVectorXd apart = lip_rows(lip_basis())->apart;
    for (RecitedPhone& phone : open) {
        for (auto via : phone.points.rowwise())
            via += apart * (std::max(0.0, 3 - apart.dot(via)) / apart.squaredNorm());
    }
    const Codex codex = codex_of_recitations({open, open}, 1.0);
    EXPECT_LT((spoken(codex, phones) * apart.transpose()).middleRows(42, 10).minCoeff(), -0.9 * kPressedLips);
    const Eigen::RowVectorXd wide = open[1].points.row(0), closed = with_lips_together(codex, wide);
    EXPECT_NEAR(apart.dot(closed), -kPressedLips, 1e-9);
    EXPECT_NEAR((wide - closed).norm(), (apart.dot(wide) + kPressedLips) / apart.norm(), 1e-9);
    EXPECT_EQ(with_lips_together(codex, -3 * wide), -3 * wide);
}

TEST(CodexConsensus, WithoutAScatterTheChosenUnitsSpeak) {
    const Codex codex = codex_of(4);
    EXPECT_TRUE(codex.motions.empty());
    EXPECT_THROW(agreed_motion(codex, {}, {}, {}), std::invalid_argument);
    for (const double wrong : {-0.1, 1001.0, std::nan("")})
        EXPECT_THROW(codex_of_recitations(codex.recitations, wrong), std::invalid_argument) << wrong;
}

}  // namespace
}  // namespace viaface

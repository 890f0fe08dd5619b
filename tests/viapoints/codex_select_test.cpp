#include "viapoints/codex_select.hpp"

#include <gtest/gtest.h>

#include "tests/viapoints/recited.hpp"
#include "viapoints/codex_speak.hpp"

namespace viaface {
namespace {

using namespace recited;

// The cheapest of all paths, tried one by one.
double cheapest_of_all(const Codex& codex, const std::vector<std::vector<Candidate>>& columns, std::size_t at,
                       const Candidate* before) {
    if (at == columns.size()) return 0;
    double best = std::numeric_limits<double>::infinity();
    for (const Candidate& c : columns[at]) {
        const double step = c.cost + (before ? join_cost(codex, *before, c) : 0);
        best = std::min(best, step + cheapest_of_all(codex, columns, at + 1, &c));
    }
    return best;
}

Codex codex_saying(const std::vector<PhoneSequence>& sentences) {
    std::vector<Recitation> recitations;
    for (const PhoneSequence& phones : sentences)
        recitations.push_back(cut_recitation(lip_basis(), take_of(phones)).recitation);
    return make_codex(lip_basis(), Eigen::VectorXd::Zero(kModes), recitations, "");
}

PhoneSequence word(std::initializer_list<std::string_view> names) {
    std::vector<Said> said{{kPause, 0.3}};
    for (const auto name : names) said.push_back({id(name), 0.1});
    said.push_back({kPause, 0.3});
    return sequence(said);
}

std::vector<UnitLevel> levels_of(const Codex& codex, const PhoneSequence& phones) {
    std::vector<UnitLevel> levels;
    for (const Candidate& c : select_units(codex, phones).units) levels.push_back(c.level);
    return levels;
}

TEST(CodexSelect, ViterbiFindsTheCheapestOfAllPaths) {
    const Codex codex = codex_of(40);
    int choices = 0;
    for (std::uint64_t sentence = 2000; sentence < 2020; ++sentence) {
        const PhoneSequence phones = random_sentence(sentence, 3);
        std::vector<std::vector<Candidate>> columns;
        std::size_t paths = 1;
        for (const PhoneSlot& slot : slots_of(phones)) {
            columns.push_back(candidates_of(codex, slot, kRate));
            paths *= columns.back().size();
        }
        if (paths > 200000) continue;
        choices += paths > 100;
        const Selection selection = select_units(codex, phones);
        EXPECT_NEAR(selection.cost, cheapest_of_all(codex, columns, 0, nullptr), 1e-9);
        double along = 0;
        for (std::size_t i = 0; i < selection.units.size(); ++i) {
            along += selection.units[i].cost;
            if (i > 0) along += join_cost(codex, selection.units[i - 1], selection.units[i]);
        }
        EXPECT_NEAR(selection.cost, along, 1e-9);
    }
    EXPECT_GT(choices, 5);
}

TEST(CodexSelect, EachLevelIsUsedWhereTheOneBeforeIsMissing) {
    using enum UnitLevel;
    // s-aa+t is recited; s-aa+d is of its class; s-aa+p has to be made of s-aa+... and ...-aa+p.
    const Codex codex = codex_saying(
        {word({"s", "aa", "t"}), word({"m", "aa", "p"}), word({"m", "aa", "d"}), word({"iy", "p", "iy"})});
    EXPECT_EQ(levels_of(codex, word({"s", "aa", "t"})), (std::vector<UnitLevel>(5, kExact)));
    const auto of_class = levels_of(codex, word({"s", "aa", "d"}));
    EXPECT_EQ(of_class[2], kClass);
    const auto half = levels_of(codex, word({"s", "aa", "p"}));
    EXPECT_EQ(half[2], kHalf);
    const Selection selection = select_units(codex, word({"s", "aa", "p"}));
    const Candidate& aa = selection.units[2];
    const TriphoneUnit &left = codex.units[static_cast<std::size_t>(aa.left)],
                       &right = codex.units[static_cast<std::size_t>(aa.right)];
    EXPECT_EQ(left.centre, id("aa"));
    EXPECT_EQ(right.centre, id("aa"));
    EXPECT_EQ(left.left, id("s"));
    EXPECT_EQ(right.right, id("p"));
    const int sum =
        selection.phones_at_level[0] + selection.phones_at_level[1] + selection.phones_at_level[2];
    EXPECT_EQ(sum, 5);
}

TEST(CodexSelect, PhonesNeverRecitedHaveStandIns) {
    const Codex codex = codex_saying({word({"s", "aa", "t"}), word({"t", "iy", "s"})});
    const auto centre_for = [&](std::string_view wanted) {
        const Selection selection = select_units(codex, word({"s", wanted, "t"}));
        EXPECT_EQ(selection.units[2].level, UnitLevel::kHalf) << wanted;
        return phone_info(codex.units[static_cast<std::size_t>(selection.units[2].left)].centre);
    };
    EXPECT_EQ(centre_for("d").viseme, phone_info(id("d")).viseme);  // one of its class was recited
    EXPECT_EQ(centre_for("d").name, "t");
    EXPECT_TRUE(centre_for("uw").vowel);  // no other rounded vowel was
    EXPECT_FALSE(centre_for("m").vowel);
    EXPECT_NE(centre_for("m").viseme, VisemeClass::kPause);
}

TEST(CodexSelect, AnyContextServesWhereNoneOfTheClassWasRecited) {
    const Codex codex = codex_saying({word({"s", "aa", "t"}), word({"m", "iy", "m"})});
    const Selection selection = select_units(codex, word({"m", "aa", "m"}));
    EXPECT_EQ(selection.units[2].level, UnitLevel::kHalf);
    EXPECT_EQ(codex.units[static_cast<std::size_t>(selection.units[2].left)].centre, id("aa"));
}

TEST(CodexSelect, WhatCannotBeMadeIsNamed) {
    const Codex codex = codex_saying({word({"s", "t"}), word({"m"})});
    try {
        select_units(codex, word({"s", "aa", "t"}));
        ADD_FAILURE();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("s-aa+t"), std::string::npos) << error.what();
    }
}

TEST(CodexSelect, CandidatesAreBoundedAndTheCheapest) {
    const Codex codex = codex_of(60);
    PhoneSlot slot;
    slot.centre = id("aa");
    slot.left = slot.left2 = id("s");
    slot.right = slot.right2 = id("t");
    slot.stress = 1;
    slot.end = kRate / 10;
    for (const PhoneId right : {id("t"), id("d"), id("p")}) {
        slot.right = right;
        const auto found = candidates_of(codex, slot, kRate);
        EXPECT_LE(found.size(), kMaxCandidates);
        for (std::size_t i = 1; i < found.size(); ++i) EXPECT_LE(found[i - 1].cost, found[i].cost);
    }
}

TEST(CodexSelect, DurationAndStressDecideBetweenEqualContexts) {
    const auto with_aa = [](double seconds) {
        return sequence({{kPause, 0.3}, {id("s"), 0.1}, {id("aa"), seconds}, {id("t"), 0.1}, {kPause, 0.3}});
    };
    const Codex codex = codex_saying({with_aa(0.06), with_aa(0.12), with_aa(0.24)});
    for (const int recited : {0, 1, 2}) {
        PhoneSlot slot = slots_of(with_aa(0.06 * (1 << recited) * 1.1))[2];
        EXPECT_EQ(codex.units[static_cast<std::size_t>(candidates_of(codex, slot, kRate)[0].left)].recitation,
                  recited);
        slot.stress = 0;
        EXPECT_NEAR(candidates_of(codex, slot, kRate)[0].cost, std::log2(1.1) + SelectionCosts{}.stress,
                    0.01);
    }
}

// A bilabial made of two halves is still pressed: its nuclei meet, they are not dropped.
TEST(CodexSelect, HalvesKeepTheClosure) {
    const Codex codex = codex_saying({word({"s", "m", "aa"}), word({"iy", "m", "uw"}), word({"s", "aa", "t"}),
                                      word({"t", "iy", "s"}), word({"s", "uw", "t"})});
    const PhoneSequence phones = word({"s", "m", "uw"});
    const Selection selection = select_units(codex, phones);
    ASSERT_EQ(selection.units[2].level, UnitLevel::kHalf);
    const ViaPointTrack track = speak(codex, phones, selection);
    double deepest = 1e9, at = 0;
    for (std::size_t i = 0; i < track.time_s.size(); ++i) {
        const double here = track.points(static_cast<Eigen::Index>(i), 0);
        if (here < deepest) std::tie(deepest, at) = std::pair(here, track.time_s[i]);
    }
    EXPECT_LT(deepest, -8);
    EXPECT_TRUE(at > phones.begin_s(2) && at < phones.end_s(2)) << at;
}

}  // namespace
}  // namespace viaface

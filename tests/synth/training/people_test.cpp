#include "synth/training/people.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "base/error.hpp"
#include "synth/speech/flite_voice.hpp"
#include "synth/training/performance.hpp"
#include "tests/synth/training/scans.hpp"
#include "tests/synth/training/spoken.hpp"

namespace viaface {
namespace {

// Those who are not momo.
std::vector<Person> others() { return {people().begin() + 1, people().end()}; }

const BlendHead& head_of(const Person& person) {
    static std::map<std::string, BlendHead> heads;
    return heads.try_emplace(person.name, test::scans_folder(), person.identity).first->second;
}

double rest_gap(const BlendHead& head) {
    const Configuration rest = head.points(head.neutral().nodes);
    return point_of(rest, kInnerTop).y() - point_of(rest, kInnerBottom).y();
}

TEST(People, HaveNamesAndVoicesThatExist) {
    std::set<std::string> names;
    for (const Person& person : people()) {
        names.insert(person.name);
        EXPECT_NO_THROW(FliteVoice{person.voice}) << person.name;
        EXPECT_EQ(&person_named(person.name), &person);
    }
    EXPECT_EQ(names.size(), people().size());
    EXPECT_THROW(person_named("nobody"), InputError);
}

TEST(People, MomoIsTheHeadAsItIs) {
    SKIP_WITHOUT_SCANS();
    EXPECT_EQ(people().front().name, "momo");
    EXPECT_TRUE(people().front().identity.empty());
    EXPECT_EQ(test::blend_head().neutral().nodes, test::blend_head().generic());
}

// What lips do is asked for in mm from rest: they must rest as far apart as momo's, before the same teeth.
TEST(People, RestWithTheirLipsMetBeforeTheSameTeeth) {
    SKIP_WITHOUT_SCANS();
    const BlendHead& nobody = test::blend_head();
    for (const Person& person : others()) {
        const BlendHead& head = head_of(person);
        EXPECT_NEAR(rest_gap(head), rest_gap(nobody), 0.15) << person.name;
        const auto teeth = [](const Nodes& nodes) {
            return nodes.middleRows(BlendHead::kUpperTeeth.first,
                                    BlendHead::kLowerTeeth.last - BlendHead::kUpperTeeth.first);
        };
        EXPECT_EQ(teeth(head.neutral().nodes), teeth(nobody.generic())) << person.name;
        EXPECT_EQ(head.generic(), nobody.generic()) << person.name;
    }
}

// A shape moves everyone's nodes alike, and two people differ by several mm.
TEST(People, AreShapedByTheirIdentity) {
    SKIP_WITHOUT_SCANS();
    const BlendHead& nobody = test::blend_head();
    const Nodes open = nobody.pose({{"jawOpen", 1}}) - nobody.neutral().nodes;
    std::vector<Nodes> faces = {nobody.neutral().nodes};
    for (const Person& person : others()) {
        const BlendHead& head = head_of(person);
        const Nodes own = head.pose({{"jawOpen", 1}}) - head.neutral().nodes;
        EXPECT_LT((own - open).cwiseAbs().maxCoeff(), 1e-9) << person.name;
        for (const Nodes& other : faces) {
            const auto apart = (head.neutral().nodes - other).topRows(BlendHead::kFace.last).rowwise().norm();
            EXPECT_GT(apart.mean(), 2) << person.name;
        }
        faces.push_back(head.neutral().nodes);
    }
}

// So that momo's recitations serve everyone from their own rest.
TEST(People, AreMovedByThePerformanceAsMomoIs) {
    SKIP_WITHOUT_SCANS();
    const Performer momo(test::blend_head());
    const ChannelMotion motion =
        gesture(testing::spoken("pau:200 b:80 aa1:140 f:90 uw1:140 m:80 iy1:140 pau:200"));
    for (const Person& person : others()) {
        const Performer performer(head_of(person));
        for (Eigen::Index k = 0; k < motion.channels.rows(); ++k) {
            const Performer::Channels channels = motion.channels.row(k).transpose();
            const Configuration own = performer.configuration(channels) - performer.rest(),
                                his = momo.configuration(channels) - momo.rest();
            EXPECT_LT((own - his).cwiseAbs().maxCoeff(), 0.1) << person.name << " " << k;
        }
    }
}

}  // namespace
}  // namespace viaface

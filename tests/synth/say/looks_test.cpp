// What must not look wrong on the built-in talkers, as measures of what is drawn.
#include <gtest/gtest.h>

#include <algorithm>

#include "synth/say/sheet.hpp"
#include "synth/talker/talker.hpp"
#include "synth/training/collar.hpp"

namespace viaface {
namespace {

using Eigen::Vector3d;

class BuiltInLooks : public testing::TestWithParam<const char*> {
  protected:
    static Talker talker() {
        return load_talker(std::filesystem::path(VIAFACE_SOURCE_DIR) / "talkers" / GetParam());
    }
};

Nodes at_rest(const Talker& talker, double shut = 0, const Gaze& gaze = {}) {
    return talker.poser.posed(points_in_phone(talker.codex, "ax", "pau"), {shut, shut}, gaze);
}

template <class Places>
Places of(const Places& nodes, const FacePart& part) {
    return nodes.middleRows(part.first_node, part.nodes);
}

// A gap that is drawn would show the teeth as a glint.
TEST_P(BuiltInLooks, LipsAreTogetherAtRest) {
    const Talker talker = this->talker();
    for (const double gap : talker.poser.drawn_gaps(at_rest(talker))) EXPECT_LT(gap, 0.02);
}

// In th the tongue passes the upper incisors' edge and lies between the two rows.
TEST_P(BuiltInLooks, TheTongueComesBetweenTheTeethInTh) {
    const Talker talker = this->talker();
    const Nodes posed = talker.poser.posed(points_in_phone(talker.codex, "aa1:150 th:200 aa1:150", "th"));
    const auto incisors_edge = [&](const char* name, double side) {
        const auto teeth = of(posed, part_named(talker.face, name));
        Vector3d edge(0, 1e9 * side, 0);
        for (Eigen::Index i = 0; i < teeth.rows(); ++i) {
            const Vector3d node = teeth.row(i);
            if (std::abs(node.x()) < 6 && side * node.y() < side * edge.y()) edge = node;
        }
        return edge;
    };
    const Vector3d upper = incisors_edge("teeth_upper", 1), lower = incisors_edge("teeth_lower", -1);
    const auto tongue = of(posed, part_named(talker.face, "tongue"));
    Eigen::Index tip = 0;
    tongue.col(2).maxCoeff(&tip);
    EXPECT_GT(tongue(tip, 2), upper.z() + 1);
    EXPECT_LT(tongue(tip, 1), upper.y() + 0.5);
    EXPECT_GT(tongue(tip, 1), lower.y() - 0.5);
}

TEST_P(BuiltInLooks, LashesRiseOverAnOpenEyeAndHangFromAShutOne) {
    const Talker talker = this->talker();
    for (const char* name : {"lashes_upper_left", "lashes_upper_right"}) {
        const FacePart& lashes = part_named(talker.face, name);
        const auto rise = [&](double shut) {
            const Nodes posed = at_rest(talker, shut);
            const auto rows = of(posed, lashes);
            const Eigen::Index across = rows.rows() / 4;
            return rows.bottomRows(across).col(1).mean() - rows.topRows(across).col(1).mean();
        };
        EXPECT_GT(rise(0), 1) << name;
        EXPECT_LT(rise(1), -1) << name;
    }
}

// What the lids hide at rest comes into sight when the eye turns.
TEST_P(BuiltInLooks, NoPartOfAnEyeIsBlackForWantOfLight) {
    const Texture light = talker().face.surfaces[std::size_t(Material::kEye)].occlusion_roughness;
    int darkest = 255;
    for (std::size_t i = 0; i < light.pixels.size(); i += 3)
        darkest = std::min<int>(darkest, light.pixels[i]);
    EXPECT_GT(darkest, 0.15 * 255);
}

// Textures repeat, so that a lip at their rim would wear a line of the other lip's colour.
TEST_P(BuiltInLooks, LipsKeepOffTheRimOfTheirTexture) {
    const Face face = talker().face;
    const FacePart& lips = part_named(face, "lips");
    const auto places = face.uvs.middleRows(lips.first_node, lips.nodes);
    const float texel =
        1.0f / static_cast<float>(face.surfaces[std::size_t(Material::kLips)].base_colour.width);
    EXPECT_GT(places.minCoeff(), 8 * texel);
    EXPECT_LT(places.maxCoeff(), 1 - 8 * texel);
}

// Longest of the edges that are chosen, mm.
template <class Chosen>
double longest_edge(const FacePart& part, const Nodes& rest, Chosen chosen) {
    double longest = 0;
    for (const Triangle& t : part.triangles) {
        for (int k = 0; k < 3; ++k) {
            const Vector3d a = rest.row(t[k]), b = rest.row(t[(k + 1) % 3]);
            if (chosen(a, b)) longest = std::max(longest, (b - a).norm());
        }
    }
    return longest;
}

// Round a neck of 60 mm a chord of 11 mm leaves the circle by 0.25 mm, a pixel of a picture of 1200.
TEST(MomoLooks, TheCollarIsRound) {
    const Face face = load_talker(std::filesystem::path(VIAFACE_SOURCE_DIR) / "talkers/momo").face;
    const auto crosses = [](const Vector3d& a, const Vector3d& b) {
        return (above_collar(a) < 0) != (above_collar(b) < 0);
    };
    for (const char* name : {"skin", "head_back"})
        EXPECT_LT(longest_edge(part_named(face, name), face.rest, crosses), 11) << name;
}

// The bowl of an ear and its lobe are some 15 mm wide.
TEST(MomoLooks, EarsAreMeshedFinely) {
    const Face face = load_talker(std::filesystem::path(VIAFACE_SOURCE_DIR) / "talkers/momo").face;
    const auto on_ear = [](const Vector3d& p) {
        return std::abs(p.x()) > 70 && p.y() > 4 && p.y() < 78 && p.z() < -94 && p.z() > -112;
    };
    EXPECT_LT(longest_edge(part_named(face, "skin"), face.rest,
                           [&](const Vector3d& a, const Vector3d& b) { return on_ear(a) && on_ear(b); }),
              8);
}

INSTANTIATE_TEST_SUITE_P(Talkers, BuiltInLooks, testing::Values("momo", "amara", "edwin", "sumi"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace viaface

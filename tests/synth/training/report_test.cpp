#include "synth/training/report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "facemodel/triangulation.hpp"
#include "scans.hpp"

namespace viaface {
namespace {

const UnseenFigures& named(const std::vector<UnseenFigures>& all, const std::string& name) {
    const auto found = std::ranges::find(all, name, &UnseenFigures::posture);
    if (found == all.end()) throw std::invalid_argument(name);
    return *found;
}

TEST(Distances, AreThoseOfTheValues) {
    std::vector<double> values;
    for (int i = 100; i >= 0; --i) values.push_back(i);
    const Distances d = distances(values);
    EXPECT_EQ(d.mean, 50);
    EXPECT_DOUBLE_EQ(d.rms, std::sqrt(3350.0));  // mean of i^2, 0 to 100: 100 * 201 / 6
    EXPECT_EQ(d.p95, 95);
    EXPECT_EQ(d.max, 100);
    EXPECT_THROW(distances({}), std::invalid_argument);
}

TEST(FaceScan, TheMeshFitsWithoutFoldsAndTheSameEveryTime) {
    SKIP_WITHOUT_SCANS();
    const GenericMesh mesh = generic_mesh();
    const FittedPosture once = fit(test::blend_head(), mesh, posture("mouth_open"));
    const FittedPosture again = fit(test::blend_head(), mesh, posture("mouth_open"));
    EXPECT_EQ(once.face.nodes, again.face.nodes);
    for (const Triangle& t : triangles_of(mesh.polygons)) {
        EXPECT_GT(turn(once.face.flat.row(t[0]), once.face.flat.row(t[1]), once.face.flat.row(t[2])), 0);
    }
}

void has_the_reports_counts_and_variance(const AtrReport& report) {
    EXPECT_EQ(report.nodes, 576);
    EXPECT_EQ(report.polygons, 844);
    EXPECT_EQ(report.eight.components, 7);
    EXPECT_GT(report.eight.share.head(5).sum(), 0.99);
    EXPECT_NEAR(report.eight.share.sum(), 1, 1e-9);
    EXPECT_NEAR(report.talker.share.sum(), 1, 1e-9);
}

// A scan sample is 0.56 x 0.54 mm; a marker lies within half a sample of four of them on a smooth surface.
void the_mesh_lies_on_the_scan_and_its_markers_in_their_places(const AtrReport& report) {
    ASSERT_EQ(report.fit.size(), 8u);
    for (const FitFigures& f : report.fit) {
        EXPECT_LT(f.surface.mean, 0.4) << f.posture;
        EXPECT_LT(f.surface.p95, 1.0) << f.posture;
        EXPECT_LT(f.markers.max, 0.3) << f.posture;
        EXPECT_GT(f.surface.max, f.surface.p95) << f.posture;
    }
}

// Eq. 12 by pseudo-inverse returns what it was trained on; round-off times the condition number.
void the_eight_postures_are_drawn_from_their_own_markers(const AtrReport& report) {
    EXPECT_LT(report.eight.trained_max, 1e-10 * report.eight.condition);
    EXPECT_LT(report.talker.trained_max, 2);  // a ridge gives up a little of it
    for (const UnseenFigures& u : report.talker.left_out) EXPECT_LT(u.drawn.max, report.talker_unridged_max);
}

// What the markers draw is in the span, so never nearer than the span's nearest: least squares over the
// nodes.
void nothing_is_drawn_nearer_than_the_span(const AtrReport& report) {
    ASSERT_EQ(report.eight.left_out.size(), 8u);
    ASSERT_EQ(report.talker.left_out.size(), talker_postures().size());
    for (const auto* all : {&report.eight.left_out, &report.eight.unseen, &report.talker.left_out,
                            &report.talker.unseen, &report.beyond_eight}) {
        for (const UnseenFigures& u : *all) EXPECT_LE(u.span.rms, u.drawn.rms * (1 + 1e-9)) << u.posture;
    }
}

void eight_postures_cannot_press_or_tuck_the_talkers_can(const AtrReport& report) {
    EXPECT_GT(named(report.beyond_eight, "f").points.max, 3);
    EXPECT_GT(named(report.beyond_eight, "m_pressed").span.max, 2);
    for (const char* name : {"p within /a/", "v within /u/"}) {
        EXPECT_LT(named(report.talker.unseen, name).lips.max, 0.5) << name;
        EXPECT_GT(named(report.eight.unseen, name).lips.max, 1.5) << name;
        EXPECT_LT(named(report.talker.unseen, name).points.max, 1e-9) << name;
    }
}

void the_text_names_every_posture_and_the_reports_figures(const AtrReport& report) {
    const std::string text = as_text(report);
    for (const Posture& p : talker_postures())
        EXPECT_NE(text.find("  " + p.name), std::string::npos) << p.name;
    for (const char* figure : {"576", "844", "over 99%", "the report"}) {
        EXPECT_NE(text.find(figure), std::string::npos) << figure;
    }
    EXPECT_EQ(text.find("nan"), std::string::npos);
}

// One measurement, some seconds long, for all of them.
TEST(AtrReport, StandsBesideTheReport) {
    SKIP_WITHOUT_SCANS();
    const AtrReport report = measure_atr(test::blend_head());
    has_the_reports_counts_and_variance(report);
    the_mesh_lies_on_the_scan_and_its_markers_in_their_places(report);
    the_eight_postures_are_drawn_from_their_own_markers(report);
    nothing_is_drawn_nearer_than_the_span(report);
    eight_postures_cannot_press_or_tuck_the_talkers_can(report);
    the_text_names_every_posture_and_the_reports_figures(report);
}

}  // namespace
}  // namespace viaface

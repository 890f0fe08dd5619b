// The lips of one sentence, drawn three ways from the same points: by the linear estimator that draws them,
// through the elastic mesh of the lip model, and through its ten modes. All are then kept off the teeth and
// off each other in the same way.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "lipmodel/lip_body.hpp"
#include "synth/lips/learned_lips.hpp"
#include "synth/pose/inside.hpp"
#include "synth/pose/teeth_front.hpp"
#include "synth/say/recital.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;

constexpr double kFps = 30;
constexpr int kColumns = LipGrid::kColumns;
constexpr const char* kSentence = "Bob and Mavis move five big maps of Paris for a very brave boy.";

struct Elastic {
    LipFrames frames;
    LipBody body;
    LipModel model;

    explicit Elastic(const Talker& talker)
        : frames(recited_lip_frames(talker)),
          body(lip_body(resting_lips(frames))),
          model(learn_lips(body, frames.points, {.modes = 10})) {}

    // How far the nodes have moved [204 x 3], mm.
    Nodes moved(const Configuration& c, bool through_modes) const {
        const MarkedPoints goal =
            c.segment<LipMesh::kMarkedCoordinates>(3 * kFirstLipPoint) - resting_lips(frames);
        const Eigen::VectorXd rest = as_column(body.mesh.nodes), shape = rest + body.spread * goal;
        return as_lip_nodes((through_modes ? lip_shape(model, lip_modes_of(model, shape)) : shape) - rest);
    }
};

// The lips' middle and inner contours as moved: 32 columns of the elastic mesh to 40 of the face.
LipContours contours_of(const LipContours& rest, const Contour& outer, const Nodes& moved) {
    LipContours made = rest;
    made.outer = outer;
    for (int k = 0; k < kColumns; ++k) {
        const double column = static_cast<double>(k) * LipMesh::kColumns / kColumns;
        const int left = static_cast<int>(column);
        const auto ring = [&](int r) -> Eigen::RowVector3d {
            return (left + 1 - column) * moved.row(LipMesh::node(r, left)) +
                   (column - left) * moved.row(LipMesh::node(r, left + 1));
        };
        made.middle.row(k) += 0.5 * (ring(LipMesh::kBorderRing + 1) + ring(LipMesh::kBorderRing + 2));
        made.inner.row(k) += ring(LipMesh::kInnerRing);
    }
    return made;
}

struct Figures {
    double squares = 0, gap = 0, to_edge = 0, deepest = 0;  // mm
    int points = 0;

    double rms() const { return std::sqrt(squares / points); }
};

// From the inner contour, as a chain of straight pieces.
double from_contour(const Eigen::RowVector3d& point, const Nodes& rows) {
    constexpr int kFirst = (LipGrid::kRows - 1) * kColumns;
    double least = 1e9;
    for (int k = 0; k < kColumns; ++k) {
        const Eigen::RowVector3d from = rows.row(kFirst + k),
                                 way = rows.row(kFirst + (k + 1) % kColumns) - from;
        const double along = std::clamp((point - from).dot(way) / way.squaredNorm(), 0.0, 1.0);
        least = std::min(least, (point - from - along * way).norm());
    }
    return least;
}

// The lower lip's middle from the upper incisors' edge.
double from_edge(const Nodes& rows, const TeethFront& upper) {
    double least = 1e9;
    for (int row = 0; row < LipGrid::kRows; ++row) {
        for (int k = kColumns / 2 - 5; k <= kColumns / 2 + 5; ++k) {
            const Eigen::RowVector3d node = rows.row(row * kColumns + k);
            least = std::min(least, std::hypot(node.y() - upper.edge_y,
                                               std::max(0.0, std::abs(node.z() - upper.z(node.x())) - 2)));
        }
    }
    return least;
}

class DrawnLips : public testing::TestWithParam<const char*> {
  protected:
    DrawnLips()
        : talker_(load_talker(fs::path(VIAFACE_TALKERS_FOLDER) / GetParam())),
          elastic_(talker_),
          rest_points_(talker_.poser.drawn_points(talker_.face.rest)),
          rest_(talker_.poser.lip_shape(rest_points_, talker_.poser.face_pose(rest_points_)).contours),
          upper_(teeth_front(talker_.face.rest, part_named(talker_.face, "teeth_upper"), +1)),
          lower_(teeth_front(talker_.face.rest, part_named(talker_.face, "teeth_lower"), -1)) {}

    Nodes in_contact(const LipContours& contours, const Configuration& c) const {
        Nodes rows = lip_rows(contours);
        keep_off_teeth(rows, upper_);
        keep_off_teeth(rows, moved_front(lower_, jaw_motion(talker_.face.jaw_hinge,
                                                            point_of(rest_points_, kLowerIncisor),
                                                            point_of(c, kLowerIncisor))));
        keep_lips_apart(rows);
        return rows;
    }

    // By the estimator, through the elastic mesh, through the modes.
    std::array<Nodes, 3> drawn(const Configuration& points) const {
        const Configuration c = talker_.poser.completed(points);
        const LipContours estimated = talker_.poser.lip_shape(c, talker_.poser.face_pose(c)).contours;
        return {in_contact(estimated, c),
                in_contact(contours_of(rest_, estimated.outer, elastic_.moved(c, false)), c),
                in_contact(contours_of(rest_, estimated.outer, elastic_.moved(c, true)), c)};
    }

    std::array<Figures, 3> figures() const;

    Talker talker_;
    Elastic elastic_;
    Configuration rest_points_;
    LipContours rest_;
    TeethFront upper_, lower_;
};

std::array<Figures, 3> DrawnLips::figures() const {
    SpeechRequest request;
    request.text = kSentence;
    const Recital recital = recite(talker_.codex, Script(request).utterance(0));
    const PhoneSequence& phones = recital.utterance.phones;
    std::array<Figures, 3> all;
    for (std::size_t i = 0; i < phones.phones.size(); ++i) {
        const VisemeClass viseme = phone_info(phones.phones[i].phone).viseme;
        std::array<double, 3> gap, edge;
        gap.fill(1e9);
        edge.fill(1e9);
        bool seen = false;
        for (int n = static_cast<int>(std::ceil(phones.begin_s(i) * kFps)); n <= phones.end_s(i) * kFps;
             ++n) {
            const Configuration c = recital.motion.at(n / kFps);
            const std::array<Nodes, 3> ways = drawn(c);
            seen = true;
            for (std::size_t way = 0; way < 3; ++way) {
                for (int p = kInnerTop; p < kInnerTop + 8; ++p) {
                    all[way].squares += std::pow(from_contour(point_of(c, p).transpose(), ways[way]), 2);
                    ++all[way].points;
                }
                double widest = 0;
                for (const int column : {0, kLeftCorner / 2, kColumns - kLeftCorner / 2}) {
                    widest = std::max(widest, lip_gap(ways[way], column));
                    all[way].deepest = std::max(all[way].deepest, -lip_gap(ways[way], column));
                }
                gap[way] = std::min(gap[way], widest);
                edge[way] = std::min(edge[way], from_edge(ways[way], upper_));
            }
        }
        for (std::size_t way = 0; seen && way < 3; ++way) {
            if (viseme == VisemeClass::kBilabial) all[way].gap = std::max(all[way].gap, gap[way]);
            if (viseme == VisemeClass::kLabiodental) all[way].to_edge = std::max(all[way].to_edge, edge[way]);
        }
    }
    return all;
}

TEST_P(DrawnLips, LieNearestToTheirPointsByTheEstimator) {
    const auto [estimator, elastic, modes] = figures();
    for (const auto& [name, f] :
         {std::pair("estimator", estimator), {"elastic mesh", elastic}, {"modes", modes}})
        std::printf(
            "%s, %s: inner points %.2f mm rms from the drawn contour, widest closure %.2f mm, farthest "
            "f or v %.2f mm, deepest crossing %.3f mm\n",
            GetParam(), name, f.rms(), f.gap, f.to_edge, f.deepest);
    EXPECT_LE(estimator.rms(), std::min(elastic.rms(), modes.rms()));
    EXPECT_LE(estimator.gap, 0.5);
    EXPECT_LE(estimator.gap, modes.gap + 0.05);
    for (const Figures& f : {estimator, elastic, modes}) EXPECT_LT(f.deepest, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(BuiltIn, DrawnLips, testing::Values("momo", "amara", "edwin", "sumi"));

}  // namespace
}  // namespace viaface

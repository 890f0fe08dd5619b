#include "synth/scans/own_postures.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "synth/pose/pose.hpp"
#include "synth/scans/borrowed_motion.hpp"
#include "synth/scans/fit_distances.hpp"
#include "tests/synth/scans/heads.hpp"

namespace viaface {
namespace {

using Eigen::Vector3d;

constexpr double kWider = 1.3;      // than the lender's
constexpr Eigen::Index kOpenA = 0;  // the lender's posture "a"

Nodes wide_a() { return other_head() + kWider * (momo().posture(kOpenA) - momo().face.rest); }

// As a scanner sees it: the head has nodded by 5 degrees and moved by 2 cm since the neutral scan.
Nodes nodded(const Nodes& nodes) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.087, Vector3d::UnitX()).toRotationMatrix();
    return (nodes * turn.transpose()).rowwise() + Eigen::RowVector3d(3, -20, 5);
}

PaintedSurface surface_of(const Nodes& nodes) { return scan_of(nodes).postures.at("neutral"); }

struct Fitted {
    AdaptedHead head;
    std::vector<OwnPosture> own;
    std::vector<std::string> remarks;
};

Fitted fitted_with(const std::string& name, const PaintedSurface& posture) {
    static const AdaptedHead neutral = adapt_head(momo(), scan_of(other_head()));
    ScanFolder scans = scan_of(other_head());
    scans.postures[name] = posture;
    Fitted result{neutral, {}, {}};
    result.own = own_postures(momo(), scans, result.head, result.remarks);
    return result;
}

// How far the fitted way from neutral to the posture is from the true one, on the seen skin and lips, mm.
FitDistances off(const Fitted& fitted, const Nodes& truth) {
    const auto seen = seen_nodes(momo().face.rest, momo().surface);
    const Eigen::VectorXd share = momo().face_share();
    std::vector<double> distances;
    for (Eigen::Index i = 0; i < truth.rows(); ++i) {
        if (share[i] < 0.9 || !seen[static_cast<std::size_t>(i)] ||
            !fitted.head.covered[static_cast<std::size_t>(i)])
            continue;
        const Vector3d way = fitted.own[0].nodes.row(i) - fitted.head.nodes.row(i),
                       wanted = (truth.row(i) - other_head().row(i)) * fitted.head.from_scan.scale / 1000;
        distances.push_back((way - wanted).norm());
    }
    return distances_of(std::move(distances));
}

Codex silent() {
    return make_codex({momo().training.rest, Eigen::MatrixXd::Identity(kCoordinates, 2)},
                      Eigen::VectorXd::Zero(2), {}, "nobody");
}

TEST(OwnPostures, AreCarriedNodeByNodeWhateverTheHeadDidBetweenScans) {
    const Fitted fitted = fitted_with("a", surface_of(nodded(wide_a())));
    ASSERT_EQ(fitted.own.size(), 1u) << fitted.remarks.back();
    // The brow of the posture moves by up to 0.1 mm, and the fitted head stands half a degree askew.
    EXPECT_LT(off(fitted, wide_a()).p95, 0.5);
}

TEST(OwnPostures, OfOtherTrianglesArePulledToTheirScan) {
    PaintedSurface posture = surface_of(nodded(wide_a()));
    posture.mesh = thinned(posture.mesh, 0.0015);
    const Fitted fitted = fitted_with("mouth wide", posture);
    ASSERT_EQ(fitted.own.size(), 1u) << fitted.remarks.back();
    // Along the surface nothing tells a node's place but smoothness.
    EXPECT_LT(off(fitted, wide_a()).p95, 2.5);
    EXPECT_LT(off(fitted, wide_a()).mean, 1.0);
}

TEST(OwnPostures, OfAnotherHeadAreLeftOut) {
    Nodes other = wide_a();
    for (Eigen::Index i = 0; i < other.rows(); ++i) {
        const double x = other(i, 0), y = other(i, 1);
        other(i, 2) += 14 * std::sin(x / 8) * std::exp(-(y - 85) * (y - 85) / 800);
    }
    const Fitted fitted = fitted_with("a", surface_of(other));
    EXPECT_TRUE(fitted.own.empty());
    EXPECT_NE(fitted.remarks.back().find("not used"), std::string::npos) << fitted.remarks.back();
}

TEST(BorrowedTalker, OpensAsItsOwnScanDoes) {
    const Fitted fitted = fitted_with("a", surface_of(wide_a()));
    const BorrowedTalker own = with_borrowed_motion(momo(), silent(), fitted.head.nodes, 1, fitted.own),
                         borrowed = with_borrowed_motion(momo(), silent(), fitted.head.nodes, 1);
    const auto gap = [&](const BorrowedTalker& talker) {
        const Poser poser(talker.face, talker.training);
        return poser.drawn_gaps(poser.posed(talker.training.configurations.col(kOpenA)))[0];
    };
    EXPECT_NEAR(gap(own) / gap(borrowed), kWider, 0.12);
    EXPECT_EQ(own.own, std::vector<std::string>{"a"});
    const auto jaw = [&](const BorrowedTalker& talker) {
        return point_of(talker.training.configurations.col(kOpenA), kLowerIncisor).y() -
               point_of(talker.training.rest, kLowerIncisor).y();
    };
    EXPECT_LT(jaw(own), jaw(borrowed) - 1);  // the teeth go with the chin
}

TEST(BorrowedTalker, HasScannedShapesAlsoInPosturesThatAreMixedOfThem) {
    const auto& shapes = momo().face.shapes;
    const auto jaw = std::ranges::find(shapes, "jawOpen", &NamedShape::name);
    ASSERT_NE(jaw, shapes.end());
    const Fitted fitted = fitted_with("jawOpen", surface_of(other_head() + kWider * jaw->delta));
    const BorrowedTalker own = with_borrowed_motion(momo(), silent(), fitted.head.nodes, 1, fitted.own),
                         borrowed = with_borrowed_motion(momo(), silent(), fitted.head.nodes, 1);
    const auto chin = [&](const PoseTraining& training) {
        return (point_of(training.configurations.col(kOpenA), kChin) - point_of(training.rest, kChin)).norm();
    };
    EXPECT_NEAR(chin(own.training) / chin(borrowed.training), kWider, 0.12);
    EXPECT_EQ(own.training.configurations.cols(), borrowed.training.configurations.cols());
}

}  // namespace
}  // namespace viaface

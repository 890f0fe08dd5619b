#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <fstream>

#include "base/error.hpp"
#include "synth/pose/pose.hpp"
#include "synth/scans/adaptation_to_scan.hpp"
#include "synth/scans/borrowed_motion.hpp"
#include "synth/scans/feature_pins.hpp"
#include "tests/synth/scans/heads.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

TEST(AdaptedHead, LiesOnAScanOfAnotherHeadInMetres) {
    const AdaptedHead head = adapt_head(momo(), scan_of(other_head()));
    EXPECT_EQ(head.unit, "m");
    EXPECT_LT(head.to_scan.p95, 0.7);
    EXPECT_LT(head.from_surface.mean, 0.5);
    EXPECT_EQ(head.flipped, 0);
    EXPECT_LT(std::abs(head.smile), kSmile);
}

TEST(AdaptedHead, RefusesAUnitInWhichNoHeadIs) {
    ScanFolder scans = scan_of(other_head());
    scans.mm_per_unit = 1;
    try {
        adapt_head(momo(), scans);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.field(), "units");
        EXPECT_EQ(error.allowed(), "m");
    }
}

ScanFolder mirror_image(ScanFolder scans) {
    scans.postures["neutral"].mesh.nodes.col(0) *= -1;
    for (auto& [name, place] : scans.landmarks) place.x() *= -1;
    scans.mirrored = true;
    return scans;
}

// The wider left half of a head comes back on the left.
TEST(AdaptedHead, OfAMirrorImageIsTheHead) {
    Nodes nodes = momo().face.rest;
    for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
        if (nodes(i, 0) > 0) nodes(i, 0) *= 1.1;
    }
    const ScanFolder scans = scan_of(nodes);
    const AdaptedHead straight = adapt_head(momo(), scans), back = adapt_head(momo(), mirror_image(scans));
    EXPECT_LT((straight.nodes - back.nodes).rowwise().norm().mean(), 0.05);
    EXPECT_LT(back.to_scan.p95, 0.7);
    const auto told = [](const std::string& remark) { return remark.starts_with("mirrored back"); };
    EXPECT_TRUE(std::ranges::any_of(back.remarks, told));
    EXPECT_TRUE(std::ranges::none_of(straight.remarks, told));
}

ScanFolder with_hole(ScanFolder scans, double radius) {
    ScanMesh& mesh = scans.postures["neutral"].mesh;
    const Vector3d cheek = in_scan({35, 25, -5});
    std::erase_if(mesh.triangles, [&](const Triangle& t) {
        return (mesh.nodes.row(t[0]).transpose() - cheek).norm() < radius / 1000;
    });
    return scans;
}

TEST(AdaptedHead, GoesOnSmoothlyOverHolesAndSaysSo) {
    const AdaptedHead whole = adapt_head(momo(), scan_of(other_head())),
                      holed = adapt_head(momo(), with_hole(scan_of(other_head()), 30));
    EXPECT_LT(std::ranges::count(holed.covered, true), std::ranges::count(whole.covered, true));
    EXPECT_EQ(holed.flipped, 0);
    EXPECT_LT((holed.nodes - whole.nodes).rowwise().norm().maxCoeff(), 6);
    EXPECT_TRUE(std::ranges::any_of(holed.remarks, [](const std::string& remark) {
        return remark.find("percent of the face are holes") != std::string::npos;
    }));
}

TEST(AdaptedHead, RefusesAFaceThatIsMostlyHoles) {
    EXPECT_THROW(adapt_head(momo(), with_hole(scan_of(other_head()), 85)), InputError);
}

// The drawn skin of the built-in talker, twice, side by side.
TEST(AdaptedHead, RefusesTwoHeads) {
    ScanFolder scans;
    PaintedSurface two = momo().drawn.at(0);
    const Eigen::Index count = two.mesh.nodes.rows();
    two.mesh.nodes.conservativeResize(2 * count, 3);
    two.mesh.nodes.bottomRows(count) =
        two.mesh.nodes.topRows(count).rowwise() + Eigen::RowVector3d(260, 0, 0);
    for (std::size_t t = 0, triangles = two.mesh.triangles.size(); t < triangles; ++t) {
        Triangle other = two.mesh.triangles[t];
        for (int& node : other) node += static_cast<int>(count);
        two.mesh.triangles.push_back(other);
        two.mesh.uv_triangles.push_back(two.mesh.uv_triangles[t]);
    }
    scans.postures["neutral"] = std::move(two);
    scans.view_from_scan = Eigen::Matrix3d::Identity();
    try {
        adapt_head(momo(), scans);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.allowed(), "one head to a scan") << error.what();
    }
}

TEST(AdaptedHead, RefusesWhatHasNoFace) {
    ScanFolder scans = scan_of(other_head());
    scans.landmarks.clear();
    Nodes& nodes = scans.postures["neutral"].mesh.nodes;
    const Eigen::RowVector3d middle = nodes.colwise().mean();
    for (Eigen::Index i = 0; i < nodes.rows(); ++i)
        nodes.row(i) = middle + 0.1 * (nodes.row(i) - middle).normalized();
    EXPECT_THROW(adapt_head(momo(), scans), InputError);
}

TEST(BorrowedTalker, OfTheLendersOwnHeadIsTheLender) {
    const Codex codex = make_codex({momo().training.rest, Eigen::MatrixXd::Identity(kCoordinates, 2)},
                                   Eigen::VectorXd::Zero(2), {}, "nobody", 0.5);
    const BorrowedTalker talker = with_borrowed_motion(momo(), codex, momo().face.rest, 1);
    EXPECT_EQ(talker.codex.scatter_mm, codex.scatter_mm);
    EXPECT_LT((talker.motion_scale - Vector3d::Ones()).norm(), 0.02);
    const Poser lender(momo().face, momo().training), borrower(talker.face, talker.training);
    for (const Eigen::Index k : {0, 3, 9}) {
        const Configuration points = momo().training.configurations.col(k);
        EXPECT_LT((lender.posed(points) - borrower.posed(points)).rowwise().norm().maxCoeff(), 1.5) << k;
    }
}

TEST(BorrowedTalker, OfAnotherHeadClosesItsLips) {
    const Codex codex = make_codex({momo().training.rest, Eigen::MatrixXd::Identity(kCoordinates, 2)},
                                   Eigen::VectorXd::Zero(2), {}, "nobody");
    const BorrowedTalker talker = with_borrowed_motion(momo(), codex, other_head(), 0.9);
    const Poser poser(talker.face, talker.training);
    const Poser lender(momo().face, momo().training);
    for (Eigen::Index k = 0; k < talker.training.configurations.cols(); ++k) {
        const double gap = poser.drawn_gaps(poser.posed(talker.training.configurations.col(k)))[0],
                     wanted = lender.drawn_gaps(lender.posed(momo().training.configurations.col(k)))[0];
        EXPECT_NEAR(gap, 0.9 * wanted, 1.0) << k;
    }
}

TEST(ScanFolder, TellsANormalMapFromSkin) {
    Texture normals{32, 32, 3, {}}, skin{32, 32, 3, {}};
    for (int i = 0; i < 32 * 32; ++i) {
        const double tilt = 0.3 * std::sin(0.37 * i);
        const Vector3d n(std::sin(tilt), 0, std::cos(tilt));
        for (int k = 0; k < 3; ++k) normals.pixels.push_back(static_cast<std::uint8_t>(127.5 * (n[k] + 1)));
        for (const int c : {200, 150, 130}) skin.pixels.push_back(static_cast<std::uint8_t>(c));
    }
    EXPECT_GT(normal_map_share(normals), 0.95);
    EXPECT_LT(normal_map_share(skin), 0.2);
    ScanMesh mesh;
    mesh.uvs.resize(3, 2);
    mesh.uvs << 0, 0, 1, 0, 0, 1;
    mesh.uv_triangles = {{0, 1, 2}};
    EXPECT_EQ(skin_share(mesh, skin), 1);
    EXPECT_EQ(skin_share(mesh, normals), 0);
}

TEST(ScanFolder, MendsScrapsAndThinsWhatIsTooFine) {
    ScanMesh mesh;
    const int side = 700;
    mesh.nodes.resize(side * side + 3, 3);
    for (int i = 0; i < side * side; ++i) mesh.nodes.row(i) << i % side, i / side, 0;
    for (int y = 0; y + 1 < side; ++y) {
        for (int x = 0; x + 1 < side; ++x)
            mesh.triangles.push_back({y * side + x, y * side + x + 1, (y + 1) * side + x});
    }
    mesh.nodes.bottomRows(3) << 900, 900, 0, 905, 900, 0, 900, 905, 0;
    mesh.triangles.push_back({side * side, side * side + 1, side * side + 2});
    std::vector<std::string> remarks;
    const ScanMesh whole = mended(mesh, remarks);
    EXPECT_LT(whole.nodes.rows(), 400'000);
    EXPECT_EQ(pieces_of(whole).size(), 1u);
    EXPECT_EQ(remarks.size(), 2u);
}

struct Folder {
    fs::path path = fs::temp_directory_path() / ("viaface_scans_" + std::to_string(::getpid()));
    Folder() { fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
    void write(const char* name, const std::string& text) const { std::ofstream(path / name) << text; }
};

std::string error_of(const Folder& folder) {
    try {
        read_scan_folder(folder.path);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(ScanFolder, NamesFileLineAndValueOfWhatIsWrong) {
    const Folder folder;
    EXPECT_NE(error_of(folder).find("a folder with a scan"), std::string::npos);
    folder.write("head.obj", "v 0 0 0\nv 1 nan 0\n");
    EXPECT_NE(error_of(folder).find("head.obj: line 2: nan"), std::string::npos) << error_of(folder);
    folder.write("head.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_EQ(error_of(folder), "");
    folder.write("scans.json", R"({"units": "furlong"})");
    EXPECT_NE(error_of(folder).find("furlong"), std::string::npos);
    folder.write("scans.json", R"({"postures": {"neutral": "../head.obj"}})");
    EXPECT_NE(error_of(folder).find("within the folder"), std::string::npos);
    folder.write("scans.json", R"({"postures": {"a": "head.obj"}})");
    EXPECT_NE(error_of(folder).find("neutral"), std::string::npos);
}

TEST(ScanFolder, RefusesMorePointsThanItTakes) {
    const Folder folder;
    folder.write("head.ply",
                 "ply\nformat ascii 1.0\nelement vertex 12000001\nproperty float x\nproperty float y\n"
                 "property float z\nend_header\n0 0 0\n");
    EXPECT_NE(error_of(folder).find("at most 12000000"), std::string::npos) << error_of(folder);
}

TEST(ScanFolder, TakesTheOneCalledNeutralOfEquallyFineMeshes) {
    const Folder folder;
    for (const char* name : {"a.obj", "neutral.obj", "z.obj"})
        folder.write(name, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_EQ(read_scan_folder(folder.path).files.at("neutral"), "neutral.obj");
}

}  // namespace
}  // namespace viaface

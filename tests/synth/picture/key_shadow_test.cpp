#include "synth/picture/key_shadow.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "simple_faces.hpp"
#include "synth/picture/depth_map.hpp"
#include "synth/picture/lights.hpp"

namespace viaface {
namespace {

using testing::add_ball;
using testing::add_square;
using testing::kMiddleY;
using testing::kMiddleZ;

TEST(KeyShadow, ABallInTheOpenIsLitWhereItFacesTheLight) {
    Face face;
    add_ball(face, Material::kSkin, 60, {0, kMiddleY, kMiddleZ}, 24);
    const std::vector<float> shares = key_shares(face, {});
    const Eigen::Vector3d key = Eigen::Vector3f(lights::kKeyWay).cast<double>().normalized();
    for (Eigen::Index i = 0; i < face.rest.rows(); ++i) {
        const Eigen::Vector3d normal =
            (face.rest.row(i).transpose() - Eigen::Vector3d(0, kMiddleY, kMiddleZ)).normalized();
        if (normal.dot(key) > 0.35) {
            EXPECT_GT(shares[static_cast<std::size_t>(i)], 0.99f) << normal.transpose();
        }
    }
}

// A small ball between a wall and the light shades the wall there, and no wall far from it; when the head
// turns, its shadow goes elsewhere.
TEST(KeyShadow, FallsAwayFromTheLight) {
    Face face;
    constexpr int kSide = 41;
    Nodes wall(kSide * kSide, 3);
    std::vector<Triangle> triangles;
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            wall.row(y * kSide + x) << 5.0 * (x - kSide / 2), kMiddleY + 5.0 * (y - kSide / 2), kMiddleZ;
            if (x + 1 == kSide || y + 1 == kSide) continue;
            const int a = y * kSide + x;
            triangles.push_back({a, a + 1, a + kSide + 1});
            triangles.push_back({a, a + kSide + 1, a + kSide});
        }
    }
    testing::add_part(face, Material::kSkin, wall, triangles);
    const Eigen::Vector3d key = Eigen::Vector3f(lights::kKeyWay).cast<double>().normalized();
    add_ball(face, Material::kSkin, 18, Eigen::Vector3d(0, kMiddleY, kMiddleZ) + 50 * key, 16);
    const std::size_t middle = kSide * (kSide / 2) + kSide / 2, far = kSide * 36 + 4;
    const std::vector<float> shares = key_shares(face, {});
    EXPECT_LT(shares[middle], 0.3f);
    EXPECT_GT(shares[far], 0.99f);
    EXPECT_GT(key_shares(face, View{.yaw = 60})[middle], 0.75f);
}

TEST(DepthMap, SeesWhatIsInFront) {
    Face face;
    add_square(face, Material::kSkin, 100, 0);
    add_square(face, Material::kSkin, 40, 30);
    const std::vector<Triangle> all = {face.parts[0].triangles[0], face.parts[0].triangles[1],
                                       face.parts[1].triangles[0], face.parts[1].triangles[1]};
    const DepthMap map(face.rest.cast<float>(), all, {0, 0, 1}, 256);
    EXPECT_FALSE(map.lit({0, float(kMiddleY), float(kMiddleZ)}, 1));
    EXPECT_TRUE(map.lit({0, float(kMiddleY), float(kMiddleZ)}, 31));
    EXPECT_TRUE(map.lit({40, float(kMiddleY), float(kMiddleZ)}, 1));
    EXPECT_TRUE(map.lit({0, float(kMiddleY), float(kMiddleZ) + 30}, 1));
    EXPECT_TRUE(map.lit({4000, 0, 0}, 1));
}

}  // namespace
}  // namespace viaface

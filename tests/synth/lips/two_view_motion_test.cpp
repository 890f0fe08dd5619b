#include "synth/lips/two_view_motion.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"

namespace viaface {
namespace {

constexpr const char* kCameras =
    R"({"first": [[1200, 0, 320, 192000], [0, -1200, 240, 144000], [0, 0, 1, 600]],
        "second": [[320, 0, 1200, 192000], [240, -1200, 0, 144000], [1, 0, 0, 600]]})";

Motion view_of(const Projection& camera, const std::vector<Eigen::Vector3d>& places,
               const std::string& name) {
    Motion view{{}, RowMatrix::Constant(static_cast<Eigen::Index>(places.size()), kCoordinates, NAN), {}};
    view.extra = {{name + "_u_px", {}}, {name + "_v_px", {}}};
    for (const auto& place : places) {
        view.time_s.push_back(0.04 * static_cast<double>(view.time_s.size()));
        const Eigen::Vector2d seen = projected(camera, place);
        view.extra[0].values.push_back(seen.x());
        view.extra[1].values.push_back(seen.y());
    }
    return view;
}

const std::vector<Eigen::Vector3d> kPlaces = {{0, 10, 12}, {1, 9, 11}, {2, 12, 10}};

TEST(TwoViewMotion, PointsAreFoundInSpace) {
    const CameraPair cameras = parse_cameras(kCameras);
    const Motion first = view_of(cameras.first, kPlaces, "border_top");
    Motion second = view_of(cameras.second, kPlaces, "border_top");
    second.extra[0].values[1] = NAN;  // not marked there
    const TwoViewMotion made = triangulated(first, second, cameras);
    EXPECT_LT((point_of(made.motion.at(0), kBorderTop) - kPlaces[0]).norm(), 1e-6);
    EXPECT_LT((point_of(made.motion.at(2), kBorderTop) - kPlaces[2]).norm(), 1e-6);
    EXPECT_TRUE(point_of(made.motion.at(1), kBorderTop).hasNaN());
    EXPECT_TRUE(point_of(made.motion.at(0), kBorderBottom).hasNaN());
    EXPECT_LT(made.error_px, 1e-6);
}

TEST(TwoViewMotion, RefusesViewsThatDoNotMeet) {
    const CameraPair cameras = parse_cameras(kCameras);
    const Motion first = view_of(cameras.first, kPlaces, "border_top");
    EXPECT_THROW(triangulated(first, view_of(cameras.second, kPlaces, "chin"), cameras), InputError);
    Motion later = view_of(cameras.second, kPlaces, "border_top");
    later.time_s[2] += 0.01;
    EXPECT_THROW(triangulated(first, later, cameras), InputError);
    EXPECT_THROW(triangulated(first, first, {cameras.first, cameras.first}), InputError);
}

TEST(TwoViewMotion, RefusesCamerasThatAreNone) {
    for (const char* bad : {"", "[]", "{}", "null", R"({"first": 3, "second": 4})",
                            R"({"first": [[1,2,3,4],[1,2,3,4],[1,2,3]], "second": []})",
                            R"({"first": [[1,2,3,"4"],[1,2,3,4],[1,2,3,4]]})",
                            R"({"first": [[1,2,3,1e300],[1,2,3,4],[1,2,3,4]]})"})
        EXPECT_THROW(parse_cameras(bad), InputError) << bad;
}

}  // namespace
}  // namespace viaface

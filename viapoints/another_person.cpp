#include "viapoints/another_person.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/median.hpp"
#include "viapoints/face_axes.hpp"
#include "viapoints/rest.hpp"

namespace viaface {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// A length of a face in the head frame; NaN where it cannot be measured.
struct Length {
    std::string name;
    double person, talker;
};

double x_between(const Configuration& c, int left, int right) {
    return point_of(c, left).x() - point_of(c, right).x();
}

// From a corner to the middle of what is measured in the midplane.
double half_width(const Configuration& c, const Configuration& pattern, int corner) {
    double sum = 0;
    int count = 0;
    for (int p = 0; p < kPoints; ++p) {
        if (mirrored_point(p) != p || !point_of(c, p).allFinite() || !point_of(pattern, p).allFinite())
            continue;
        sum += point_of(c, p).x();
        ++count;
    }
    return std::abs(point_of(c, corner).x() - sum / count);
}

Length width(const Configuration& person, const Configuration& talker) {
    for (const auto& [left, right] : {std::pair{kLipCornerLeft, kLipCornerRight},
                                      {kBorderLeft, kBorderRight},
                                      {kInnerLeft, kInnerRight}}) {
        const double mm = x_between(person, left, right);
        if (!std::isnan(mm)) return {"between the corners", mm, x_between(talker, left, right)};
    }
    for (const int corner :
         {kLipCornerLeft, kLipCornerRight, kBorderLeft, kBorderRight, kInnerLeft, kInnerRight}) {
        const double mm = half_width(person, person, corner);
        if (!std::isnan(mm)) return {"from one corner to the middle", mm, half_width(talker, person, corner)};
    }
    return {"", std::nan(""), std::nan("")};
}

double height_of(const Configuration& c, int point) {
    const int other = mirrored_point(point);
    return (point_of(c, point).y() + point_of(c, other).y()) / 2;
}

Length height(const Configuration& person, const Configuration& talker) {
    for (const int top : {kNose, kCheekUpperLeft}) {
        for (const int bottom : {kChin, kChinLeft, kLipBottom}) {
            const double mm = height_of(person, top) - height_of(person, bottom);
            if (std::isnan(mm)) continue;
            const std::string name =
                "from " + std::string(point_name(top)) + " to " + std::string(point_name(bottom));
            return {name, mm, height_of(talker, top) - height_of(talker, bottom)};
        }
    }
    return {"", std::nan(""), std::nan("")};
}

double ratio_of(const Length& length, const char* what) {
    constexpr double kLeast = 0.25, kMost = 4;
    const double ratio = length.talker / length.person;
    if (length.name.empty() || (ratio >= kLeast && ratio <= kMost)) return ratio;
    throw InputError("--scale", std::string(what) + " of " + std::to_string(length.person) + " mm",
                     "a face: give x,y,z, or --axes");
}

void find_scale(Person& person, const Configuration& talker_rest, const PersonOptions& options) {
    if (options.scale) {
        if (!(options.scale->minCoeff() > 0) || !(options.scale->maxCoeff() <= 100))
            throw InputError("--scale", "a number that is none", "x,y,z or one number, above 0 up to 100");
        person.scale = *options.scale;
        return;
    }
    Configuration turned;
    for (int p = 0; p < kPoints; ++p)
        turned.segment<3>(3 * p) = person.axes.head_from_file * point_of(person.rest.points, p);
    const Length wide = width(turned, talker_rest), high = height(turned, talker_rest);
    const double x = ratio_of(wide, "a mouth width"), y = ratio_of(high, "a face height");
    if (std::isnan(x) && std::isnan(y))
        throw InputError("--scale", "neither mouth width nor face height measured", "x,y,z or one number");
    const double sx = std::isnan(x) ? y : x, sy = std::isnan(y) ? x : y;
    person.scale = Vector3d(sx, sy, (sx + sy) / 2);
    person.width_from = wide.name;
    person.height_from = high.name;
}

}  // namespace

Person measure_person(const Motion& motion, const Configuration& talker_rest, const PersonOptions& options) {
    Person person;
    person.rest = rest_of(motion, options.rest_s, options.quiet_s);
    person.axes = face_axes(person.rest.points, talker_rest, options.axes, options.up_axis);
    find_scale(person, talker_rest, options);
    return person;
}

Vector3d median_scale(const std::vector<Person>& recordings) {
    Vector3d scale;
    for (Index axis = 0; axis < 3; ++axis) {
        std::vector<double> scales;
        for (const Person& person : recordings) scales.push_back(person.scale[axis]);
        scale[axis] = median(scales);
    }
    return scale;
}

Motion as_talker(Motion motion, const Person& person, const Configuration& talker_rest) {
    const Matrix3d change = person.scale.asDiagonal() * person.axes.head_from_file;
    for (Index i = 0; i < motion.positions.rows(); ++i) {
        for (int p = 0; p < kPoints; ++p) {
            const Vector3d now = motion.positions.block<1, 3>(i, 3 * p).transpose();
            motion.positions.block<1, 3>(i, 3 * p) =
                (point_of(talker_rest, p) + change * (now - point_of(person.rest.points, p))).transpose();
        }
    }
    return motion;
}

}  // namespace viaface

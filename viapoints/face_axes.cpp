#include "viapoints/face_axes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "viapoints/cells.hpp"
#include "viapoints/rigid_turn.hpp"

namespace viaface {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kClearlyBest = 0.03;  // of the share of places explained, above the next turn

struct Direction {
    const char* name;
    double x, y, z;  // head frame
};
constexpr Direction kDirections[] = {{"left", 1, 0, 0},  {"right", -1, 0, 0},  {"up", 0, 1, 0},
                                     {"down", 0, -1, 0}, {"forward", 0, 0, 1}, {"back", 0, 0, -1}};

std::string direction_name(const Vector3d& along) {
    for (const auto& [name, x, y, z] : kDirections) {
        if (along.dot(Vector3d(x, y, z)) > 0.5) return name;
    }
    return "?";
}

std::string axes_name(const Matrix3d& turn) {
    return direction_name(turn.col(0)) + "," + direction_name(turn.col(1)) + "," +
           direction_name(turn.col(2));
}

Matrix3d given_axes(const std::string& text) {
    const auto parts = cells_of(text, ',');
    Matrix3d turn = Matrix3d::Zero();
    for (std::size_t i = 0; i < parts.size() && i < 3; ++i) {
        for (const auto& [name, x, y, z] : kDirections) {
            if (in_lower_case(parts[i]) == name) turn.col(static_cast<Index>(i)) = Vector3d(x, y, z);
        }
    }
    if (parts.size() != 3 || std::abs(turn.determinant()) < 0.5)
        throw InputError(
            "--axes", text,
            "found, fit, or three of left, right, up, down, forward and back, as forward,left,up");
    return turn;
}

// The 24 turns onto axes.
std::vector<Matrix3d> axis_turns() {
    std::vector<Matrix3d> turns;
    for (const auto& a : kDirections) {
        for (const auto& b : kDirections) {
            const Vector3d x(a.x, a.y, a.z), y(b.x, b.y, b.z);
            if (x.dot(y) != 0) continue;
            Matrix3d turn;
            turn << x, y, x.cross(y);
            turns.push_back(turn);
        }
    }
    return turns;
}

// The points that both have, the talker's last.
std::pair<Points, Points> shared_points(const Configuration& person, const Configuration& talker) {
    std::pair<Points, Points> shared;
    for (int p = 0; p < kPoints; ++p) {
        if (!point_of(person, p).allFinite() || !point_of(talker, p).allFinite()) continue;
        shared.first.push_back(point_of(person, p));
        shared.second.push_back(point_of(talker, p));
    }
    return shared;
}

Points centred(Points points) {
    Vector3d sum = Vector3d::Zero();
    for (const Vector3d& point : points) sum += point;
    for (Vector3d& point : points) point -= sum / static_cast<double>(points.size());
    return points;
}

// Share of the talker's places that the person's explain, turned and scaled: the squared correlation, with
// its sign.
double explained(const Matrix3d& turn, const Points& person, const Points& talker) {
    double products = 0, a = 0, b = 0;
    for (std::size_t i = 0; i < person.size(); ++i) {
        products += talker[i].dot(turn * person[i]);
        a += person[i].squaredNorm();
        b += talker[i].squaredNorm();
    }
    return a * b > 0 ? products * std::abs(products) / (a * b) : 0;
}

// The file's axis that points up, as a row of the turn: "+Z".
std::optional<Vector3d> up_row(const std::string& text) {
    if (text.size() != 2 || (text[0] != '+' && text[0] != '-')) return std::nullopt;
    const int axis = in_lower_case(text.substr(1))[0] - 'x';
    if (axis < 0 || axis > 2) return std::nullopt;
    return Vector3d::Unit(axis) * (text[0] == '+' ? 1 : -1);
}

Matrix3d found_axes(const Points& person, const Points& talker, const std::string& up_axis) {
    const Points p = centred(person), t = centred(talker);
    const auto up = up_row(up_axis);
    Matrix3d best = Matrix3d::Identity();
    double most = -1, next = -1;
    for (const Matrix3d& turn : axis_turns()) {
        if (up && turn.row(1).transpose() != *up) continue;
        const double share = explained(turn, p, t);
        if (share > most) {
            next = most;
            most = share;
            best = turn;
        } else {
            next = std::max(next, share);
        }
    }
    if (person.size() < 3 || most < 0.3 || most - next < kClearlyBest)
        throw InputError("--axes", "not to be found from " + std::to_string(person.size()) + " points",
                         "where x, y and z point to, as forward,left,up");
    return best;
}

}  // namespace

FaceAxes face_axes(const Configuration& rest, const Configuration& talker_rest, const std::string& axes,
                   const std::string& up_axis) {
    FaceAxes found;
    const auto [from, to] = shared_points(rest, talker_rest);
    std::optional<Matrix3d> best;
    if (from.size() >= 3 && spread(from) > 1)
        best = rigid_turn(centred(from), centred(to)).turn.toRotationMatrix();
    found.name = axes;
    if (axes == "fit") {
        if (!best) throw InputError("--axes", "fit", "three or more points that are not on a line");
        found.head_from_file = *best;
    } else {
        found.head_from_file = axes == "found" ? found_axes(from, to, up_axis) : given_axes(axes);
        found.name = axes_name(found.head_from_file);
    }
    if (best && found.head_from_file.determinant() > 0)
        found.fit_degrees =
            Eigen::AngleAxisd(*best * found.head_from_file.transpose()).angle() * 180 / std::numbers::pi;
    return found;
}

}  // namespace viaface

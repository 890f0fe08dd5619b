#include "synth/lips/two_view_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/error.hpp"

namespace viaface {
namespace {

constexpr double kLargestEntry = 1e9;

Projection projection_of(const nlohmann::json& cameras, const char* name) {
    const auto allowed = "three rows of four finite numbers for first and second";
    if (!cameras.is_object() || !cameras.contains(name) || !cameras[name].is_array() ||
        cameras[name].size() != 3)
        throw InputError("cameras", name, allowed);
    Projection projection;
    for (int r = 0; r < 3; ++r) {
        const auto& row = cameras[name][r];
        if (!row.is_array() || row.size() != 4) throw InputError("cameras", name, allowed);
        for (int c = 0; c < 4; ++c) {
            if (!row[c].is_number() || !(std::abs(row[c].get<double>()) <= kLargestEntry))
                throw InputError("cameras", name, allowed);
            projection(r, c) = row[c].get<double>();
        }
    }
    return projection;
}

// The columns of a point in a view; nullptr where it has none.
struct Marks {
    const std::vector<double>*u = nullptr, *v = nullptr;
    bool there() const { return u != nullptr && v != nullptr; }
    Eigen::Vector2d at(std::size_t i) const { return {(*u)[i], (*v)[i]}; }
};

Marks marks_of(const Motion& view, std::string_view point) {
    const auto column = [&](const char* axis) -> const std::vector<double>* {
        const std::string name = std::string(point) + axis;
        const auto found = std::ranges::find(view.extra, name, &ExtraColumn::name);
        return found == view.extra.end() ? nullptr : &found->values;
    };
    return {column("_u_px"), column("_v_px")};
}

Triangulated placed(const CameraPair& cameras, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    try {
        return triangulate(cameras.first, a, cameras.second, b);
    } catch (const std::runtime_error& error) {
        throw InputError("cameras", error.what(), "two cameras that look from different places");
    }
}

}  // namespace

CameraPair parse_cameras(std::string_view json) {
    const auto parsed = nlohmann::json::parse(json, nullptr, false);
    return {projection_of(parsed, "first"), projection_of(parsed, "second")};
}

TwoViewMotion triangulated(const Motion& first, const Motion& second, const CameraPair& cameras) {
    if (first.time_s != second.time_s) throw InputError("views", "other times", "the same time_s in both");
    const auto samples = static_cast<Eigen::Index>(first.size());
    TwoViewMotion made;
    made.motion.time_s = first.time_s;
    made.motion.positions =
        RowMatrix::Constant(samples, kCoordinates, std::numeric_limits<double>::quiet_NaN());
    double squares = 0;
    int points = 0;
    for (int point = 0; point < kPoints; ++point) {
        const Marks a = marks_of(first, point_name(point)), b = marks_of(second, point_name(point));
        if (!a.there() || !b.there()) continue;
        for (std::size_t i = 0; i < first.size(); ++i) {
            if (!a.at(i).allFinite() || !b.at(i).allFinite()) continue;
            const Triangulated found = placed(cameras, a.at(i), b.at(i));
            made.motion.positions.row(static_cast<Eigen::Index>(i)).segment<3>(3 * point) = found.place;
            squares += found.error_px * found.error_px;
            ++points;
        }
    }
    if (points == 0) throw InputError("views", "no point in both", "columns NAME_u_px and NAME_v_px in both");
    made.error_px = std::sqrt(squares / points);
    return made;
}

}  // namespace viaface

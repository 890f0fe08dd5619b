#include "synth/training/blend_head.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/whole_file.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

constexpr double kMillimetresPerUnit = 10.0;

// Places on the neutral head, mm, where no landmark stands; the nearest node of the face is taken. Left side
// and middle.
struct Place {
    Point point;
    double x, y, z;
};
constexpr Place kPlaces[] = {{kLipTop, 0, 11.7, 11.3},
                             {kLipTopLeft, 17.5, 9.3, 5.3},
                             {kLipCornerLeft, 27.7, -1.0, -5.2},
                             {kLipBottomLeft, 18.5, -7.5, 1.7},
                             {kLipBottom, 0, -10.6, 6.7},
                             {kChin, 0, -27.0, 4.0},
                             {kChinLeft, 15.5, -28.5, -0.5},
                             {kCheekLowerLeft, 42, 1.7, -14.3},
                             {kCheekUpperLeft, 41.7, 42.1, -12.1},
                             {kNose, 0, 36.0, 24.4}};

// Points that stand on one of the 68 landmarks. Left side and middle.
struct OnLandmark {
    Point point;
    int landmark;
};
constexpr OnLandmark kOnLandmarks[] = {{kJawLeft, 11},         {kBorderTop, 51},        {kBorderTopLeft, 53},
                                       {kBorderLeft, 54},      {kBorderBottomLeft, 55}, {kBorderBottom, 57},
                                       {kInnerTop, 62},        {kInnerTopLeft, 63},     {kInnerLeft, 64},
                                       {kInnerBottomLeft, 65}, {kInnerBottom, 66}};

struct TonguePlace {
    Point point;
    double y, z;
};  // rest, in the midsagittal plane, read off the scan's tongue
constexpr TonguePlace kTongue[] = {
    {kTongueTip, -0.5, -16.0}, {kTongueBody, 3.0, -35.0}, {kTongueRear, 3.5, -55.0}};

int nearest_node(const Nodes& nodes, BlendHead::Range range, const Vector3d& place) {
    Eigen::Index nearest = 0;
    (nodes.middleRows(range.first, range.last - range.first).rowwise() - place.transpose())
        .rowwise()
        .squaredNorm()
        .minCoeff(&nearest);
    return range.first + static_cast<int>(nearest);
}

// Nodes of the middle two incisors within 1 mm of their edge.
std::vector<int> incisor_edge(const Nodes& nodes, BlendHead::Range teeth, double up) {
    constexpr double kHalfWidth = 8.0, kDepth = 1.0;
    double edge = -1e9;
    for (int i = teeth.first; i < teeth.last; ++i) {
        if (std::abs(nodes(i, 0)) < kHalfWidth) edge = std::max(edge, up * nodes(i, 1));
    }
    std::vector<int> found;
    for (int i = teeth.first; i < teeth.last; ++i) {
        if (std::abs(nodes(i, 0)) < kHalfWidth && up * nodes(i, 1) > edge - kDepth) found.push_back(i);
    }
    return found;
}

Vector3d mean_of(const Nodes& nodes, const std::vector<int>& which) {
    Vector3d sum = Vector3d::Zero();
    for (const int i : which) sum += nodes.row(i).transpose();
    return sum / static_cast<double>(which.size());
}

Vector3d mirrored(const Vector3d& place) { return {-place.x(), place.y(), place.z()}; }

std::vector<int> read_landmarks(const fs::path& file) {
    const auto json = nlohmann::json::parse(read_text(file, "scans"));
    return json.at("idx_to_landmark_verts").get<std::vector<int>>();
}

double share_of_identity(double height) {
    constexpr double kNone = -130, kWhole = -75;  // mm: at the shoulders, under the chin
    const double t = std::clamp((height - kNone) / (kWhole - kNone), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

std::vector<std::string> names_where(const std::map<std::string, Nodes>& deltas, bool identity) {
    std::vector<std::string> names;
    for (const auto& [name, delta] : deltas) {
        if (name.starts_with("identity") == identity) names.push_back(name);
    }
    return names;
}

}  // namespace

BlendHead::BlendHead(const fs::path& folder, const ShapeWeights& identity) {
    const fs::path rest = folder / "generic_neutral_mesh.obj";
    if (!fs::exists(rest)) {
        throw InputError("scans", folder.string(), "a folder with generic_neutral_mesh.obj and its shapes");
    }
    neutral_ = read_obj(rest);
    if (neutral_.nodes.rows() != kLashes.last) throw InputError("scans", rest.string(), "26719 nodes");
    landmarks_ = read_landmarks(folder / "vertex_indices.json");
    neutral_.nodes *= kMillimetresPerUnit;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() != ".obj" || entry.path() == rest) continue;
        const Nodes shape = read_obj(entry.path()).nodes * kMillimetresPerUnit;
        if (shape.rows() != neutral_.nodes.rows()) {
            throw InputError("scans", entry.path().string(), "as many nodes as the neutral head");
        }
        deltas_[entry.path().stem().string()] = shape - neutral_.nodes;
    }
    const Vector3d origin = mean_of(neutral_.nodes, incisor_edge(neutral_.nodes, kUpperTeeth, -1));
    neutral_.nodes.rowwise() -= origin.transpose();
    place_points();
    become(identity);
}

// The mouth's inside is nobody's: it stays, and the person's lips meet before it where the head's do. So do
// the shoulders.
void BlendHead::become(const ShapeWeights& identity) {
    constexpr int kFirstInner = 60, kLastInner = 67;  // landmarks of the inner lips
    generic_ = neutral_.nodes;
    Nodes way = with(generic_, identity) - generic_;
    const std::vector<int> inner(landmarks_.begin() + kFirstInner, landmarks_.begin() + kLastInner + 1);
    way.rowwise() -= mean_of(way, inner).transpose();
    for (Eigen::Index i = 0; i < way.rows(); ++i) {
        neutral_.nodes.row(i) += share_of_identity(generic_(i, 1)) * way.row(i);
    }
    for (const Range& range : {kMouthSocket, kGumsAndTongue, kUpperTeeth, kLowerTeeth}) {
        neutral_.nodes.middleRows(range.first, range.last - range.first) =
            generic_.middleRows(range.first, range.last - range.first);
    }
}

void BlendHead::place_points() {
    const Nodes& nodes = neutral_.nodes;
    const auto mirror_of = [&](int node) {
        return nearest_node(nodes, kFace, mirrored(nodes.row(node).transpose()));
    };
    point_nodes_.assign(kPoints, {});
    for (const auto& [point, x, y, z] : kPlaces) {
        const int node = nearest_node(nodes, kFace, Vector3d(x, y, z));
        point_nodes_[point] = {node};
        point_nodes_[mirrored_point(point)] = {mirror_of(node)};
    }
    for (const auto& [point, landmark] : kOnLandmarks) {
        const int node = landmarks_.at(static_cast<std::size_t>(landmark));
        point_nodes_[point] = {node};
        point_nodes_[mirrored_point(point)] = {mirror_of(node)};
    }
    point_nodes_[kLowerIncisor] = incisor_edge(nodes, kLowerTeeth, +1);
    rest_.setZero();
    for (const auto& [point, y, z] : kTongue) rest_.segment<3>(3 * point) = Vector3d(0, y, z);
    rest_.segment<3>(3 * kLowerIncisor) = mean_of(nodes, point_nodes_[kLowerIncisor]);
}

const Nodes& BlendHead::delta(const std::string& name) const {
    const auto found = deltas_.find(name);
    if (found == deltas_.end()) throw std::invalid_argument("the head has no shape " + name);
    return found->second;
}

Nodes BlendHead::with(Nodes nodes, const ShapeWeights& weights) const {
    for (const auto& [name, weight] : weights) {
        if (deltas_.contains(name)) {
            nodes += weight * delta(name);
        } else {
            nodes += weight * (delta(name + "_L") + delta(name + "_R"));
        }
    }
    return nodes;
}

Nodes BlendHead::pose(const ShapeWeights& weights) const { return with(neutral_.nodes, weights); }

std::vector<std::string> BlendHead::shape_names() const { return names_where(deltas_, false); }
std::vector<std::string> BlendHead::identity_names() const { return names_where(deltas_, true); }

Configuration BlendHead::points(const Nodes& posed) const {
    Configuration c;
    for (int point = 0; point < kPoints; ++point) {
        const auto& nodes = point_nodes_[static_cast<std::size_t>(point)];
        if (!nodes.empty()) c.segment<3>(3 * point) = mean_of(posed, nodes);
    }
    const Vector3d jaw = point_of(c, kLowerIncisor) - point_of(rest_, kLowerIncisor);
    for (const auto& place : kTongue) c.segment<3>(3 * place.point) = point_of(rest_, place.point) + jaw;
    return c;
}

}  // namespace viaface

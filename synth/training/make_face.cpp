#include "synth/training/make_face.hpp"

#include <algorithm>
#include <cmath>

#include "synth/picture/surface_frame.hpp"
#include "synth/pose/inside.hpp"
#include "synth/training/eyes.hpp"
#include "synth/training/hairline.hpp"
#include "synth/training/teeth.hpp"
#include "synth/training/tongue.hpp"

namespace viaface {
namespace {

// The axis about which the scan's lower teeth turn when jawOpen grows, mm.
const Vector3d kHinge(0, 29.5, -88.3);
constexpr double kModeTolerance = 1e-5;  // of the largest singular value: below it lies the scans' round-off

constexpr double kRestingLids = 0.10;  // of a blink

Nodes lowered_lids(const BlendHead& head) {
    return head.pose({{"eyeBlink_L", kRestingLids}, {"eyeBlink_R", kRestingLids}}) - head.neutral().nodes;
}

JawMotion jaw_of(const Configuration& rest, const Configuration& now) {
    return jaw_motion(kHinge, point_of(rest, kLowerIncisor), point_of(now, kLowerIncisor));
}

Nodes on_jaw(Nodes nodes, const JawMotion& jaw) {
    for (Eigen::Index i = 0; i < nodes.rows(); ++i) nodes.row(i) = jaw(nodes.row(i).transpose()).transpose();
    return nodes;
}

std::array<Vector3d, 3> tongue_points(const Configuration& c) {
    return {point_of(c, kTongueTip), point_of(c, kTongueBody), point_of(c, kTongueRear)};
}

// A disc of the charts into a box of the skin's texture.
Uvs uvs_in(const std::vector<Vector2d>& places, double left, double width) {
    constexpr double kMargin = 0.49;
    Uvs uvs(static_cast<Eigen::Index>(places.size()), 2);
    for (std::size_t i = 0; i < places.size(); ++i) {
        uvs.row(static_cast<Eigen::Index>(i))
            << static_cast<float>(left + width * (0.5 + kMargin * places[i].x())),
            static_cast<float>(0.5 + kMargin * places[i].y());
    }
    return uvs;
}

Uvs lip_uvs() {
    Uvs uvs(LipGrid::kRows * LipGrid::kColumns, 2);
    for (int i = 0; i < uvs.rows(); ++i) {
        uvs.row(i) << static_cast<float>(i % LipGrid::kColumns) / LipGrid::kColumns,
            static_cast<float>(i / LipGrid::kColumns) / (LipGrid::kRows - 1);
    }
    return uvs;
}

// A ring's u goes up one side and down the other, 0 at column 0 and 1 half way round, so that no triangle
// spans the whole texture where the ring closes.
void fold_round(Uvs& uvs, int columns, int rows) {
    for (int i = 0; i < columns * rows; ++i) {
        const double u = static_cast<double>(i % columns) / columns;
        uvs(i, 0) = static_cast<float>(u < 0.5 ? 2 * u : 2 - 2 * u);
    }
}

struct LashPlace {
    const char* name;
    int eye;  // 0 left, 1 right
    bool upper;
};
constexpr LashPlace kLashes[] = {{"lashes_upper_left", 0, true},
                                 {"lashes_lower_left", 0, false},
                                 {"lashes_upper_right", 1, true},
                                 {"lashes_lower_right", 1, false}};

Nodes roots_of(const std::vector<Anchor>& roots, const Nodes& scan) { return nodes_at(roots, scan); }

Nodes posed_lashes(const DisplayAnchors& anchors, const LashPlace& place, const Nodes& scan) {
    const auto& roots = anchors.lash_roots[static_cast<std::size_t>(2 * place.eye + (place.upper ? 0 : 1))];
    return lash_strip(roots_of(roots, scan), eye_ball(place.eye == 0 ? 1 : -1), place.upper);
}

void add_part(Face& face, const PartMesh& mesh) {
    const auto first = static_cast<int>(face.rest.rows());
    const auto count = static_cast<int>(mesh.nodes.rows());
    face.rest.conservativeResize(first + count, 3);
    face.rest.bottomRows(count) = mesh.nodes;
    face.uvs.conservativeResize(first + count, 2);
    face.uvs.bottomRows(count) = mesh.uvs;
    FacePart part{mesh.name, mesh.material, mesh.drive, first, count, mesh.triangles};
    for (Triangle& t : part.triangles) {
        for (int& node : t) node += first;
    }
    face.parts.push_back(std::move(part));
    for (int i = 0; i < count; ++i) face.weld.push_back(first + i);
}

// Every part at the posture of `scan`, in the face's order.
std::vector<PartMesh> parts_of(const BlendHead& head, const DisplayAnchors& anchors,
                               const Configuration& rest, const Nodes& lining, const Nodes& scan) {
    const JawMotion jaw = jaw_of(rest, head.points(scan));
    const LipContours contours = lip_contours(anchors, scan);
    std::vector<PartMesh> parts;
    parts.push_back({"skin", Material::kSkin, Drive::kModes, nodes_at(anchors.front, scan),
                     uvs_in(anchors.front_places, 0, 0.7), anchors.front_triangles});
    parts.push_back({"head_back", Material::kSkin, Drive::kModes, nodes_at(anchors.back, scan),
                     uvs_in(anchors.back_places, 0.7, 0.3), anchors.back_triangles});
    parts.push_back(
        {"lips", Material::kLips, Drive::kLips, lip_rows(contours), lip_uvs(), lip_triangles(LipGrid{})});
    fold_round(parts.back().uvs, LipGrid::kColumns, LipGrid::kRows);
    parts.push_back(mouth_lining(MouthLining::posed(lining, contours.inner, jaw)));
    fold_round(parts.back().uvs, MouthLining::kColumns, MouthLining::kRings);
    parts.push_back(upper_teeth());
    parts.push_back(lower_teeth());
    parts.back().nodes = on_jaw(parts.back().nodes, jaw);
    parts.push_back(upper_gums());
    parts.push_back(lower_gums());
    parts.back().nodes = on_jaw(parts.back().nodes, jaw);
    parts.push_back(tongue());
    fold_round(parts.back().uvs, TongueSweep::kAround, TongueSweep::kSections);
    parts.back().nodes =
        TongueSweep::posed(parts.back().nodes, tongue_points(rest), tongue_points(head.points(scan)), jaw);
    parts.push_back(eye(+1));
    parts.push_back(eye(-1));
    for (const LashPlace& place : kLashes) {
        const Nodes strip = posed_lashes(anchors, place, scan);
        const auto& roots =
            anchors.lash_roots[static_cast<std::size_t>(2 * place.eye + (place.upper ? 0 : 1))];
        parts.push_back(lashes(place.name, strip, static_cast<int>(roots.size()), place.upper,
                               (place.eye == 1) == place.upper));
    }
    return parts;
}

void weld_parts(Face& face, const DisplayAnchors& anchors) {
    const int skin = part_named(face, "skin").first_node, back = part_named(face, "head_back").first_node,
              lips = part_named(face, "lips").first_node, mouth = part_named(face, "mouth").first_node;
    const auto weld = [&](int node, int to) { face.weld[static_cast<std::size_t>(node)] = to; };
    for (int i = 0; i < anchors.ring; ++i) weld(back + i, skin + i);
    for (int c = 0; c < LipGrid::kColumns; ++c) {
        weld(lips + c, skin + anchors.border_first + c);
        weld(mouth + c, face.lips.node(LipGrid::kRows - 1, c));
    }
}

// How far hair stands off the scalp of a bare head, mm.
Nodes hair_over(const Face& bare) {
    NodesF normals;
    NodeNormals(bare).compute(bare.rest.cast<float>(), normals);
    Nodes hair = Nodes::Zero(bare.rest.rows(), 3);
    for (const FacePart& part : bare.parts) {
        if (part.material != Material::kSkin) continue;
        for (int i = part.first_node; i < part.first_node + part.nodes; ++i) {
            hair.row(i) =
                hair_thickness(bare.rest.row(i).transpose().cast<float>()) * normals.row(i).cast<double>();
        }
    }
    return hair;
}

Eigen::VectorXd flat(const Nodes& nodes) {
    return Eigen::Map<const Eigen::VectorXd>(nodes.data(), nodes.size());
}

}  // namespace

HeadToFace::HeadToFace(const BlendHead& head)
    : head_(head),
      anchors_(remesh_head(head)),
      rest_points_(head.points(head.neutral().nodes)),
      lining_(MouthLining::rest(lip_contours(anchors_, head.neutral().nodes).inner)),
      lowered_(lowered_lids(head)) {
    hair_ = hair_over(unposed());
}

Nodes HeadToFace::resting(const Nodes& scan) const { return scan + lowered_; }

std::vector<PartMesh> HeadToFace::parts(const Nodes& scan) const {
    auto parts = parts_of(head_, anchors_, rest_points_, lining_, resting(scan));
    Eigen::Index first = 0;
    for (PartMesh& part : parts) {
        if (hair_.rows() != 0) part.nodes += hair_.middleRows(first, part.nodes.rows());
        first += part.nodes.rows();
    }
    return parts;
}

Nodes HeadToFace::posed(const Nodes& scan) const {
    const auto parts = this->parts(scan);
    Eigen::Index count = 0;
    for (const PartMesh& part : parts) count += part.nodes.rows();
    Nodes nodes(count, 3);
    count = 0;
    for (const PartMesh& part : parts) {
        nodes.middleRows(count, part.nodes.rows()) = part.nodes;
        count += part.nodes.rows();
    }
    return nodes;
}

Face HeadToFace::unposed() const {
    Face face;
    face.jaw_hinge = kHinge;
    for (const PartMesh& part : parts(head_.pose(posture("closed_relaxed").weights))) add_part(face, part);
    face.lips.first_node = part_named(face, "lips").first_node;
    weld_parts(face, anchors_);
    return face;
}

Face make_face(const HeadToFace& source, const std::vector<Posture>& postures) {
    Face face = source.unposed();
    const BlendHead& head = source.head();
    Eigen::MatrixXd shapes(face.rest.size(), static_cast<Eigen::Index>(postures.size()));
    for (std::size_t k = 0; k < postures.size(); ++k) {
        shapes.col(static_cast<Eigen::Index>(k)) = flat(source.posed(head.pose(postures[k].weights)));
    }
    for (const FacePart& part : face.parts) {
        if (part.drive == Drive::kModes) continue;
        const auto rows = flat(face.rest).segment(3 * part.first_node, 3 * part.nodes);
        shapes.middleRows(3 * part.first_node, 3 * part.nodes).colwise() = rows;
    }
    const PrincipalComponents components = principal_components(shapes, -1, kModeTolerance);
    face.mean = components.mean;
    face.modes = components.modes;
    face.mode_variance = components.variance;
    const Nodes neutral = source.posed(head.neutral().nodes);
    for (const std::string& name : head.shape_names()) {
        const double whole = name.starts_with("eyeBlink") ? 1 - kRestingLids : 1;
        face.shapes.push_back({name, source.posed(head.pose({{name, whole}})) - neutral});
    }
    return face;
}

PoseTraining pose_training(const HeadToFace& source, const Face& face, const std::vector<Posture>& postures) {
    const BlendHead& head = source.head();
    const auto count = static_cast<Eigen::Index>(postures.size());
    PoseTraining training;
    training.rest = head.points(head.pose(posture("closed_relaxed").weights));
    training.configurations.resize(kCoordinates, count);
    training.coefficients.resize(face.modes.cols(), count);
    training.contours.resize(PoseTraining::kContourNumbers, count);
    for (Eigen::Index k = 0; k < count; ++k) {
        const Nodes scan = head.pose(postures[static_cast<std::size_t>(k)].weights);
        training.configurations.col(k) = head.points(scan);
        training.coefficients.col(k) = face.modes.transpose() * (flat(source.posed(scan)) - face.mean);
        const LipContours contours = lip_contours(source.anchors(), scan);
        training.contours.col(k) << Eigen::Map<const Eigen::VectorXd>(contours.middle.data(),
                                                                      3 * LipGrid::kColumns),
            Eigen::Map<const Eigen::VectorXd>(contours.inner.data(), 3 * LipGrid::kColumns);
    }
    return training;
}

}  // namespace viaface

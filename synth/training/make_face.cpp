#include "synth/training/make_face.hpp"

#include <algorithm>
#include <cmath>

#include "synth/picture/surface_frame.hpp"
#include "synth/pose/inside.hpp"
#include "synth/training/hair_knot.hpp"
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

// Textures repeat: what ends at their rim would show the colour of the other end.
constexpr double kOffRim = 0.03;
float off_rim(double place) { return static_cast<float>(kOffRim + (1 - 2 * kOffRim) * place); }

Uvs lip_uvs() {
    Uvs uvs(LipGrid::kRows * LipGrid::kColumns, 2);
    for (int i = 0; i < uvs.rows(); ++i) {
        uvs.row(i) << static_cast<float>(i % LipGrid::kColumns) / LipGrid::kColumns,
            off_rim(i / LipGrid::kColumns / (LipGrid::kRows - 1.0));
    }
    return uvs;
}

// A ring's u goes up one side and down the other, least at column 0 and most half way round, so that no
// triangle spans the whole texture where the ring closes.
void fold_round(Uvs& uvs, int columns, int rows) {
    for (int i = 0; i < columns * rows; ++i) {
        const double u = static_cast<double>(i % columns) / columns;
        uvs(i, 0) = off_rim(u < 0.5 ? 2 * u : 2 - 2 * u);
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

Nodes posed_lashes(const DisplayAnchors& anchors, const LashPlace& place, const EyeBall& ball,
                   const Nodes& scan) {
    const auto& roots = anchors.lash_roots[static_cast<std::size_t>(2 * place.eye + (place.upper ? 0 : 1))];
    return lash_strip(roots_of(roots, scan), ball, place.upper);
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
std::vector<PartMesh> parts_of(const BlendHead& head, const DisplayAnchors& anchors, const BesideScan& beside,
                               const Nodes& scan) {
    const Configuration& rest = beside.points;
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
    parts.push_back(mouth_lining(MouthLining::posed(beside.lining, contours.inner, jaw)));
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
    parts.push_back(eye(+1, beside.eyes[0]));
    parts.push_back(eye(-1, beside.eyes[1]));
    for (const LashPlace& place : kLashes) {
        const Nodes strip =
            posed_lashes(anchors, place, beside.eyes[static_cast<std::size_t>(place.eye)], scan);
        const auto& roots =
            anchors.lash_roots[static_cast<std::size_t>(2 * place.eye + (place.upper ? 0 : 1))];
        parts.push_back(lashes(place.name, strip, static_cast<int>(roots.size()), place.upper,
                               (place.eye == 1) == place.upper));
    }
    if (beside.knot) parts.push_back(hair_knot(*beside.knot));
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

// How far hair stands off the scalp of a bare head, mm. places: of its nodes on the head without identity.
Nodes hair_over(const Face& bare, const Nodes& places, const HairStyle& style) {
    NodesF normals;
    NodeNormals(bare).compute(bare.rest.cast<float>(), normals);
    Nodes hair = Nodes::Zero(bare.rest.rows(), 3);
    for (const FacePart& part : bare.parts) {
        if (part.material != Material::kSkin) continue;
        for (int i = part.first_node; i < part.first_node + part.nodes; ++i) {
            hair.row(i) = hair_thickness(style, places.row(i).transpose().cast<float>()) *
                          normals.row(i).cast<double>();
        }
    }
    return hair;
}

// The eye of the head without identity, moved and sized as the scan's eyeball is.
EyeBall eye_on(const Nodes& generic, const Nodes& neutral, double side) {
    const auto ball_of = [&](const Nodes& nodes) {
        std::vector<int> which;
        for (int i = BlendHead::kEyeballs.first; i < BlendHead::kEyeballs.last; ++i) {
            if (side * generic(i, 0) > 0) which.push_back(i);
        }
        const Nodes ball = nodes(which, Eigen::all);
        const Eigen::RowVector3d middle = ball.colwise().mean();
        return std::pair<Vector3d, double>(middle, (ball.rowwise() - middle).norm());
    };
    const auto [from, from_size] = ball_of(generic);
    const auto [to, to_size] = ball_of(neutral);
    return {eye_ball(side).centre + (to - from), to_size / from_size};
}

// How far the head's node next to a place has moved.
Eigen::Vector3f shift_near(const Nodes& generic, const Nodes& neutral, const Eigen::Vector3f& place) {
    Eigen::Index nearest = 0;
    const auto head = generic.topRows(BlendHead::kHeadAndNeck.last);
    (head.rowwise() - place.cast<double>().transpose()).rowwise().squaredNorm().minCoeff(&nearest);
    return (neutral.row(nearest) - generic.row(nearest)).cast<float>().transpose();
}

Eigen::VectorXd flat(const Nodes& nodes) {
    return Eigen::Map<const Eigen::VectorXd>(nodes.data(), nodes.size());
}

}  // namespace

HeadToFace::HeadToFace(const BlendHead& head, const HairStyle& hair)
    : head_(head),
      anchors_(remesh_head(head)),
      beside_(beside(head.neutral().nodes, hair)),
      generic_beside_(beside(head.generic(), hair)),
      lowered_(lowered_lids(head)) {
    const Face bare = unposed(), bare_canvas = canvas();
    hair_ = hair_over(bare, bare_canvas.rest, hair);
    generic_hair_ = hair_over(bare_canvas, bare_canvas.rest, hair);
}

BesideScan HeadToFace::beside(const Nodes& neutral, const HairStyle& hair) const {
    BesideScan beside{head_.points(neutral),
                      MouthLining::rest(lip_contours(anchors_, neutral).inner),
                      {eye_on(head_.generic(), neutral, +1), eye_on(head_.generic(), neutral, -1)},
                      hair.knot};
    if (beside.knot) beside.knot->middle += shift_near(head_.generic(), neutral, beside.knot->middle);
    return beside;
}

Nodes HeadToFace::resting(const Nodes& scan) const { return scan + lowered_; }

Nodes HeadToFace::posed(const Nodes& scan) const {
    const auto parts = parts_of(head_, anchors_, beside_, resting(scan));
    Nodes nodes = hair_;
    Eigen::Index first = 0;
    for (const PartMesh& part : parts) {
        nodes.middleRows(first, part.nodes.rows()) += part.nodes;
        first += part.nodes.rows();
    }
    return nodes;
}

Face HeadToFace::face_of(const BesideScan& beside, const Nodes& hair, const Nodes& scan) const {
    Face face;
    face.jaw_hinge = kHinge;
    for (const PartMesh& part : parts_of(head_, anchors_, beside, resting(scan))) add_part(face, part);
    if (hair.rows() != 0) face.rest += hair;
    face.lips.first_node = part_named(face, "lips").first_node;
    weld_parts(face, anchors_);
    return face;
}

Face HeadToFace::unposed() const {
    return face_of(beside_, hair_, head_.pose(posture("closed_relaxed").weights));
}

Face HeadToFace::canvas() const {
    const Nodes to_generic = head_.generic() - head_.neutral().nodes;
    return face_of(generic_beside_, generic_hair_,
                   head_.pose(posture("closed_relaxed").weights) + to_generic);
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

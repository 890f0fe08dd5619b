#include "synth/training/report.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "base/decompositions.hpp"

namespace viaface {
namespace {

using Eigen::MatrixXd, Eigen::Vector3d, Eigen::VectorXd;

// Small modes of many postures hardly move a marker: without a ridge they are drawn centimetres too large
// from whatever the postures do not span.
constexpr double kTalkerNoise = 0.1;                    // mm
constexpr int kFacePoints = kFaceMarkers + kLipPoints;  // the layout's first 34

// Postures in neither set: mixes within the span of the talker's shapes, then shapes outside it.
const std::vector<Posture> kUnseen = {
    {"p within /a/", {{"jawOpen", .30}, {"mouthClose", .30}, {"mouthPress", .30}}},
    {"v within /u/",
     {{"jawOpen", .05}, {"mouthPucker", .40}, {"mouthRollLower", .45}, {"mouthUpperUp", .20}}},
    {"laughing", {{"jawOpen", .45}, {"mouthSmile", .80}, {"mouthUpperUp", .30}}},
    {"rounded /i/", {{"jawOpen", .08}, {"mouthPucker", .50}, {"mouthStretch", .20}}},
    {"half /a/", {{"jawOpen", .20}, {"mouthLowerDown", .06}, {"mouthUpperUp", .04}}},
    {"pressed left *", {{"mouthPress_L", .80}}},
    {"jaw to the left *", {{"jawLeft", .60}, {"jawOpen", .10}}},
    {"squinting smile *", {{"cheekSquint", .60}, {"mouthSmile", .30}}},
};

MatrixXd shapes_of(const std::vector<FittedPosture>& fitted) {
    MatrixXd shapes(3 * GenericMesh::kNodes, fitted.size());
    for (std::size_t k = 0; k < fitted.size(); ++k) shapes.col(k) = as_shape(fitted[k].face.nodes);
    return shapes;
}

MatrixXd points_of(const std::vector<FittedPosture>& fitted) {
    MatrixXd points(3 * kFacePoints, fitted.size());
    for (std::size_t k = 0; k < fitted.size(); ++k)
        points.col(k) = fitted[k].scan.points.head(3 * kFacePoints);
    return points;
}

MatrixXd markers_of(const GenericMesh& mesh, const MatrixXd& shapes) {
    MatrixXd markers(3 * kMarkers, shapes.cols());
    for (Eigen::Index k = 0; k < shapes.cols(); ++k) markers.col(k) = marker_positions(mesh, shapes.col(k));
    return markers;
}

std::vector<double> node_distances(const VectorXd& a, const VectorXd& b) {
    std::vector<double> found;
    for (Eigen::Index i = 0; i < a.size(); i += 3) found.push_back((a - b).segment<3>(i).norm());
    return found;
}

// Eqs. 1-15 on one set of postures.
struct FaceModel {
    FaceModel(const GenericMesh& mesh, const std::vector<FittedPosture>& postures, double noise_mm)
        : mesh(mesh),
          shapes(shapes_of(postures)),
          components(principal_components(shapes)),
          points(principal_components(points_of(postures))),
          estimator(LinearEstimator(markers_of(mesh, shapes), components.all_coefficients(shapes),
                                    {.noise_mm = noise_mm})
                        .for_presence(Presence(kMarkers, true))) {}

    VectorXd drawn(const VectorXd& shape) const {
        return components.shape(estimator.estimate(marker_positions(mesh, shape)));
    }

    UnseenFigures judge(const FittedPosture& posture) const {
        const VectorXd shape = as_shape(posture.face.nodes);
        const VectorXd nearest = components.shape(components.coefficients(shape));
        const std::vector<double> off = node_distances(drawn(shape), shape);
        std::vector<double> lips;
        for (const int node : mesh.contours[kMouthContour]) lips.push_back(off[node]);
        const VectorXd asked = posture.scan.points.head(3 * kFacePoints);
        const auto beyond = node_distances(points.shape(points.coefficients(asked)), asked);
        return {posture.name, distances(node_distances(nearest, shape)), distances(off), distances(lips),
                distances(beyond)};
    }

    const GenericMesh& mesh;
    MatrixXd shapes;  // F
    PrincipalComponents components;
    PrincipalComponents points;  // of the 34 points by themselves
    EstimatorFor estimator;
};

double condition_of(const GenericMesh& mesh, const FaceModel& model) {
    const MatrixXd markers = markers_of(mesh, model.shapes);
    const VectorXd s = thin_svd(markers.colwise() - markers.rowwise().mean()).s;
    return s[0] / s[model.estimator.rank() - 1];
}

ModelFigures judge_model(const GenericMesh& mesh, const std::vector<FittedPosture>& postures,
                         const std::vector<FittedPosture>& unseen, double noise_mm) {
    const FaceModel model(mesh, postures, noise_mm);
    ModelFigures figures;
    figures.noise_mm = noise_mm;
    figures.postures = static_cast<int>(postures.size());
    figures.components = static_cast<int>(model.components.modes.cols());
    figures.share = model.components.share();
    figures.condition = condition_of(mesh, model);
    for (const FittedPosture& p : postures) {
        const VectorXd shape = as_shape(p.face.nodes);
        figures.trained_max =
            std::max(figures.trained_max, std::ranges::max(node_distances(model.drawn(shape), shape)));
    }
    for (std::size_t k = 0; k < postures.size(); ++k) {
        std::vector<FittedPosture> others = postures;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
        figures.left_out.push_back(FaceModel(mesh, others, noise_mm).judge(postures[k]));
    }
    for (const FittedPosture& p : unseen) figures.unseen.push_back(model.judge(p));
    return figures;
}

FitFigures judge_fit(const GenericMesh& mesh, const FittedPosture& posture) {
    const std::vector<FitSample> samples = fit_samples(mesh, posture.face, posture.scan.range);
    std::vector<double> surface;
    for (const FitSample& s : samples) surface.push_back(s.distance);
    std::vector<double> markers;
    for (int i = 0; i < kMarkers; ++i) {
        markers.push_back(
            (posture.face.nodes.row(mesh.markers[i]).transpose() - point_of(posture.scan.points, i)).norm());
    }
    const auto worst = std::ranges::max_element(samples, {}, &FitSample::distance);
    return {posture.name, distances(surface), worst->place, distances(markers)};
}

std::vector<FittedPosture> fit_all(const BlendHead& head, const GenericMesh& mesh,
                                   const std::vector<Posture>& postures) {
    std::vector<FittedPosture> fitted;
    for (const Posture& p : postures) fitted.push_back(fit(head, mesh, p));
    return fitted;
}

}  // namespace

Distances distances(std::vector<double> values) {
    if (values.empty()) throw std::invalid_argument("distances: none");
    std::ranges::sort(values);
    const double count = static_cast<double>(values.size());
    const double sum = std::accumulate(values.begin(), values.end(), 0.0);
    const double squares = std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
    return {sum / count, std::sqrt(squares / count), values[(values.size() - 1) * 95 / 100], values.back()};
}

AtrReport measure_atr(const BlendHead& head) {
    const GenericMesh mesh = generic_mesh();
    const std::vector<FittedPosture> talker = fit_all(head, mesh, talker_postures());
    const std::vector<FittedPosture> eight(
        talker.begin(), talker.begin() + static_cast<std::ptrdiff_t>(report_postures().size()));
    const std::vector<FittedPosture> unseen = fit_all(head, mesh, kUnseen);
    AtrReport report;
    report.nodes = static_cast<int>(mesh.flat.rows());
    report.polygons = static_cast<int>(mesh.polygons.size());
    report.quads =
        static_cast<int>(std::ranges::count_if(mesh.polygons, [](const Polygon& p) { return p[3] >= 0; }));
    report.scan_samples = eight.front().scan.range.samples();
    for (const FittedPosture& p : eight) report.fit.push_back(judge_fit(mesh, p));
    report.eight = judge_model(mesh, eight, unseen, 0);
    report.talker = judge_model(mesh, talker, unseen, kTalkerNoise);
    for (const UnseenFigures& u : judge_model(mesh, talker, {}, 0).left_out) {
        report.talker_unridged_max = std::max(report.talker_unridged_max, u.drawn.max);
    }
    const FaceModel model(mesh, eight, 0);
    for (const FittedPosture& p : talker) {
        if (p.name == "m_pressed" || p.name == "f") report.beyond_eight.push_back(model.judge(p));
    }
    return report;
}

std::string atr_report(const BlendHead& head) { return as_text(measure_atr(head)); }

}  // namespace viaface

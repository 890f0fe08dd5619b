#include "synth/scans/face_finder.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <opencv2/objdetect.hpp>

#include "base/median.hpp"

namespace viaface {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

constexpr int kSide = 400;  // pixels
constexpr double kLikelihood = 0.5;

cv::CascadeClassifier cascade(const char* name) {
    cv::CascadeClassifier found;
    if (!found.load(std::string(VIAFACE_CASCADES) + "/" + name))
        throw std::runtime_error(std::string("the cascade ") + name +
                                 " cannot be read (package opencv-data)");
    return found;
}

// Colours where there are any, else as lit from the viewer.
cv::Mat grey_picture(const SurfaceView& view, bool painted) {
    cv::Mat grey(view.window.height, view.window.width, CV_8U, cv::Scalar(0));
    for (int y = 0; y < view.window.height; ++y) {
        for (int x = 0; x < view.window.width; ++x) {
            const std::size_t pixel = view.at(x, y);
            if (std::isnan(view.depth[pixel])) continue;
            const float shade = painted ? view.colours[pixel].dot(Eigen::Vector3f(0.299f, 0.587f, 0.114f))
                                        : 230 * std::abs(view.facing[pixel]);
            grey.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(std::clamp(shade, 0.0f, 255.0f));
        }
    }
    cv::Mat smaller, even;
    cv::resize(grey, smaller, {}, 0.5, 0.5, cv::INTER_AREA);
    cv::equalizeHist(smaller, even);
    return even;
}

double median_depth(const SurfaceView& view, const cv::Rect& box) {
    std::vector<double> depths;
    for (int y = 2 * box.y + box.height / 2; y < 2 * box.y + 3 * box.height / 2; ++y) {
        for (int x = 2 * box.x + box.width / 2; x < 2 * box.x + 3 * box.width / 2; ++x) {
            const float z = view.depth[view.at(x, y)];
            if (!std::isnan(z)) depths.push_back(z);
        }
    }
    return depths.empty() ? 0 : median(depths);
}

int eyes_in(const cv::Mat& face) {
    static const cv::CascadeClassifier kept = cascade("haarcascade_eye.xml");
    cv::CascadeClassifier finder = kept;
    std::vector<cv::Rect> eyes;
    cv::Mat upper = face(cv::Rect(0, 0, face.cols, face.rows * 6 / 10)), large;
    cv::resize(upper, large, {}, 2, 2);
    finder.detectMultiScale(large, eyes, 1.1, 3, 0, {face.cols / 4, face.cols / 4});
    return std::min<int>(2, static_cast<int>(eyes.size()));
}

int worth(const FaceBox& box) { return box.votes * (1 + box.eyes); }

std::vector<Matrix3d> axis_turns() {
    std::vector<Matrix3d> turns;
    std::array<int, 3> order = {0, 1, 2};
    do {
        for (int signs = 0; signs < 8; ++signs) {
            Matrix3d turn = Matrix3d::Zero();
            for (int k = 0; k < 3; ++k) turn(k, order[k]) = signs >> k & 1 ? -1 : 1;
            if (turn.determinant() > 0) turns.push_back(turn);
        }
    } while (std::next_permutation(order.begin(), order.end()));
    return turns;
}

// Upright along each axis, looking the way that the surface looks, or its opposite.
void add_turns_by_normal(const ScanMesh& mesh, std::vector<Matrix3d>& turns) {
    Vector3d sum = Vector3d::Zero();
    double area = 0;
    for (const Triangle& t : mesh.triangles) {
        const Vector3d a = mesh.nodes.row(t[0]), b = mesh.nodes.row(t[1]), c = mesh.nodes.row(t[2]);
        const Vector3d normal = (b - a).cross(c - a);
        sum += normal;
        area += normal.norm();
    }
    if (sum.norm() < 0.2 * area) return;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double up_sign : {1.0, -1.0}) {
            for (const double sign : {1.0, -1.0}) {
                const Vector3d up = up_sign * Vector3d::Unit(axis), level = sum - up * up.dot(sum);
                if (level.norm() < 0.3 * sum.norm()) continue;
                const Vector3d forward = sign * level.normalized();
                Matrix3d turn;
                turn << up.cross(forward).transpose(), up.transpose(), forward.transpose();
                turns.push_back(turn);
            }
        }
    }
}

}  // namespace

std::vector<FaceBox> frontal_faces(std::span<const PaintedSurface* const> surfaces) {
    static const cv::CascadeClassifier kept = cascade("haarcascade_frontalface_alt2.xml");
    cv::CascadeClassifier finder = kept;
    Nodes all(0, 3);
    bool painted = true;
    for (const PaintedSurface* surface : surfaces) {
        painted = painted && surface->painted();
        all.conservativeResize(all.rows() + surface->mesh.nodes.rows(), 3);
        all.bottomRows(surface->mesh.nodes.rows()) = surface->mesh.nodes;
    }
    const SurfaceView view = look(surfaces, window_round(all, 2 * kSide));
    std::vector<FaceBox> found;
    for (const bool colours : {true, false}) {
        if (colours && !painted) continue;
        const cv::Mat grey = grey_picture(view, colours);
        std::vector<cv::Rect> boxes;
        std::vector<int> votes;
        finder.detectMultiScale(grey, boxes, votes, 1.06, 2, 0, {kSide / 8, kSide / 8});
        for (std::size_t k = 0; k < boxes.size(); ++k) {
            const cv::Rect& box = boxes[k];
            const auto middle = view.window.place(2 * box.x + box.width, 2 * box.y + box.height);
            found.push_back({middle.x(), middle.y(), 2 * box.width / view.window.per_unit,
                             median_depth(view, box), votes[k], eyes_in(grey(box))});
        }
    }
    std::ranges::stable_sort(found, [](const FaceBox& a, const FaceBox& b) { return worth(a) > worth(b); });
    return found;
}

std::vector<FoundFace> find_faces(const PaintedSurface& scan, const std::optional<Matrix3d>& axes) {
    constexpr std::size_t kMost = 10;
    std::vector<FoundFace> found;
    std::vector<Matrix3d> turns = axes ? std::vector<Matrix3d>{*axes} : axis_turns();
    if (!axes) add_turns_by_normal(scan.mesh, turns);
    for (const Matrix3d& turn : turns) {
        PaintedSurface turned = scan;
        turned.mesh.nodes = scan.mesh.nodes * turn.transpose();
        const PaintedSurface* seen[] = {&turned};
        const auto faces = frontal_faces(seen);
        for (std::size_t k = 0; k < faces.size() && k < 3; ++k) {
            found.push_back({turn, faces[k], {}});
            for (const FaceBox& other : faces) {
                const double apart = std::hypot(other.x - faces[k].x, other.y - faces[k].y);
                const bool alike = other.side > 0.7 * faces[k].side && other.side < 1.4 * faces[k].side;
                if (apart > 0.8 * faces[k].side && alike && worth(other) >= kLikelihood * worth(faces[k]))
                    found.back().others.push_back(other);
            }
        }
    }
    std::ranges::stable_sort(
        found, [](const FoundFace& a, const FoundFace& b) { return worth(a.box) > worth(b.box); });
    if (found.size() > kMost) found.resize(kMost);
    return found;
}

std::optional<Eigen::Vector2d> eye_near(const SurfaceView& view, const Eigen::Vector2d& about) {
    constexpr double kFar = 15, kSmallest = 24, kLargest = 60;  // mm
    static const cv::CascadeClassifier kept = cascade("haarcascade_eye.xml");
    cv::CascadeClassifier finder = kept;
    const cv::Mat grey = grey_picture(view, true);
    const double per_mm = view.window.per_unit / 2;
    std::vector<cv::Rect> boxes;
    std::vector<int> votes;
    const auto pixels = [&](double mm) { return static_cast<int>(mm * per_mm); };
    finder.detectMultiScale(grey, boxes, votes, 1.04, 2, 0, {pixels(kSmallest), pixels(kSmallest)},
                            {pixels(kLargest), pixels(kLargest)});
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    double weight = 0;
    for (std::size_t k = 0; k < boxes.size(); ++k) {
        const Eigen::Vector2d middle =
            view.window.place(2 * boxes[k].x + boxes[k].width, 2 * boxes[k].y + boxes[k].height);
        if ((middle - about).norm() > kFar) continue;
        sum += votes[k] * middle;
        weight += votes[k];
    }
    if (weight == 0) return std::nullopt;
    return Eigen::Vector2d(sum / weight);
}

}  // namespace viaface

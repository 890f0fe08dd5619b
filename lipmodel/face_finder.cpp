#include "lipmodel/face_finder.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <opencv2/objdetect.hpp>
#include <stdexcept>

#include "lipmodel/iris.hpp"

namespace viaface {
namespace {

constexpr int kLongestSide = 320;   // px of the picture that is searched
constexpr int kSmallestFace = 20;   // px there
constexpr double kGrowth = 1.4;     // of a face from one picture to another
constexpr double kSame = 0.5;       // distances of the eyes: no other face is as near
constexpr double kEyeHeight = 0.4;  // of the box, where eyes are in most faces
constexpr double kEyeReach = 0.09;  // of the face's width
constexpr double kEyePlace = 0.29;  // of the box, from its sides

cv::CascadeClassifier loaded(const std::filesystem::path& file) {
    cv::CascadeClassifier cascade;
    if (!std::filesystem::exists(file) || !cascade.load(file.string()))
        throw std::runtime_error("no cascade at " + file.string() +
                                 " (the package opencv-data brings it; $VIAFACE_CASCADES names its folder)");
    return cascade;
}

cv::Mat grey(const Picture& picture) {
    const cv::Mat rgb(picture.height, picture.width, CV_8UC3,
                      const_cast<std::uint8_t*>(picture.rgb.data()));  // read only
    cv::Mat made;
    cv::cvtColor(rgb, made, cv::COLOR_RGB2GRAY);
    return made;
}

Eigen::Vector2d middle_of(const cv::Rect& box) {
    return {box.x + 0.5 * (box.width - 1), box.y + 0.5 * (box.height - 1)};
}

// The eye among those found in a half of the face: the one nearest to where eyes are.
std::optional<Eigen::Vector2d> nearest(const std::vector<cv::Rect>& found, const Eigen::Vector2d& usual,
                                       double reach) {
    std::optional<Eigen::Vector2d> best;
    for (const cv::Rect& box : found) {
        const Eigen::Vector2d place = middle_of(box);
        if ((place - usual).norm() > reach) continue;
        if (!best || (place - usual).norm() < (*best - usual).norm()) best = place;
    }
    return best;
}

// The iris of an eye whose place is known within `reach` px; that place where the picture ends before it.
Eigen::Vector2d iris_about(const Picture& picture, const Eigen::Vector2d& eye, double reach) {
    const PictureBox box{
        static_cast<int>(std::lround(eye.x() - reach)), static_cast<int>(std::lround(eye.y() - reach)),
        2 * static_cast<int>(std::lround(reach)) + 1, 2 * static_cast<int>(std::lround(reach)) + 1};
    const bool inside = box.left >= 0 && box.top >= 0 && box.left + box.width <= picture.width &&
                        box.top + box.height <= picture.height;
    return inside && box.width >= 3 ? iris_in(picture, box) : eye;
}

cv::Rect largest(const std::vector<cv::Rect>& faces) {
    return *std::ranges::max_element(faces, {},
                                     [](const cv::Rect& r) { return std::tuple(r.area(), -r.x, -r.y); });
}

// By the place of the eyes, in distances of the eyes, and by their distance. The box is in a picture so many
// times smaller.
double unlike(const cv::Rect& box, const FaceInPicture& before, double shrink) {
    const double width = box.width * shrink;
    const Eigen::Vector2d middle =
        shrink * Eigen::Vector2d(box.x, box.y) + width * Eigen::Vector2d(0.5, kEyeHeight);
    return (middle - before.middle()).norm() / before.eye_distance() +
           std::abs(std::log((1 - 2 * kEyePlace) * width / before.eye_distance()));
}

cv::Rect most_like(const std::vector<cv::Rect>& faces, const FaceInPicture& before, double shrink) {
    return *std::ranges::min_element(faces, {},
                                     [&](const cv::Rect& box) { return unlike(box, before, shrink); });
}

std::vector<cv::Rect> faces_in(cv::CascadeClassifier& cascade, const cv::Mat& small, int least, int most) {
    std::vector<cv::Rect> faces;
    cascade.detectMultiScale(small, faces, 1.1, 3, 0, {least, least}, {most, most});
    return faces;
}

// Faces of about the size that there was before, should one be where it was: most of the work is in the small
// sizes. Else of all.
std::vector<cv::Rect> faces_in(cv::CascadeClassifier& cascade, const cv::Mat& small,
                               const std::optional<FaceInPicture>& before, double shrink) {
    const int all = std::min(small.cols, small.rows);
    if (before) {
        const double width = before->eye_distance() / (1 - 2 * kEyePlace) / shrink;
        const int least = static_cast<int>(width / kGrowth), most = static_cast<int>(width * kGrowth);
        if (least > kSmallestFace) {
            auto faces = faces_in(cascade, small, least, std::min(most, all));
            if (!faces.empty() && unlike(most_like(faces, *before, shrink), *before, shrink) < kSame)
                return faces;
        }
    }
    return faces_in(cascade, small, kSmallestFace, all);
}

}  // namespace

std::filesystem::path cascades_folder() {
    const char* given = std::getenv("VIAFACE_CASCADES");
    return given != nullptr ? given : VIAFACE_CASCADES_FOLDER;
}

struct FaceFinder::Cascades {
    cv::CascadeClassifier face, eye;
};

FaceFinder::FaceFinder(const std::filesystem::path& cascades)
    : cascades_(std::make_unique<Cascades>(loaded(cascades / "haarcascade_frontalface_alt2.xml"),
                                           loaded(cascades / "haarcascade_eye.xml"))) {
    cv::setNumThreads(1);
}

FaceFinder::~FaceFinder() = default;

std::optional<FaceInPicture> FaceFinder::find(const Picture& picture,
                                              const std::optional<FaceInPicture>& before) {
    const cv::Mat whole = grey(picture);
    const double shrink = std::max(1.0, std::max(picture.width, picture.height) / double{kLongestSide});
    cv::Mat small;
    cv::resize(whole, small, {}, 1 / shrink, 1 / shrink, cv::INTER_AREA);
    const std::vector<cv::Rect> faces = faces_in(cascades_->face, small, before, shrink);
    if (faces.empty()) return std::nullopt;
    const cv::Rect box = before ? most_like(faces, *before, shrink) : largest(faces);
    std::vector<cv::Rect> eyes;
    const cv::Rect upper(box.x, box.y + box.height / 8, box.width, box.height / 2);
    const int least = std::max(6, box.width / 8), most = box.width / 2;
    cascades_->eye.detectMultiScale(small(upper & cv::Rect({}, small.size())), eyes, 1.05, 3, 0,
                                    {least, least}, {most, most});
    for (cv::Rect& eye : eyes) eye += upper.tl();
    const double width = box.width;
    const Eigen::Vector2d corner(box.x, box.y),
        usual_left = corner + width * Eigen::Vector2d(kEyePlace, kEyeHeight),
        usual_right = corner + width * Eigen::Vector2d(1 - kEyePlace, kEyeHeight);
    const auto left = nearest(eyes, usual_left, 0.15 * width),
               right = nearest(eyes, usual_right, 0.15 * width);
    const auto in_picture = [&](const Eigen::Vector2d& place) {
        return Eigen::Vector2d((place.array() + 0.5) * shrink - 0.5);
    };
    const auto eye = [&](const std::optional<Eigen::Vector2d>& found, const Eigen::Vector2d& usual) {
        return left && right ? iris_about(picture, in_picture(*found), kEyeReach * width * shrink)
                             : in_picture(usual);
    };
    return FaceInPicture{.left_eye = eye(left, usual_left),
                         .right_eye = eye(right, usual_right),
                         .eyes_seen = left && right,
                         .faces = static_cast<int>(faces.size())};
}

}  // namespace viaface

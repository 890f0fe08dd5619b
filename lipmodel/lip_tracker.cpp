#include "lipmodel/lip_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/error.hpp"
#include "lipmodel/closed_lips.hpp"
#include "lipmodel/lip_regions.hpp"
#include "lipmodel/lip_thickness.hpp"
#include "lipmodel/mouth_samples.hpp"
#include "lipmodel/side_light.hpp"

namespace viaface {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kFocal = 1.5;      // of the picture's longer side
constexpr double kLeastMouth = 12;  // px wide
constexpr double kLeastLikeness = 0.7, kLeastConfidence = 0.45;
constexpr double kLeastSaturation = 0.05;  // of a lower face in colour
constexpr std::size_t kMostSamples = 200;  // of a class
constexpr int kRounds = 3;                 // of fitting scales and classes in turns
constexpr int kPatience = 3;               // pictures of low confidence until the track is lost
constexpr double kThicknessSd = 1;         // mm
constexpr double kLeastFit = 0.3;          // of a sample's colour in its class, beside the best
constexpr double kCertainty = 0.5;         // gamma, of what the maps' independence allows
constexpr PoseFreedom kFirstFreedom{.turn = 0.03, .shift = 3, .scale = 0.1};
constexpr PoseFreedom kFreedom{.turn = 0.02, .shift = 0.7, .scale = 0};

// mm per px at the lips' depth, and where the head's origin then is.
struct Placing {
    Pinhole camera;
    double px_per_mm;
    Vector3d lips_centre;  // of the mean shape's border, model frame

    LipPose pose(const Vector2d& centre, double roll, double shrink, const Vector3d& scale) const {
        LipPose made;
        made.turn = {0, 0, roll};
        made.scale = scale;
        const double depth = camera.focal_px / (px_per_mm * shrink);
        const Vector2d ray = (centre - camera.centre_px) / camera.focal_px;
        made.shift = depth * Vector3d(ray.x(), ray.y(), 1) - camera_from_head(made) * lips_centre;
        return made;
    }
};

struct Extent {
    Vector3d centre, size;
};
Extent border_extent(const LipModel& model) {
    const Nodes shape = as_lip_nodes(lip_shape(model, Eigen::VectorXd::Zero(model.modes.cols())));
    const auto border = shape.middleRows(LipMesh::node(LipMesh::kBorderRing, 0), LipMesh::kColumns);
    const Eigen::RowVector3d least = border.colwise().minCoeff(), most = border.colwise().maxCoeff();
    return {0.5 * (least + most).transpose(), (most - least).transpose()};
}

PictureBox box_about(const Picture& picture, const Vector2d& centre, double half_width, double half_height) {
    const int left = std::clamp(static_cast<int>(centre.x() - half_width), 0, picture.width - 2),
              top = std::clamp(static_cast<int>(centre.y() - half_height), 0, picture.height - 2),
              right = std::clamp(static_cast<int>(centre.x() + half_width) + 1, left + 1, picture.width - 1),
              bottom =
                  std::clamp(static_cast<int>(centre.y() + half_height) + 1, top + 1, picture.height - 1);
    return {left, top, right - left + 1, bottom - top + 1};
}

// Brows to nose: what speech leaves still.
PictureBox still_part(const Picture& picture, const FaceInPicture& face) {
    const double far = face.eye_distance();
    return box_about(picture, face.middle() + 0.2 * far * face.down(), 0.75 * far, 0.5 * far);
}

template <typename T>
T median(std::vector<T> values) {
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
    return values[values.size() / 2];
}

struct Climbed {
    Eigen::VectorXd p = {};
    LipPose pose = {};
    double log_posterior = -std::numeric_limits<double>::infinity(), confidence = 0;
    int iterations = 0;
};

// One of the first pictures, evened, while scales and classes are fitted.
struct Fitting {
    const FaceSeen& seen;
    std::vector<std::uint8_t> rgb;
    MouthInPicture mouth;
    LipPose pose = {};
    Eigen::VectorXd p = {};

    Picture picture() const { return {seen.picture.width, seen.picture.height, rgb}; }
};

PictureBox all_of(const Picture& picture) { return {0, 0, picture.width, picture.height}; }

SideLight side_light(std::span<const FaceSeen> seen) {
    std::vector<double> slopes[3];
    for (const FaceSeen& s : seen) {
        const SideLight light = side_light(s.picture, s.face);
        for (int c = 0; c < 3; ++c) slopes[c].push_back(light.slope[c]);
    }
    return {{median(slopes[0]), median(slopes[1]), median(slopes[2])}};
}

void add(std::vector<Rgb>& kept, const std::vector<Rgb>& samples, const ColourClasses& classes,
         double ClassFit::*fit, double least) {
    for (const Rgb& colour : samples) {
        if (fit_of(classes, colour).*fit >= least) kept.push_back(colour);
    }
}

// Evenly: so many tell as much as all, and sooner.
std::vector<Rgb> thinned(const std::vector<Rgb>& samples) {
    const std::size_t kept = std::min(samples.size(), kMostSamples);
    std::vector<Rgb> some;
    for (std::size_t i = 0; i < kept; ++i) some.push_back(samples[i * samples.size() / kept]);
    return some;
}

[[noreturn]] void refuse_colours() {
    throw InputError("video", "no lips that can be told from the skin", "a mouth in colour, in focus");
}

ColourClasses classes_of(const std::vector<Rgb>& lips, const std::vector<Rgb>& skin,
                         const std::vector<Rgb>& opening) {
    if (lips.size() < kLeastSamples * kLipComponents || skin.size() < kLeastSamples * kSkinComponents)
        refuse_colours();
    return learn_classes(thinned(lips), thinned(skin), thinned(opening));
}

double saturation(const std::vector<PlacedColour>& colours) {
    double sum = 0;
    for (const auto& [colour, far, height] : colours) {
        const auto [least, most] = std::ranges::minmax(colour);
        sum += (most - least) / (most + 1.0);
    }
    return sum / static_cast<double>(std::max<std::size_t>(1, colours.size()));
}

double roll_of(const FaceInPicture& face) { return std::atan2(face.along().y(), face.along().x()); }

// Where the mouth is under the eyes, in distances of the eyes: (across, down).
Vector2d below_eyes(const FaceInPicture& face, const Vector2d& place) {
    const Vector2d d = (place - face.middle()) / face.eye_distance();
    return {d.dot(face.along()), d.dot(face.down())};
}

}  // namespace

class LipTracker::Tracking {
  public:
    Tracking(const LipModel& model, std::span<const FaceSeen> seen, const TrackerOptions& options)
        : model_(with_thickness(model, kThicknessSd)),
          options_(options),
          closed_(closed_lips(model_)),
          still_(Eigen::VectorXd::Zero(model_.modes.cols())) {
        if (seen.empty()) throw std::invalid_argument("LipTracker: no face seen");
        light_ = side_light(seen);
        std::vector<Fitting> fittings;
        for (const FaceSeen& s : seen) {
            const FaceAxis axis{s.face.middle(), s.face.along()};
            std::vector<std::uint8_t> rgb = evened(s.picture, all_of(s.picture), light_, axis);
            const Picture even{s.picture.width, s.picture.height, rgb};
            const MouthInPicture mouth = s.mouth ? *s.mouth : find_mouth(even, s.face);
            fittings.push_back({s, std::move(rgb), mouth});
        }
        place(fittings);
        learn(fittings);
        face_ = seen.back().face;
    }

    TrackedLips next(const Picture& picture, const std::optional<FaceInPicture>& face) {
        if (follower_) {
            TrackedLips lips = followed(picture);
            if (lips.found) return lips;
        }
        if (!find_again(picture, face ? face : finder_.find(picture, face_))) return {};
        return followed(picture);
    }

    const Vector3d& scale() const { return scale_; }
    double mouth_px() const { return mouth_px_; }

  private:
    TrackedLips followed(const Picture& picture) {
        const Followed followed = follower_->follow(picture, head_);
        if (followed.likeness < kLeastLikeness) return lose();
        head_ = followed.move;
        const LipPose expected = placing_.pose(head_(mouth_then_), roll_then_ + head_.roll(),
                                               shrink_then_ * head_.scale(), scale_);
        TrackedLips lips = climbed(picture, expected, kFreedom);
        doubted_ = lips.confidence < kLeastConfidence ? doubted_ + 1 : 0;
        if (doubted_ >= kPatience) return lose();
        last_ = lips.p;
        return lips;
    }

    // Depth and scales from what was found.
    void place(const std::vector<Fitting>& fittings) {
        std::vector<double> distances, widths, heights;
        for (const Fitting& f : fittings) {
            distances.push_back(f.seen.face.eye_distance());
            widths.push_back(f.mouth.width);
            heights.push_back(f.mouth.height);
        }
        mouth_px_ = median(widths);
        if (mouth_px_ < kLeastMouth)
            throw InputError("video", "a mouth " + std::to_string(std::lround(mouth_px_)) + " px wide",
                             "at least " + std::to_string(std::lround(kLeastMouth)) + " px");
        const Extent extent = border_extent(model_);
        const Picture& picture = fittings[0].seen.picture;
        placing_ = {.camera = {kFocal * std::max(picture.width, picture.height),
                               {0.5 * (picture.width - 1), 0.5 * (picture.height - 1)}},
                    .px_per_mm = median(distances) / options_.eye_distance_mm,
                    .lips_centre = extent.centre};
        scale_.x() = mouth_px_ / (placing_.px_per_mm * extent.size.x());
        scale_.y() = std::clamp(median(heights) / (placing_.px_per_mm * extent.size.y()), 0.7 * scale_.x(),
                                1.4 * scale_.x());
        scale_.z() = scale_.x();
    }

    void learn(std::vector<Fitting>& fittings) {
        std::vector<PlacedColour> colours;
        for (Fitting& f : fittings) {
            const auto here = colours_about(f.picture(), f.seen.face, f.mouth);
            colours.insert(colours.end(), here.begin(), here.end());
            f.pose = placing_.pose(f.mouth.centre, roll_of(f.seen.face), 1, scale_);
            f.p = still_;
        }
        if (saturation(colours) < kLeastSaturation) refuse_colours();
        const auto learn = [](const MouthSamples& s) { return classes_of(s.lips, s.skin, s.opening); };
        classes_ = learn(first_samples(colours, learn));
        for (int round = 0; round < kRounds; ++round) {
            fit(fittings);
            adapt(fittings);
        }
        std::vector<double> across, down;
        for (const Fitting& f : fittings) {
            const Vector2d place = below_eyes(f.seen.face, centre_of(f.pose));
            across.push_back(place.x());
            down.push_back(place.y());
        }
        mouth_below_eyes_ = {median(across), median(down)};
    }

    // Every picture climbed with the scales free; then one scale for all.
    void fit(std::vector<Fitting>& fittings) {
        std::vector<double> x, y;
        for (Fitting& f : fittings) {
            const ClassMaps maps = maps_of(f.picture(), box_of_mouth(f.picture(), centre_of(f.pose)));
            f.pose.scale = scale_;
            const Climbed found = most_probable(maps, f.pose, kFirstFreedom, {f.p});
            f.p = found.p;
            f.pose = found.pose;
            x.push_back(f.pose.scale.x());
            y.push_back(f.pose.scale.y());
        }
        scale_ = {median(x), median(y), scale_.z()};
        for (Fitting& f : fittings) f.pose.scale = scale_;
    }

    // The classes as the model's own regions show them.
    void adapt(const std::vector<Fitting>& fittings) {
        RegionSamples kept;
        for (const Fitting& f : fittings) {
            const RegionSamples all =
                sample_regions(placing_.camera, f.pose, as_lip_nodes(lip_shape(model_, f.p)), f.picture());
            add(kept.lips, all.lips, *classes_, &ClassFit::lips, kLeastFit);
            add(kept.skin, all.skin, *classes_, &ClassFit::skin, kLeastFit);
            add(kept.opening, all.opening, *classes_, &ClassFit::opening, 1);
        }
        classes_ = classes_of(kept.lips, kept.skin, kept.opening);
    }

    Vector2d centre_of(const LipPose& pose) const {
        const Vector3d place = camera_from_head(pose) * placing_.lips_centre + pose.shift;
        return placing_.camera.centre_px + placing_.camera.focal_px * place.head<2>() / place.z();
    }

    PictureBox box_of_mouth(const Picture& picture, const Vector2d& centre) const {
        return box_about(picture, centre, 0.95 * mouth_px_, 0.85 * mouth_px_);
    }

    ClassMaps maps_of(const Picture& evened, const PictureBox& box) const {
        return class_maps(evened, box, *classes_, hamming_size(mouth_px_));
    }

    // From each start; then, from the best, with the lips shut.
    Climbed most_probable(const ClassMaps& maps, const LipPose& expected, const PoseFreedom& freedom,
                          const std::vector<Eigen::VectorXd>& starts) const {
        const double gamma = kCertainty * maps.independence;
        const LipPosterior open(model_, placing_.camera, expected, maps, gamma, freedom),
            shut(closed_.model, placing_.camera, expected, maps, gamma, freedom);
        Climbed best;
        for (const Eigen::VectorXd& start : starts) {
            const LipFit fit = climb(open, open.start(start), options_.ascent);
            if (fit.log_posterior > best.log_posterior)
                best = {open.modes_of(fit.theta), open.pose_of(fit.theta), fit.log_posterior,
                        open.mean_fit(fit.theta), fit.iterations};
        }
        const LipFit fit = climb(shut, shut.start(closed_.nearest(best.p)), options_.ascent);
        if (fit.log_posterior - closed_.cost > best.log_posterior)
            best = {closed_.modes_of(shut.modes_of(fit.theta)), shut.pose_of(fit.theta),
                    fit.log_posterior - closed_.cost, shut.mean_fit(fit.theta), fit.iterations};
        return best;
    }

    TrackedLips climbed(const Picture& picture, const LipPose& expected, const PoseFreedom& freedom) const {
        const Vector2d centre = centre_of(expected);
        const double roll = expected.turn.z();
        const PictureBox box = box_of_mouth(picture, centre);
        const std::vector<std::uint8_t> rgb =
            evened(picture, box, light_, {centre, {std::cos(roll), std::sin(roll)}});
        const ClassMaps maps = maps_of({picture.width, picture.height, rgb}, box);
        const Climbed best = most_probable(maps, expected, freedom, {last_.size() ? last_ : still_, still_});
        TrackedLips lips{.found = true,
                         .p = best.p,
                         .pose = best.pose,
                         .log_posterior = best.log_posterior,
                         .confidence = best.confidence,
                         .iterations = best.iterations};
        const Nodes shape = as_lip_nodes(lip_shape(model_, lips.p));
        lips.shape = shape * scale_.asDiagonal();
        lips.pixels = project(placing_.camera, lips.pose, shape).pixels;
        return lips;
    }

    bool find_again(const Picture& picture, const std::optional<FaceInPicture>& face) {
        if (!face) return false;
        const PictureBox still = still_part(picture, *face);
        if (std::min(still.width, still.height) < HeadFollower::kLeastSide) return false;
        face_ = face;
        follower_.emplace(picture, still);
        head_ = follower_->still();
        shrink_then_ = face->eye_distance() / (placing_.px_per_mm * options_.eye_distance_mm);
        roll_then_ = roll_of(*face);
        const Vector2d below = mouth_below_eyes_ * face->eye_distance();
        const LipPose expected =
            placing_.pose(face->middle() + below.x() * face->along() + below.y() * face->down(), roll_then_,
                          shrink_then_, scale_);
        mouth_then_ = centre_of(climbed(picture, expected, kFirstFreedom).pose);
        return true;
    }

    TrackedLips lose() {
        follower_.reset();
        doubted_ = 0;
        last_ = still_;
        return {};
    }

    LipModel model_;
    TrackerOptions options_;
    Placing placing_{};
    Vector3d scale_ = Vector3d::Ones();
    FaceFinder finder_;
    std::optional<FaceInPicture> face_;  // as it was found last
    ClosedLips closed_;
    SideLight light_ = {};
    Eigen::VectorXd still_, last_;
    std::optional<ColourClasses> classes_;
    double mouth_px_ = 0;
    Vector2d mouth_below_eyes_ = {0, 1.1};
    std::optional<HeadFollower> follower_;
    Similarity head_;
    Vector2d mouth_then_ = Vector2d::Zero();
    double shrink_then_ = 1, roll_then_ = 0;
    int doubted_ = 0;
};

LipTracker::LipTracker(const LipModel& model, std::span<const FaceSeen> seen, const TrackerOptions& options)
    : tracking_(std::make_unique<Tracking>(model, seen, options)) {}
LipTracker::~LipTracker() = default;

TrackedLips LipTracker::next(const Picture& picture, const std::optional<FaceInPicture>& face) {
    return tracking_->next(picture, face);
}
const Vector3d& LipTracker::scale() const { return tracking_->scale(); }
double LipTracker::mouth_px() const { return tracking_->mouth_px(); }

}  // namespace viaface

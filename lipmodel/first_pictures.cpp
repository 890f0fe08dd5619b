#include "lipmodel/first_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/error.hpp"
#include "base/median.hpp"
#include "lipmodel/lip_regions.hpp"
#include "lipmodel/lip_thickness.hpp"
#include "lipmodel/mouth_samples.hpp"

namespace viaface {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// From the place that the face suggests, and from the usual size: a prior by which most mouths are within a
// tenth of it.
constexpr PoseFreedom kTalkersFreedom{
    .turn = kFirstFreedom.turn, .shift = kFirstFreedom.shift, .scale = 0.05};
constexpr double kFocal = 1.5;             // of the picture's longer side
constexpr double kLeastMouth = 12;         // px wide
constexpr double kLeastSaturation = 0.05;  // of a lower face in colour
constexpr std::size_t kMostSamples = 200;  // of a class
constexpr int kRounds = 3;                 // of fitting scales and classes in turns
constexpr double kThicknessSd = 1;         // mm
constexpr double kLeastFit = 0.3;          // of a sample's colour in its class, beside the best

struct Extent {
    Vector3d centre, size;
};
Extent border_extent(const LipModel& model) {
    const Nodes shape = as_lip_nodes(lip_shape(model, Eigen::VectorXd::Zero(model.modes.cols())));
    const auto border = shape.middleRows(LipMesh::node(LipMesh::kBorderRing, 0), LipMesh::kColumns);
    const Eigen::RowVector3d least = border.colwise().minCoeff(), most = border.colwise().maxCoeff();
    return {0.5 * (least + most).transpose(), (most - least).transpose()};
}

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

// Where the mouth is under the eyes, in distances of the eyes: (across, down).
Vector2d below_eyes(const FaceInPicture& face, const Vector2d& place) {
    const Vector2d d = (place - face.middle()) / face.eye_distance();
    return {d.dot(face.along()), d.dot(face.down())};
}

class FirstPictures {
  public:
    FirstPictures(const LipModel& model, const AscentOptions& ascent)
        : mouth_{.model = model, .closed = closed_lips(model), .ascent = ascent} {}

    KnownMouth learnt(std::span<const FaceSeen> seen, double eye_distance_mm) {
        mouth_.light = side_light(seen);
        std::vector<Fitting> fittings;
        for (const FaceSeen& s : seen) {
            const FaceAxis axis{s.face.middle(), s.face.along()};
            std::vector<std::uint8_t> rgb = evened(s.picture, all_of(s.picture), mouth_.light, axis);
            const Picture even{s.picture.width, s.picture.height, rgb};
            const MouthInPicture mouth = s.mouth ? *s.mouth : find_mouth(even, s.face);
            fittings.push_back({s, std::move(rgb), mouth});
        }
        place(fittings, eye_distance_mm);
        learn(fittings);
        return mouth_;
    }

  private:
    // Depth and scales: colours tell how wide a mouth is less well than the distance of the eyes does.
    void place(const std::vector<Fitting>& fittings, double eye_distance_mm) {
        std::vector<double> distances, widths, usual_widths, heights;
        for (const Fitting& f : fittings) {
            distances.push_back(f.seen.face.eye_distance());
            widths.push_back(f.mouth.width);
            usual_widths.push_back(f.seen.mouth ? f.mouth.width : usual_mouth(f.seen.face).width);
            heights.push_back(f.mouth.height);
        }
        mouth_.width_px = median(widths);
        if (mouth_.width_px < kLeastMouth)
            throw InputError("video", "a mouth " + std::to_string(std::lround(mouth_.width_px)) + " px wide",
                             "at least " + std::to_string(std::lround(kLeastMouth)) + " px");
        const Extent extent = border_extent(mouth_.model);
        const Picture& picture = fittings[0].seen.picture;
        mouth_.placing = {.camera = {kFocal * std::max(picture.width, picture.height),
                                     {0.5 * (picture.width - 1), 0.5 * (picture.height - 1)}},
                          .px_per_mm = median(distances) / eye_distance_mm,
                          .lips_centre = extent.centre};
        mouth_.scale.x() = median(usual_widths) / (mouth_.placing.px_per_mm * extent.size.x());
        mouth_.scale.y() = std::clamp(median(heights) / (mouth_.placing.px_per_mm * extent.size.y()),
                                      0.7 * mouth_.scale.x(), 1.4 * mouth_.scale.x());
        mouth_.scale.z() = mouth_.scale.x();
    }

    void learn(std::vector<Fitting>& fittings) {
        std::vector<PlacedColour> colours;
        for (Fitting& f : fittings) {
            const auto here = colours_about(f.picture(), f.seen.face, f.mouth);
            colours.insert(colours.end(), here.begin(), here.end());
            f.pose = mouth_.placing.pose(f.mouth.centre, roll_of(f.seen.face), 1, mouth_.scale);
            f.p = mouth_.still();
        }
        if (saturation(colours) < kLeastSaturation) refuse_colours();
        const auto learn = [](const MouthSamples& s) { return classes_of(s.lips, s.skin, s.opening); };
        mouth_.classes = first_classes(colours, learn);
        const Vector3d usual = mouth_.scale;
        for (int round = 0; round < kRounds; ++round) {
            fit(fittings, usual);
            adapt(fittings);
        }
        std::vector<double> across, down;
        for (const Fitting& f : fittings) {
            const Vector2d place = below_eyes(f.seen.face, mouth_.placing.centre_of(f.pose));
            across.push_back(place.x());
            down.push_back(place.y());
        }
        mouth_.below_eyes = {median(across), median(down)};
    }

    // Every picture climbed with the scales free about the usual ones, or classes and scales would lead each
    // other astray; then one scale for all.
    void fit(std::vector<Fitting>& fittings, const Vector3d& usual) {
        std::vector<double> x, y;
        for (Fitting& f : fittings) {
            const PictureBox box = mouth_.box(f.picture(), mouth_.placing.centre_of(f.pose));
            f.pose.scale = usual;
            const ProbableLips found = mouth_.most_probable(f.picture(), box, f.pose, kTalkersFreedom, {f.p});
            f.p = found.p;
            f.pose = found.pose;
            x.push_back(f.pose.scale.x());
            y.push_back(f.pose.scale.y());
        }
        mouth_.scale = {median(x), median(y), mouth_.scale.z()};
        for (Fitting& f : fittings) f.pose.scale = mouth_.scale;
    }

    // The classes as the model's own regions show them.
    void adapt(const std::vector<Fitting>& fittings) {
        RegionSamples kept;
        for (const Fitting& f : fittings) {
            const RegionSamples all = sample_regions(mouth_.placing.camera, f.pose,
                                                     as_lip_nodes(lip_shape(mouth_.model, f.p)), f.picture());
            add(kept.lips, all.lips, *mouth_.classes, &ClassFit::lips, kLeastFit);
            add(kept.skin, all.skin, *mouth_.classes, &ClassFit::skin, kLeastFit);
            add(kept.opening, all.opening, *mouth_.classes, &ClassFit::opening, 1);
        }
        mouth_.classes = classes_of(kept.lips, kept.skin, kept.opening);
    }

    KnownMouth mouth_;
};

}  // namespace

double roll_of(const FaceInPicture& face) { return std::atan2(face.along().y(), face.along().x()); }

KnownMouth learn_mouth(const LipModel& model, std::span<const FaceSeen> seen, const TrackerOptions& options) {
    if (seen.empty()) throw std::invalid_argument("LipTracker: no face seen");
    return FirstPictures(with_thickness(model, kThicknessSd), options.ascent)
        .learnt(seen, options.eye_distance_mm);
}

}  // namespace viaface

#include "synth/track/film_track.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <limits>

#include "base/error.hpp"
#include "synth/track/small_picture.hpp"
#include "viapoints/point_csv.hpp"

namespace viaface {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr int kEvery = 5, kFaces = 8;  // every so many frames is looked at until so many faces are seen
constexpr int kSearched = 1500, kLearnt = 50;  // frames: until one is seen; from the first one on
constexpr double kEyeDistance = 90;            // px of the small pictures, at most about twice that

FaceInPicture scaled(FaceInPicture face, int factor) {
    for (Eigen::Vector2d* eye : {&face.left_eye, &face.right_eye})
        *eye = eye->unaryExpr([&](double px) { return in_small(px, factor); });
    return face;
}

std::optional<MouthInPicture> scaled(std::optional<MouthInPicture> mouth, int factor) {
    if (!mouth) return mouth;
    mouth->centre = mouth->centre.unaryExpr([&](double px) { return in_small(px, factor); });
    mouth->width /= factor;
    mouth->height /= factor;
    return mouth;
}

// The beginning of the film.
struct FirstLook {
    int factor = 1;
    std::deque<SmallPicture> pictures = {};
    std::vector<FaceSeen> seen = {};
    bool at_once = false;  // in the first frame
    int faces = 1;
    bool eyes = false;
    int searched = 0;

    void add(const Frame& frame, const FaceInPicture& face, const std::optional<MouthInPicture>& mouth) {
        if (seen.empty()) factor = std::max(1, static_cast<int>(face.eye_distance() / kEyeDistance));
        pictures.push_back(small_picture(frame, factor));
        seen.push_back({pictures.back().picture(), scaled(face, factor), scaled(mouth, factor)});
        faces = std::max(faces, face.faces);
        eyes = eyes || face.eyes_seen;
    }
};

std::string line(const char* format, auto... values) {
    char text[300];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

// By hand, in the first frame.
const Hint& within(const Hint& hint, const Frame& frame) {
    const auto inside = [&](const Eigen::Vector2d& place) {
        return place.minCoeff() >= 0 && place.x() < frame.width && place.y() < frame.height;
    };
    if (inside(hint.face.left_eye) && inside(hint.face.right_eye) &&
        (!hint.mouth || inside(hint.mouth->centre)))
        return hint;
    throw InputError("--hint", "a place outside the picture",
                     line("places in a picture of %d x %d px", frame.width, frame.height));
}

FirstLook first_look(const TrackRequest& request) {
    FrameReader reader(request.video);
    FaceFinder finder;
    FirstLook look;
    std::optional<FaceInPicture> before;
    int first = kSearched;
    for (int n = 0; n < first + kLearnt && n < kSearched; ++n) {
        const auto timed = reader.next();
        if (!timed) break;
        ++look.searched;
        if (n % kEvery != 0) continue;
        const Frame& frame = timed->frame;
        const SmallPicture whole = small_picture(frame, 1);
        const bool by_hand = n == 0 && request.hint;
        const auto face = by_hand ? within(*request.hint, frame).face : finder.find(whole.picture(), before);
        if (!face) continue;
        before = face;
        look.add(frame, *face, by_hand ? request.hint->mouth : std::nullopt);
        first = std::min(first, n);
        look.at_once = first == 0;
        if (look.seen.size() == kFaces) break;
    }
    if (look.seen.empty())
        throw InputError("video", "no face in its first " + std::to_string(look.searched) + " frames",
                         "an upright face seen from the front, or --hint");
    return look;
}

// Rows of the motion as they come.
class Rows {
  public:
    explicit Rows(Eigen::Index modes) {
        for (int i = 0; i < kLipPoints; ++i) {
            const std::string name(point_name(kFirstLipPoint + i));
            names_.insert(names_.end(), {name + "_u_px", name + "_v_px"});
        }
        for (Eigen::Index i = 1; i <= modes - kThicknessModes; ++i)
            names_.push_back("mode_" + std::to_string(i));
        names_.insert(names_.end(), {"thickness_upper", "thickness_lower", "opening_mm", "width_mm",
                                     "protrusion_inferred_mm", "log_posterior", "confidence", "tracked"});
    }

    void add(double time_s, const TrackedLips& lips) {
        time_s_.push_back(time_s);
        Configuration points = Configuration::Constant(kNaN);
        std::vector<double> others(names_.size(), kNaN);
        others[names_.size() - 2] = lips.confidence;
        others.back() = lips.found ? 1 : 0;
        if (lips.found) fill(lips, points, others);
        points_.insert(points_.end(), points.begin(), points.end());
        others_.insert(others_.end(), others.begin(), others.end());
    }

    Motion motion() const {
        const auto rows = static_cast<Eigen::Index>(time_s_.size());
        Motion made{time_s_, Eigen::Map<const RowMatrix>(points_.data(), rows, kCoordinates)};
        for (std::size_t c = 0; c < names_.size(); ++c) {
            made.extra.push_back({names_[c], {}});
            for (std::size_t i = c; i < others_.size(); i += names_.size())
                made.extra.back().values.push_back(others_[i]);
        }
        return made;
    }

  private:
    // To a ten-thousandth, as all motion is written.
    static double rounded(double value) { return std::round(value * 1e4) / 1e4; }

    static void fill(const TrackedLips& lips, Configuration& points, std::vector<double>& others) {
        const auto nodes = marked_nodes();
        auto next = others.begin();
        for (int i = 0; i < kLipPoints; ++i) {
            points.segment<3>(3 * (kFirstLipPoint + i)) =
                lips.shape.row(nodes[i]).transpose().unaryExpr(&rounded);
            *next++ = rounded(lips.pixels(nodes[i], 0));
            *next++ = rounded(lips.pixels(nodes[i], 1));
        }
        const double opening = meet(points);
        const auto at = [&](int point) { return point_of(points, point); };
        for (const double mode : lips.p) *next++ = rounded(mode);
        *next++ = rounded(opening);
        *next++ = rounded((at(kBorderLeft) - at(kBorderRight)).norm());
        *next++ =
            rounded(0.5 * (at(kBorderTop) + at(kBorderBottom) - at(kBorderLeft) - at(kBorderRight)).z());
        *next++ = rounded(lips.log_posterior);
    }

    // Inner edges above each other: their mean distance, mm; those that pass through each other meet halfway.
    static double meet(Configuration& points) {
        double sum = 0;
        for (const auto& [upper, lower] :
             {std::pair(kInnerTopLeft, kInnerBottomLeft), std::pair(kInnerTop, kInnerBottom),
              std::pair(kInnerTopRight, kInnerBottomRight)}) {
            double &up = points[3 * upper + 1], &down = points[3 * lower + 1];
            if (up < down) up = down = rounded(0.5 * (up + down));
            sum += up - down;
        }
        return sum / 3;
    }

    std::vector<std::string> names_;
    std::vector<double> time_s_, points_, others_;
};

// "12-15, 40" of the frames that are lost.
std::string lost_frames(const std::vector<bool>& found) {
    std::string text;
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (found[i]) continue;
        std::size_t last = i;
        while (last + 1 < found.size() && !found[last + 1]) ++last;
        text += (text.empty() ? "" : ", ") + std::to_string(i) + (last > i ? "-" + std::to_string(last) : "");
        i = last;
    }
    return text;
}

}  // namespace

FilmTrack track_film(const LipModel& model, const TrackRequest& request, const TrackOnlooker& onlooker) {
    const FirstLook look = first_look(request);
    LipTracker tracker(model, look.seen, {.eye_distance_mm = request.eye_distance_mm});
    FrameReader reader(request.video);
    Rows rows(model.modes.cols() + kThicknessModes);
    std::vector<bool> found;
    double confidence = 0;
    while (const auto timed = reader.next()) {
        const SmallPicture small = small_picture(timed->frame, look.factor);
        std::optional<FaceInPicture> face;
        if (found.empty() && look.at_once) face = look.seen.front().face;
        TrackedLips lips = tracker.next(small.picture(), face);
        lips.pixels = lips.pixels.unaryExpr([&](double px) { return in_frame(px, look.factor); });
        rows.add(timed->time_s, lips);
        found.push_back(lips.found);
        confidence += lips.confidence;
        if (onlooker) onlooker(*timed, lips);
    }
    FilmTrack track;
    track.motion = rows.motion();
    track.lost = static_cast<int>(std::ranges::count(found, false));
    const Eigen::Vector3d& scale = tracker.scale();
    track.report = {line("%zu frames, mouth %.0f px wide, mean confidence %.2f", found.size(),
                         tracker.mouth_px() * look.factor, confidence / static_cast<double>(found.size())),
                    line("scales of the model: %.3f, %.3f, %.3f", scale.x(), scale.y(), scale.z())};
    if (look.faces > 1)
        track.report.push_back(line("%d faces: the one that was largest at first is tracked", look.faces));
    if (!look.eyes) track.report.push_back("eyes not seen: the scale rests on the size of the face alone");
    if (track.lost > 0) track.report.push_back("lost in frames " + lost_frames(found));
    track.comments = {
        std::string(kAnotherPerson),
        line("lips tracked in video; mm rest on %g mm between the pupils", request.eye_distance_mm),
        "z and protrusion_inferred_mm are inferred by the learned modes, not seen",
        "u and v in px of the video, the centre of its top left pixel is (0, 0)"};
    track.comments.insert(track.comments.end(), track.report.begin(), track.report.end());
    return track;
}

}  // namespace viaface

// Lips tracked in a film, as motion of the layout's sixteen lip points. The film is read twice: pictures of
// its beginning that show a face set up the tracker (lipmodel/lip_tracker.hpp), then all are tracked in
// order.
//
// Points are in millimetres of the talker in the film, in his own axes (x to his left, y up, z forward):
// their scale rests on the distance of his pupils as stated, and depth, which a view from the front does not
// show, is what the learned modes infer. Inner edges that would pass through each other meet halfway.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "lipmodel/lip_thickness.hpp"
#include "lipmodel/lip_tracker.hpp"
#include "synth/film/media_reader.hpp"
#include "synth/track/hint.hpp"
#include "viapoints/motion.hpp"

namespace viaface {

struct TrackRequest {
    std::filesystem::path video;
    double eye_distance_mm = 63;
    std::optional<Hint> hint = {};
};

struct FilmTrack {
    // Beside the points: NAME_u_px and NAME_v_px of each, mode_1 ... and the two of thickness, opening_mm,
    // width_mm, protrusion_inferred_mm, log_posterior, confidence (0 to 1), tracked (0 or 1). Where the track
    // is lost all but the last two are NaN.
    Motion motion;
    std::vector<std::string> comments;  // for the head of the file: scale, model, what was lost
    int lost = 0;                       // frames
    std::vector<std::string> report;    // lines for people
};

// A frame and the lips in it, px of the frame.
using TrackOnlooker = std::function<void(const TimedFrame&, const TrackedLips&)>;

// InputError("media"), ("video") or ("--hint").
FilmTrack track_film(const LipModel& model, const TrackRequest& request, const TrackOnlooker& onlooker = {});

}  // namespace viaface

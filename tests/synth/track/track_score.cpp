// How well lips are tracked in the clips of a folder: track_score CLIPS MARKS [LIPS]. Prints the distance of
// hand-made marks from the tracked contours, how far p, b and m close, frames lost, and the processor's time.
// Fails when a clip never opens: contours that stay shut may lie near the marks, and close every bilabial.
#include <cstdio>
#include <ctime>
#include <set>

#include "hand_marks.hpp"
#include "synth/lips/learned_lips.hpp"
#include "synth/track/film_track.hpp"

namespace fs = std::filesystem;
using namespace viaface;

namespace {

struct Totals {
    std::map<std::string, std::vector<double>> errors;  // by point
    std::vector<double> border, inner;
    int frames = 0, lost = 0, clips = 0, clips_lost = 0, clips_shut = 0, bilabials = 0, open = 0;
    double narrowest_mm = 1e9;  // of the clips' widest openings
    double seconds = 0, video_s = 0;
};

constexpr double kOpens = 5;  // mm, at the widest of a sentence

std::vector<double> column(const Motion& motion, const std::string& name) {
    return std::ranges::find(motion.extra, name, &ExtraColumn::name)->values;
}

void closures(const fs::path& clip, const Motion& motion, Totals& totals) {
    const std::vector<double> opening = column(motion, "opening_mm");
    double widest = 0;
    for (const double mm : opening) widest = std::fmax(widest, mm);
    totals.narrowest_mm = std::fmin(totals.narrowest_mm, widest);
    if (widest <= kOpens) {
        ++totals.clips_shut;
        std::printf("%s: opens by %.1f mm at most\n", clip.stem().c_str(), widest);
    }
    for (const auto& word : test::bilabials(fs::path(clip).replace_extension(".align"))) {
        double least = 1e9;
        for (int n = std::max(0, word.first); n <= word.last && n < static_cast<int>(opening.size()); ++n)
            least = std::fmin(least, opening[n]);
        ++totals.bilabials;
        if (least < 0.15 * widest) continue;
        ++totals.open;
        std::printf("%s: %s stays %.0f%% open\n", clip.stem().c_str(), word.word.c_str(),
                    100 * least / widest);
    }
}

void score(const fs::path& clip, const LipModel& model, const test::FrameMarks& marks, Totals& totals) {
    const std::clock_t start = std::clock();
    int frame = 0;
    const FilmTrack track =
        track_film(model, {.video = clip}, [&](const TimedFrame&, const TrackedLips& lips) {
            const auto here = marks.find(frame++);
            if (here == marks.end() || !lips.found) return;
            for (const test::Mark& mark : here->second) {
                const double error = test::contour_error(mark, lips.pixels);
                totals.errors[mark.point].push_back(error);
                (mark.inside() ? totals.inner : totals.border).push_back(error);
            }
        });
    totals.seconds += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    totals.frames += frame;
    totals.video_s += frame / 25.0;
    totals.lost += track.lost;
    totals.clips_lost += track.lost > 0 ? 1 : 0;
    ++totals.clips;
    closures(clip, track.motion, totals);
}

void print(const Totals& t) {
    std::vector<double> all = t.border;
    all.insert(all.end(), t.inner.begin(), t.inner.end());
    std::printf("%zu marks: median %.2f px (border %.2f, inner edge and seam %.2f)\n", all.size(),
                test::median(all), test::median(t.border), test::median(t.inner));
    for (const auto& [point, errors] : t.errors)
        std::printf("  %-20s %4zu  %.2f px\n", point.c_str(), errors.size(), test::median(errors));
    std::printf("p, b, m: %d of %d words not closed to 15%% of the clip's widest\n", t.open, t.bilabials);
    std::printf("widest opening of a clip: %.1f mm or more; %d of %d clips open by no more than %.0f mm\n",
                t.narrowest_mm, t.clips_shut, t.clips, kOpens);
    std::printf("lost: %d of %d frames, in %d of %d clips\n", t.lost, t.frames, t.clips_lost, t.clips);
    std::printf("%.1f s of video in %.1f s of one processor\n", t.video_s, t.seconds);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3) {
        std::fprintf(stderr, "track_score CLIPS MARKS [LIPS]\n");
        return 2;
    }
    try {
        const auto marks = test::read_marks(argv[2]);
        const LipModel model =
            argc > 3 ? with_modes(load_lip_model(argv[3]), 10)
                     : learn_from(recited_lip_frames(load_talker(fs::path(VIAFACE_TALKERS_FOLDER) / "momo")),
                                  {.modes = 10}, {});
        std::set<fs::path> clips;
        for (const auto& entry : fs::directory_iterator(argv[1])) {
            if (entry.path().extension() == ".mpg") clips.insert(entry.path());
        }
        Totals totals;
        for (const fs::path& clip : clips) {
            const auto found = marks.find(clip.stem().string());
            score(clip, model, found == marks.end() ? test::FrameMarks{} : found->second, totals);
        }
        print(totals);
        return totals.clips_shut > 0 ? 1 : 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}

#include "synth/render/live.hpp"

#include <cmath>

#include "base/error.hpp"
#include "synth/pose/blinks.hpp"
#include "viapoints/cells.hpp"
#include "viapoints/motion_at.hpp"
#include "viapoints/point_csv.hpp"
#include "viapoints/point_names.hpp"

namespace viaface {
namespace {

constexpr std::size_t kRowsHeld = 8;
constexpr double kSoundAhead = 0.1;     // s: what a stream waits for
constexpr double kLongestStill = 3600;  // s, between two rows
constexpr std::size_t kLongestLine = 1 << 20;

// The last rows, and what may be drawn from them.
class Window {
  public:
    void add(const LiveRow& row) {
        rows_.push_back(row);
        if (rows_.size() > kRowsHeld) rows_.erase(rows_.begin());
        motion_.time_s.clear();
        motion_.positions.resize(static_cast<Eigen::Index>(rows_.size()), kCoordinates);
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            motion_.time_s.push_back(rows_[i].time_s);
            motion_.positions.row(static_cast<Eigen::Index>(i)) = rows_[i].points.transpose();
        }
    }
    // No row that is still to come changes the motion before this time.
    double settled_s() const { return rows_.size() < 2 ? -INFINITY : rows_[rows_.size() - 2].time_s; }
    double last_s() const { return rows_.back().time_s; }
    Configuration at(double time_s) const { return motion_at(motion_, time_s); }

  private:
    std::vector<LiveRow> rows_;
    Motion motion_;
};

class LiveFilm {
  public:
    LiveFilm(const RenderRequest& request, const Talker& talker, FilmWriter& film,
             const std::function<void(const DrawnFrame&)>& onlooker, int sample_rate)
        : fps_(request.fps),
          sample_rate_(sample_rate),
          film_(film),
          animation_(talker, request.view, request.fps, film, onlooker, request.drawing),
          blinks_(request.seed) {}

    double next_s() const { return animation_.time_of(animation_.frames()); }

    void draw(const Configuration& points, bool ahead) {
        if (points.array().isNaN().all())
            throw InputError("motion", "no point at frame " + std::to_string(animation_.frames()),
                             "at least one point at every time");
        const double shown = next_s(), end = animation_.time_of(animation_.frames() + 1);
        silence_up_to(ahead ? end + kSoundAhead : 0);
        const double shut = blinks_.amount(shown);
        animation_.draw(points, {shut, shut});
    }
    bool covers_sound() const { return animation_.frames() >= frames_for(samples_, sample_rate_, fps_); }

    RenderReport finish() {
        film_.finish();
        return {animation_.frames(), animation_.rms_mm(), animation_.farthest_mm(), animation_.motion_hash()};
    }

  private:
    void silence_up_to(double time_s) {
        const std::int64_t wanted = std::llround(time_s * sample_rate_);
        if (wanted <= samples_) return;
        film_.add_sound(std::vector<std::int16_t>(static_cast<std::size_t>(wanted - samples_), 0));
        samples_ = wanted;
    }

    FrameRate fps_;
    int sample_rate_;
    FilmWriter& film_;
    Animation animation_;
    BlinkSchedule blinks_;
    std::int64_t samples_ = 0;
};

}  // namespace

RenderReport render_live(const RenderRequest& request,
                         const std::function<std::optional<LiveRow>()>& next_row, const Talker& talker,
                         FilmWriter& film, const std::function<void(const DrawnFrame&)>& onlooker) {
    std::optional<LiveRow> row = next_row();
    if (!row) throw InputError("motion", "no row", "a header and at least one row");
    LiveFilm live(request, talker, film, onlooker, Sound{}.sample_rate);
    const double first_s = row->time_s;
    Window window;
    for (; row; row = next_row()) {
        window.add(*row);
        while (first_s + live.next_s() <= window.settled_s())
            live.draw(window.at(first_s + live.next_s()), true);
    }
    do {
        live.draw(window.at(first_s + live.next_s()), false);
    } while (first_s + live.next_s() <= window.last_s() || !live.covers_sound());
    return live.finish();
}

std::optional<std::string> LiveCsv::next_line() {
    for (std::string line; std::getline(in_, line);) {
        const std::string_view content = trimmed(line);
        if (line.size() > kLongestLine)
            throw InputError("motion", "a line of more than 2^20 bytes", "shorter ones");
        if (!content.empty() && content != "\r" && content.front() != '#') return line;
    }
    return std::nullopt;
}

std::optional<LiveRow> LiveCsv::next() {
    if (header_.empty()) {
        const auto header = next_line();
        if (!header) return std::nullopt;
        header_ = *header;
    }
    const auto line = next_line();
    if (!line) return std::nullopt;
    const std::string field = "motion row " + std::to_string(++row_);
    const PointRecording read = parse_point_csv(header_ + "\n" + *line + "\n", field);
    if (!read.head_frame)
        throw InputError(field, "points of another person", "time_s and a talker's own points in mm");
    const double now = read.time_s.front();
    if (row_ > 1 && !(now > last_s_ && now <= last_s_ + kLongestStill))
        throw InputError(field, std::to_string(now) + " s",
                         "a time above the row before, at most an hour on");
    last_s_ = now;
    return LiveRow{now, lay_out(read, {}, field).motion.at(0)};
}

}  // namespace viaface

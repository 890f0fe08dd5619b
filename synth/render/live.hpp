// Motion drawn while it arrives, row by row: a frame is drawn as soon as the row behind the one after its
// time is there, since that row bends the curve between them (motion_at.hpp). Only a few rows are held. The
// film begins with the first row; its sound is silence.
#pragma once

#include <functional>
#include <istream>
#include <optional>
#include <string>

#include "synth/render/render.hpp"

namespace viaface {

struct LiveRow {
    double time_s = 0;
    Configuration points;  // mm, the talker's head frame; NaN where missing
};

// Draws until next_row() has no more, and finishes the film. InputError("motion", ...) without a row, or for
// one without any point; request.from_s, to_s and keep_head do not count.
RenderReport render_live(const RenderRequest& request,
                         const std::function<std::optional<LiveRow>()>& next_row, const Talker& talker,
                         FilmWriter& film, const std::function<void(const DrawnFrame&)>& onlooker = {});

// Rows of a motion CSV (point_csv.hpp) of a talker's own points, as lines arrive. InputError names the row.
class LiveCsv {
  public:
    explicit LiveCsv(std::istream& in) : in_(in) {}  // which outlives it
    std::optional<LiveRow> next();

  private:
    std::optional<std::string> next_line();

    std::istream& in_;
    std::string header_;
    std::size_t row_ = 0;
    double last_s_ = 0;
};

}  // namespace viaface

// Knots taken out and shifted: KnotLine::thin and KnotLine::shift.
#include <algorithm>
#include <array>
#include <cmath>
#include <queue>

#include "viapoints/knot_line.hpp"

namespace viaface {
namespace {

constexpr double kStale = 2;              // growth of importance at which a knot has to wait its turn again
constexpr int kWidestSpread = 2;          // gaps to either side that are widened when a knot goes
constexpr std::ptrdiff_t kThinned = 160;  // knots whose turns to go are weighed against each other

std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace

// What a knot adds: the jump of the fifth derivative, times the fifth power of the room about it. Near the
// ends nothing is known of it, and it is tried first.
double KnotLine::importance(int id) const {
    std::array<int, 11> near;
    near[5] = id;
    for (std::size_t i = 5; i-- > 0;) near[i] = before(near[i + 1], 1);
    for (std::size_t i = 6; i < near.size(); ++i) near[i] = after(near[i - 1], 1);
    if (near[2] == near[3] || near[8] == near[7]) return 0;
    std::array<double, 11> times;
    for (std::size_t i = 0; i < near.size(); ++i) times[i] = time(near[i]);
    const std::array<double, 7> weights = fifth_derivative_jump(times);
    double jump2 = 0;
    for (std::size_t b = 0; b < braids_.size(); ++b) {
        const auto vectors = at(braids_[b].vectors);
        std::array<const Lanes*, 7> control;
        for (std::size_t i = 0; i < control.size(); ++i)
            control[i] = &controls_[b][at(near[i + 2]) * vectors];
        jump2 += bench_.kernel->jump(weights.data(), control.data(), braids_[b].vectors);
    }
    const double left = times[5] - times[4], right = times[6] - times[5];
    return std::sqrt(jump2) * std::pow(left * right / (left + right), 5);
}

// Takes one knot out of those about this one, and spreads the rest evenly over what was there.
bool KnotLine::spread_out(int id, int reach) {
    const int left = before(id, reach), right = after(id, reach);
    std::vector<double> places;
    for (int at = left;; at = knot(at).after) {
        places.push_back(static_cast<double>(knot(at).sample));
        if (at == right) break;
    }
    const std::size_t gaps = places.size() - 1;
    if (gaps < 3) return false;
    std::vector<std::size_t> between;
    std::size_t last = knot(left).sample;
    for (std::size_t i = 1; i + 1 < gaps; ++i) {
        const double place = static_cast<double>(i * gaps) / static_cast<double>(gaps - 1);
        const auto whole = static_cast<std::size_t>(place);
        const double part = place - static_cast<double>(whole);
        between.push_back(static_cast<std::size_t>(
            std::lround(places[whole] + part * (places[whole + 1] - places[whole]))));
        if (between.back() <= last) return false;
        last = between.back();
    }
    return last < knot(right).sample && replace(left, right, between);
}

bool KnotLine::take_out(int id) {
    if (replace(knot(id).before, knot(id).after, {})) return true;
    for (int reach = 2; reach <= kWidestSpread; ++reach) {
        if (spread_out(id, reach)) return true;
    }
    return false;
}

std::size_t KnotLine::thin(const std::vector<int>& ids) {
    using Turn = std::pair<double, int>;
    std::priority_queue<Turn, std::vector<Turn>, std::greater<>> turns;  // the least important first
    for (const int id : ids) {
        if (inner(id) && knot(id).alive && knot(id).open) turns.emplace(importance(id), id);
    }
    std::size_t taken = 0;
    while (!turns.empty()) {
        const auto [known, id] = turns.top();
        turns.pop();
        if (!knot(id).alive) continue;
        if (const double now = importance(id); now > kStale * known) {
            turns.emplace(now, id);
            continue;
        }
        knot(id).open = false;
        taken += take_out(id);
    }
    return taken;
}

// Some knots after the others, so that what is at work is near at hand however long the line is.
std::size_t KnotLine::thin() {
    const std::vector<int> ids = all();
    std::size_t taken = 0;
    for (auto next = ids.begin(); next != ids.end();) {
        const auto last = next + std::min(kThinned, ids.end() - next);
        taken += thin({next, last});
        next = last;
    }
    return taken;
}

std::size_t KnotLine::shift() {
    std::size_t moved = 0;
    for (const int id : all()) {
        if (!inner(id)) continue;
        const int left = knot(id).before, right = knot(id).after;
        for (const std::size_t sample : {knot(id).sample + 1, knot(id).sample - 1}) {
            if (sample <= knot(left).sample || sample >= knot(right).sample) continue;
            if (!replace(left, right, {sample}, Aim::kRelief)) continue;
            ++moved;
            break;
        }
    }
    return moved;
}

}  // namespace viaface

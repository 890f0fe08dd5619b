#include "viapoints/stream_choice.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "viapoints/measured.hpp"
#include "viapoints/stream_basis.hpp"
#include "viapoints/stream_segment.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr double kStepPerBound = 5;  // where no statistics say otherwise
constexpr double kBitsOfMode = 0.7;  // per second, about
constexpr double kTriedSeconds = 4;

// A bound as a float, and not above it.
double stored_bound(double bound_mm) {
    return static_cast<double>(std::nextafter(static_cast<float>(bound_mm), 0.0f));
}

// The basis of a motion of its own: its mean, and as many modes as its extension finds.
ConfigurationBasis mean_of(const RowMatrix& positions) {
    return stored_basis({positions.colwise().mean().transpose(), Eigen::MatrixXd(kCoordinates, 0)});
}

// In modes of the motion's own alone.
StreamTools own_tools(const Motion& motion, const std::vector<int>& points, double max_error_mm) {
    StreamTools tools;
    tools.head.points = points;
    tools.head.bound_mm = stored_bound(max_error_mm);
    tools.head.step_mm = static_cast<double>(static_cast<float>(kStepPerBound * max_error_mm));
    tools.basis = extended_basis(mean_of(motion.positions), points, motion.positions,
                                 kBasisShare * tools.head.bound_mm);
    return tools;
}

double head_bits(const StreamTools& tools) {
    return 8 * static_cast<double>(write_stream_head(tools).size());
}

double seconds_of(const Motion& motion) { return motion.time_s.back() - motion.time_s.front(); }

// What of the talker's may serve: his modes alone, or those of his table and blends of the others, whichever
// should cost less; directions within his modes where fewer of these do; and the motion's own where his leave
// too much.
std::vector<StreamTools> candidates(const StreamModel& model, const Motion& motion,
                                    const std::vector<int>& points, double max_error_mm) {
    const double share = kBasisShare * stored_bound(max_error_mm);
    const auto shared = [&](std::vector<int> modes, BlendWeights blends, StreamDirections directions = {}) {
        StreamTools tools = shared_tools(model, points, max_error_mm, std::move(modes), std::move(blends),
                                         std::move(directions));
        tools.basis = extended_basis(tools.basis, points, motion.positions, share);
        return tools;
    };
    const auto about = [&](const StreamTools& tools) {
        return head_bits(tools) + kBitsOfMode * seconds_of(motion) * static_cast<double>(tools.basis.size());
    };
    const StreamTools alone = shared(needed_modes(model.basis, points, motion.positions, share), {});
    const int components = model.tables[static_cast<std::size_t>(alone.head.table)].components;
    const std::vector<int> known = independent_modes(model.basis, points, components);
    const StreamTools blended =
        shared(known, needed_blends(model.basis, known, points, motion.positions, share));
    std::vector<StreamTools> all{about(blended) < about(alone) ? blended : alone};
    StreamTools along = shared({}, {}, needed_directions(model.basis, points, motion.positions, share));
    if (along.basis.size() < all[0].basis.size()) all.push_back(std::move(along));
    if (all[0].basis.size() > shared_count(all[0].head))
        all.push_back(own_tools(motion, points, max_error_mm));
    return all;
}

void complete(StreamTools& tools, const Motion& motion, double sync_s, int ticks_per_s) {
    tools.head.start_s = motion.time_s.front();
    tools.head.ticks_per_s = ticks_per_s;
    tools.head.longest_segment =
        static_cast<std::uint32_t>(std::max(1.0, std::floor(sync_s * ticks_per_s + 1e-9)));
    if (tools.basis.size() == 0)
        tools.basis.modes = Eigen::MatrixXd::Identity(kCoordinates, kCoordinates)
                                .middleCols(3 * tools.head.points.front(), 1);
    tools.statistics = with_components(tools.statistics, static_cast<int>(tools.basis.size()));
}

// How far points go in a segment, mm: the sum over samples of the one that goes furthest.
double way_in(const Motion& motion, const std::vector<int>& points, std::size_t first, std::size_t samples) {
    double way = 0;
    for (std::size_t i = first + 1; i < first + samples; ++i)
        way += longest_triple(coordinates_of(
            motion.positions.row(static_cast<Index>(i)) - motion.positions.row(static_cast<Index>(i - 1)),
            points));
    return way;
}

struct Trial {
    CutSegment cut;
    double share = 1;  // of the whole motion's way
};

Trial busiest(const Motion& motion, StreamHead head) {
    head.longest_segment = std::min(
        head.longest_segment, static_cast<std::uint32_t>(std::lround(kTriedSeconds * head.ticks_per_s)));
    Trial trial;
    double all = 0, most = -1;
    for (const CutSegment& cut : cut_motion(motion, head)) {
        const double way = way_in(motion, head.points, cut.first_sample, cut.samples);
        all += way;
        if (way <= most) continue;
        most = way;
        trial.cut = cut;
    }
    trial.share = all > 0 ? most / all : 1;
    return trial;
}

// How often values of the directions differ from the last ones.
void learn_chances(StreamTools& tools, const QuantisedSegment& segment) {
    StreamDirections& directions = tools.head.directions;
    const std::size_t first = static_cast<std::size_t>(shared_count(tools.head) - directions.count()),
                      rows = segment.values.size();
    for (std::size_t d = 0; d < directions.chance.size(); ++d) {
        double differ = 0.5;
        for (std::size_t n = 1; n < rows; ++n)
            differ += segment.values[n][first + d] != segment.values[n - 1][first + d];
        directions.chance[d] =
            static_cast<std::uint8_t>(std::clamp(std::floor(256 * differ / double(rows)), 2.0, 253.0));
    }
    set_chances(tools.statistics, first, directions.chance);
}

}  // namespace

StreamTools shared_tools(const StreamModel& model, std::vector<int> points, double max_error_mm,
                         std::vector<int> modes, BlendWeights blends, StreamDirections directions) {
    const std::vector<int> held = points_of(model.basis);
    for (const int p : points) {
        if (!std::binary_search(held.begin(), held.end(), p))
            throw InputError(
                "talker", model.name,
                "a talker whose stream model holds the point " + std::string(point_name(p)) + ", or none");
    }
    const std::size_t table = model.table_for(max_error_mm);
    const StreamStatistics& statistics = model.tables[table];
    StreamTools tools;
    StreamHead& head = tools.head;
    head.talker = model.name;
    head.model_identity = model.identity();
    head.table = static_cast<int>(table);
    head.shared_modes = std::move(modes);
    head.blends = std::move(blends);
    head.directions = std::move(directions);
    head.points = std::move(points);
    head.bound_mm = stored_bound(max_error_mm);
    head.step_mm =
        static_cast<double>(static_cast<float>(statistics.step_mm / statistics.bound_mm * max_error_mm));
    tools.basis = shared_basis(model, head);
    tools.statistics = shared_statistics(model, head);
    return tools;
}

ChosenTools chosen_tools(const Motion& motion, const StreamModel* model, double max_error_mm, double sync_s,
                         int ticks_per_s) {
    const std::vector<int> points = measured_points(motion.positions, "motion");
    std::vector<StreamTools> all = model ? candidates(*model, motion, points, max_error_mm)
                                         : std::vector<StreamTools>{own_tools(motion, points, max_error_mm)};
    for (StreamTools& tools : all) complete(tools, motion, sync_s, ticks_per_s);
    const Trial trial = busiest(motion, all[0].head);
    ChosenTools best;
    double fewest = 0;
    for (StreamTools& tools : all) {
        const RoughSegment rough = SegmentEncoder(tools, {.rounds = 0}).rough(motion, trial.cut);
        const double bits =
            head_bits(tools) +
            8 * static_cast<double>(segment_content(tools, rough.segment).size()) / trial.share;
        if (best.tools.basis.size() > 0 && bits >= fewest) continue;
        fewest = bits;
        learn_chances(tools, rough.segment.via);
        best = {std::move(tools), rough.holds};
    }
    return best;
}

}  // namespace viaface

#include "viapoints/stream_train.hpp"

#include <algorithm>
#include <cmath>
#include <future>

#include "base/error.hpp"
#include "viapoints/measured.hpp"
#include "viapoints/stream_basis.hpp"
#include "viapoints/stream_cut.hpp"
#include "viapoints/stream_learn.hpp"
#include "viapoints/stream_segment.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr double kSyncSeconds = 10;
constexpr int kTicksPerSecond = 30;
constexpr Index kMostRows = 6000;  // of all motions, that a basis is made from
constexpr Index kMostModes = 24;
constexpr std::size_t kMostSegments = 30;  // that a table is learned from: the first of each motion

std::vector<int> common_points(const std::vector<Motion>& motions) {
    std::vector<int> common;
    for (std::size_t i = 0; i < motions.size(); ++i) {
        const std::vector<int> own = measured_points(motions[i].positions, "motion " + std::to_string(i + 1));
        std::vector<int> both;
        std::set_intersection(common.begin(), common.end(), own.begin(), own.end(), std::back_inserter(both));
        common = i == 0 ? own : both;
    }
    if (common.empty())
        throw InputError("motion", std::to_string(motions.size()) + " motions",
                         "motions with a point in common");
    return common;
}

// Rows of all motions, evenly; points that are not common are NaN.
RowMatrix gathered(const std::vector<Motion>& motions, const std::vector<int>& points) {
    Index all = 0;
    for (const Motion& motion : motions) all += motion.positions.rows();
    const Index stride = all / kMostRows + 1;
    std::vector<Configuration> rows;
    for (const Motion& motion : motions)
        for (Index i = 0; i < motion.positions.rows(); i += stride)
            rows.push_back(motion.positions.row(i).transpose());
    RowMatrix matrix = RowMatrix::Constant(static_cast<Index>(rows.size()), kCoordinates, std::nan(""));
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (const int p : points)
            matrix.block<1, 3>(static_cast<Index>(i), 3 * p) = rows[i].segment<3>(3 * p).transpose();
    return matrix;
}

int modes_within(const ConfigurationBasis& basis, const RowMatrix& rows, double error_mm) {
    Index k = 1;
    while (k < basis.size() && truncation_error_mm({basis.mean, basis.modes.leftCols(k)}, rows) > error_mm)
        ++k;
    return static_cast<int>(k);
}

// Those of the motions that hold at this bound on the grid; what cannot be held teaches nothing.
std::vector<QuantisedSegment> encoded(const std::vector<Motion>& motions, StreamTools tools, int rounds) {
    std::vector<QuantisedSegment> segments;
    for (const Motion& motion : motions) {
        tools.head.start_s = motion.time_s.front();
        SegmentEncoder encoder(tools, {.rounds = rounds});
        std::vector<CutSegment> cuts = cut_motion(motion, tools.head);
        cuts.resize(std::min(cuts.size(), kMostSegments / motions.size() + 1));
        for (const CutSegment& cut : cuts) {
            const SegmentVia segment = encoder.encode(motion, cut);
            if (segment.finer == 0) segments.push_back(segment.via);
        }
    }
    return segments;
}

StreamStatistics learn_table(const StreamModel& model, const std::vector<Motion>& motions,
                             const std::vector<int>& points, int components, double bound_mm,
                             const ModelOptions& options) {
    StreamTools tools;
    tools.head.points = points;
    tools.head.ticks_per_s = kTicksPerSecond;
    tools.head.longest_segment = static_cast<std::uint32_t>(kSyncSeconds * kTicksPerSecond);
    tools.head.bound_mm = bound_mm;
    tools.head.step_mm = bound_mm * options.step_per_bound;
    tools.basis = {model.basis.mean, model.basis.modes.leftCols(components)};
    tools.statistics = plain_statistics(components);
    for (int pass = 0; pass < options.passes; ++pass)
        tools.statistics = learn_statistics(encoded(motions, tools, pass == 0 ? 0 : 1), components, bound_mm,
                                            tools.head.step_mm);
    return tools.statistics;
}

}  // namespace

StreamModel learn_stream_model(const std::string& name, const std::vector<Motion>& motions,
                               const ModelOptions& options) {
    const std::vector<int> points = common_points(motions);
    const RowMatrix rows = gathered(motions, points);
    StreamModel model{name, stored_basis(principal_basis(rows, kMostModes)), {}};
    model.basis.modes =
        Eigen::MatrixXd(model.basis.modes.leftCols(modes_within(model.basis, rows, options.basis_error_mm)));
    const Index learned = model.basis.size();
    if (options.also.rows() > 0)
        model.basis = extended_basis(model.basis, points, options.also, options.also_error_mm);
    const ConfigurationBasis own{model.basis.mean, model.basis.modes.leftCols(learned)};
    std::vector<std::future<StreamStatistics>> tables;
    for (const double bound : options.bounds_mm) {
        const int components = modes_within(own, rows, kBasisShare * bound);
        tables.push_back(std::async(std::launch::async, [&, components, bound] {
            return learn_table(model, motions, points, components, bound, options);
        }));
    }
    for (auto& table : tables) model.tables.push_back(table.get());
    return model;
}

}  // namespace viaface

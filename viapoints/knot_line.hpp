// The working state of via-point analysis: a line of knots over a sampled target, with the spline's
// derivatives at each knot and the largest error in each segment kept up to date as knots come and go.
#pragma once

#include <Eigen/Core>
#include <queue>
#include <vector>

#include "viapoints/spline.hpp"
#include "viapoints/track.hpp"

namespace viaface {

// What the spline is held against. Points are coordinates = offset + modes * values; without modes the values
// are the coordinates themselves.
struct AnalysisTarget {
    std::vector<double> time_s;  // strictly rising, two or more
    RowMatrix values;            // [samples x dimensions] that the spline interpolates
    RowMatrix modes = {};        // [dimensions x 3 * points]; empty for coordinates
    RowMatrix residual =
        {};  // [samples x 3 * points], mm: what the modes do not reach; empty for coordinates

    // Of rows recovered from sample `first` on: the points' differences [rows x 3 * points], mm, target less
    // recovered.
    RowMatrix differences(std::size_t first, const RowMatrix& recovered) const;
};

class KnotLine {
  public:
    // Knots at the ends and at every 64th sample, so that no segment is longer and each change costs bounded
    // work.
    explicit KnotLine(const AnalysisTarget& target);

    void insert_until_within(double limit_mm);
    void take_out_what_is_spare(double limit_mm);
    void settle();  // solves the whole spline and evaluates every segment

    double largest_error_mm() const;
    ViaPointTrack track() const;
    std::size_t evaluations() const { return evaluations_; }

  private:
    static constexpr int kNone = -1;
    struct Knot {
        std::size_t sample;
        int before = kNone, after = kNone;
        Eigen::RowVectorXd point = {}, velocity = {}, acceleration = {};
        double error = 0;  // largest distance in the segment from this knot to the next, both included, mm
        std::size_t worst = 0;  // the sample that has it
        bool alive = true;
    };
    struct Worst {
        double error;
        std::size_t sample;
        int knot;
        bool operator<(const Worst& o) const {
            return error != o.error ? error < o.error : sample > o.sample;
        }
    };
    struct Window {  // knots in order, with the points and derivatives that they would have
        std::vector<int> knots;
        RowMatrix points;  // [knots x dimensions]
        MinimumJerkSystem::Derivatives solution;
    };
    struct SegmentError {
        double error = 0;
        std::size_t worst = 0;
    };

    Knot& knot(int id) { return knots_[static_cast<std::size_t>(id)]; }
    const Knot& knot(int id) const { return knots_[static_cast<std::size_t>(id)]; }
    MinimumJerkSystem system(const Window& window) const;
    std::vector<int> all() const;
    std::vector<int> around(int id, bool without_it) const;
    Window gathered(std::vector<int> ids) const;
    void solve(Window& window) const;
    Window unit_responses(const Window& window, Eigen::Index first, Eigen::Index count) const;
    RowMatrix sampled(const Window& window, std::size_t segment) const;
    RowMatrix sampled(const Window& window) const;
    SegmentError segment_error(const Window& window, std::size_t segment);
    bool within(const Window& window, double limit_mm);
    bool refit(Window& window, std::size_t middle, double limit_mm);
    void adopt(const Window& window);
    void insert_at(int segment_begin);
    double error_without(int id);
    bool take_out(int id, double limit_mm);

    const AnalysisTarget& target_;
    std::vector<Knot> knots_;  // the first is the line's first; linked in order by before and after
    std::priority_queue<Worst> worst_;
    std::size_t evaluations_ = 0;
};

}  // namespace viaface

// The working state of via-point analysis: a line of knots over a sampled target, and the control points of
// the minimum-jerk spline over them, which keeps every sample within the limit from the first fill on. Knots
// are put in, taken out and shifted while that holds; each change concerns a stretch of some twenty knots.
#pragma once

#include <vector>

#include "viapoints/strand_fit.hpp"
#include "viapoints/track.hpp"

namespace viaface {

// What the spline is held against. Points are coordinates = offset + modes * values; without modes the values
// are the coordinates themselves.
struct AnalysisTarget {
    std::vector<double> time_s;  // strictly rising, three or more
    RowMatrix values;            // [samples x dimensions] that the spline follows
    RowMatrix modes = {};        // [dimensions x 3 * points]; empty for coordinates
    RowMatrix residual =
        {};  // [samples x 3 * points], mm: what the modes do not reach; empty for coordinates

    // Of all samples as recovered: the points' differences [samples x 3 * points], mm, target less recovered.
    RowMatrix differences(const RowMatrix& recovered) const;
};

class KnotLine {
  public:
    KnotLine(const AnalysisTarget& target, double limit_mm, double max_gap_ratio,
             const StrandKernel& kernel = best_kernel());

    void fill();          // knots enough for plain least squares to stay within the limit
    std::size_t thin();   // takes out what can be spared; how many went
    std::size_t shift();  // moves knots by a sample where that relieves the worst samples; how many moved

    ViaPointTrack track() const;
    std::size_t evaluations() const { return evaluations_; }

  private:
    static constexpr int kNone = -1;
    struct Knot {
        std::size_t sample = 0;
        int before = kNone, after = kNone;
        bool alive = true;
        bool open = true;  // something near has changed since it was last tried
    };
    enum class Aim { kWithin, kRelief };
    struct Stretch {           // knots in a row; those strictly between `left` and `right` are to change
        std::vector<int> ids;  // kNone for new ones
        std::vector<std::size_t> samples;
        std::vector<double> times;
        int left = 0, right = 0;
        bool first_is_end = false, last_is_end = false;
        FitStretch fit;
        NormalMatrix even;  // where samples weigh the same
        bool even_known = false;
    };

    Knot& knot(int id) { return knots_[static_cast<std::size_t>(id)]; }
    const Knot& knot(int id) const { return knots_[static_cast<std::size_t>(id)]; }
    double time(int id) const { return target_.time_s[knot(id).sample]; }
    bool inner(int id) const { return knot(id).before != kNone && knot(id).after != kNone; }
    int before(int id, int count) const;
    int after(int id, int count) const;
    std::vector<int> all() const;

    std::vector<std::size_t> evenly() const;
    std::vector<std::size_t> split(const std::vector<std::size_t>& samples) const;
    std::vector<std::size_t> graded(std::vector<std::size_t> samples) const;
    void set_line(const std::vector<std::size_t>& samples);

    void gather(int left, int right, const std::vector<std::size_t>& between);
    bool gaps_allowed(int left, int right) const;
    void find_rows();
    double strain(const Lanes* miss) const;
    void hold(std::size_t braid);
    bool fit(std::size_t braid, int rounds);
    bool fits(Aim aim);
    bool replace(int left, int right, const std::vector<std::size_t>& between, Aim aim = Aim::kWithin);
    void relink(int left, int right, const std::vector<std::size_t>& between);
    void adopt();
    double importance(int id) const;
    std::size_t thin(const std::vector<int>& ids);
    bool take_out(int id);
    bool spread_out(int id, int reach);

    const AnalysisTarget& target_;
    double limit_mm2_, max_gap_ratio_;
    PointMeasure measure_;
    std::vector<Braid> braids_;
    std::vector<std::size_t> order_;  // of braids: what last made a change fail is tried first
    std::vector<Knot> knots_;         // the first is the line's first; linked in order by before and after
    std::vector<std::vector<Lanes>> controls_;  // [braids][knots x vectors]
    Stretch stretch_;
    std::vector<BraidFit> fits_;  // [braids]
    FitBench bench_;
    std::size_t evaluations_ = 0;
};

}  // namespace viaface

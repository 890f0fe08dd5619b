#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "facemodel/remesh.hpp"

namespace viaface {
namespace {

constexpr double kCell = 6.0;         // mm
constexpr double kDartRadius = 0.72;  // of the wanted spacing
constexpr double kCandidatesPerSample = 20;
constexpr int kRelaxations = 6;

// Points in space by cell.
class Bins {
  public:
    void add(const Vector3d& place, int index) { bins_[key(place)].push_back(index); }

    template <class Visit>
    void near(const Vector3d& place, double radius, Visit visit) const {
        const int reach = static_cast<int>(std::ceil(radius / kCell));
        for (int x = -reach; x <= reach; ++x) {
            for (int y = -reach; y <= reach; ++y) {
                for (int z = -reach; z <= reach; ++z) {
                    const auto found = bins_.find(key(place + kCell * Vector3d(x, y, z)));
                    if (found == bins_.end()) continue;
                    for (const int index : found->second) visit(index);
                }
            }
        }
    }

  private:
    static std::int64_t key(const Vector3d& place) {
        const auto part = [](double v) { return static_cast<std::int64_t>(std::floor(v / kCell)) + 1000; };
        return (part(place.x()) * 4096 + part(place.y())) * 4096 + part(place.z());
    }
    std::unordered_map<std::int64_t, std::vector<int>> bins_;  // only looked up, never walked
};

struct Candidate {
    Anchor anchor;
    Vector3d place;
    double spacing;
};

double area_of(const Triangle& t, const Nodes& scan) {
    const Vector3d a = scan.row(t[0]), b = scan.row(t[1]), c = scan.row(t[2]);
    return 0.5 * (b - a).cross(c - a).norm();
}

std::vector<Candidate> scatter(const Nodes& scan, const Chart& chart, const Spacing& spacing,
                               const Keep& keep, Dice& dice) {
    std::vector<double> running;
    double sum = 0;
    for (const Triangle& t : chart.triangles()) {
        const Vector3d centre = (scan.row(t[0]) + scan.row(t[1]) + scan.row(t[2])).transpose() / 3;
        const double h = spacing(centre);
        running.push_back(sum += area_of(t, scan) / (h * h));
    }
    std::vector<Candidate> found;
    const auto wanted = static_cast<int>(sum * kCandidatesPerSample);
    for (int i = 0; i < wanted; ++i) {
        const auto at = std::upper_bound(running.begin(), running.end(), dice.unit() * sum) - running.begin();
        const auto index = std::min(static_cast<std::size_t>(at), running.size() - 1);
        const double r = std::sqrt(dice.unit()), s = dice.unit();
        const Anchor anchor{chart.triangles()[index], {1 - r, r * (1 - s), r * s}};
        if (!keep(anchor)) continue;
        const Vector3d place = anchor.at(scan);
        found.push_back({anchor, place, spacing(place)});
    }
    return found;
}

std::vector<int> throw_darts(const std::vector<Candidate>& candidates, const std::vector<Vector3d>& fixed) {
    Bins bins;
    std::vector<Vector3d> places = fixed;
    for (std::size_t i = 0; i < fixed.size(); ++i) bins.add(fixed[i], static_cast<int>(i));
    std::vector<int> chosen;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const double radius = kDartRadius * candidates[i].spacing;
        bool free = true;
        bins.near(candidates[i].place, radius, [&](int other) {
            free = free && (places[static_cast<std::size_t>(other)] - candidates[i].place).norm() > radius;
        });
        if (!free) continue;
        bins.add(candidates[i].place, static_cast<int>(places.size()));
        places.push_back(candidates[i].place);
        chosen.push_back(static_cast<int>(i));
    }
    return chosen;
}

// One step of Lloyd's: each sample moves to the candidate nearest the centre of those that are nearest to it.
void relax(const std::vector<Candidate>& candidates, const std::vector<Vector3d>& fixed,
           std::vector<int>& chosen) {
    Bins bins;
    std::vector<Vector3d> places = fixed;
    for (const int i : chosen) places.push_back(candidates[static_cast<std::size_t>(i)].place);
    for (std::size_t i = 0; i < places.size(); ++i) bins.add(places[i], static_cast<int>(i));
    std::vector<std::vector<int>> cells(places.size());
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        int nearest = -1;
        double least = 1e300;
        bins.near(candidates[i].place, 1.5 * candidates[i].spacing, [&](int other) {
            const double distance =
                (places[static_cast<std::size_t>(other)] - candidates[i].place).squaredNorm();
            if (distance < least) {
                least = distance;
                nearest = other;
            }
        });
        if (nearest >= 0) cells[static_cast<std::size_t>(nearest)].push_back(static_cast<int>(i));
    }
    for (std::size_t s = 0; s < chosen.size(); ++s) {
        const auto& cell = cells[fixed.size() + s];
        if (cell.empty()) continue;
        Vector3d centre = Vector3d::Zero();
        for (const int i : cell) centre += candidates[static_cast<std::size_t>(i)].place;
        centre /= static_cast<double>(cell.size());
        chosen[s] = *std::min_element(cell.begin(), cell.end(), [&](int a, int b) {
            return (candidates[static_cast<std::size_t>(a)].place - centre).squaredNorm() <
                   (candidates[static_cast<std::size_t>(b)].place - centre).squaredNorm();
        });
    }
}

}  // namespace

std::uint64_t Dice::bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
}

double Dice::unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

std::vector<Anchor> sample_surface(const Nodes& scan, const Chart& chart, const std::vector<Anchor>& fixed,
                                   const Spacing& spacing, const Keep& keep, std::uint64_t seed) {
    Dice dice(seed);
    const std::vector<Candidate> candidates = scatter(scan, chart, spacing, keep, dice);
    std::vector<Vector3d> fixed_places;
    for (const Anchor& anchor : fixed) fixed_places.push_back(anchor.at(scan));
    std::vector<int> chosen = throw_darts(candidates, fixed_places);
    for (int i = 0; i < kRelaxations; ++i) relax(candidates, fixed_places, chosen);
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    std::vector<Anchor> samples;
    for (const int i : chosen) samples.push_back(candidates[static_cast<std::size_t>(i)].anchor);
    return samples;
}

}  // namespace viaface

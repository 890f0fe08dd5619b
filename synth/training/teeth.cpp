#include "synth/training/teeth.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace viaface {
namespace {

using Eigen::Vector3d;
constexpr int kSections = 5, kAround = 9, kPerSide = 7, kNodesPerTooth = kSections * kAround + 1;

// One crown: where its middle stands (mm), which way it faces (degrees from straight ahead), how wide it is
// along the arch and deep across it, its edge's height, how thin its edge is (part of its depth) and how
// pointed.
struct Crown {
    double x, z, facing, width, depth, edge, thin, point;
};
constexpr std::array<Crown, kPerSide> kUpper = {{{4.25, -1.9, 5, 8.5, 6.6, 0.0, 0.28, 0.0},
                                                 {11.5, -3.7, 23, 6.7, 6.0, 0.7, 0.28, 0.1},
                                                 {16.8, -8.9, 48, 8.0, 7.0, 0.3, 0.35, 0.9},
                                                 {20.2, -15.8, 68, 7.2, 8.6, 0.9, 0.75, 0.5},
                                                 {22.3, -22.8, 72, 7.2, 8.8, 1.3, 0.75, 0.4},
                                                 {24.2, -31.2, 75, 9.8, 9.4, 1.6, 0.85, 0.2},
                                                 {25.8, -40.8, 79, 9.4, 9.4, 2.1, 0.85, 0.2}}};
constexpr std::array<Crown, kPerSide> kLower = {{{2.8, -3.9, 4, 5.6, 5.8, 0.3, 0.28, 0.0},
                                                 {8.4, -5.0, 20, 6.0, 5.8, 0.5, 0.28, 0.1},
                                                 {13.7, -9.0, 45, 7.2, 6.6, 0.9, 0.35, 0.8},
                                                 {17.5, -15.2, 64, 7.2, 7.4, 0.5, 0.7, 0.5},
                                                 {19.9, -22.2, 70, 7.4, 7.8, 0.5, 0.75, 0.4},
                                                 {22.0, -30.9, 74, 10.4, 8.4, 0.9, 0.85, 0.2},
                                                 {23.8, -41.0, 78, 10.0, 8.4, 1.5, 0.85, 0.2}}};
constexpr double kCrownHeight = 11.5;  // mm, from the edge to a neck within the gum

constexpr std::array<double, kSections> kHeights = {0, 0.42, 0.76, 0.94, 1};
constexpr std::array<double, kSections> kWidths = {0.74, 0.95, 1.02, 1.0, 0.92};

// Round a crown from the middle of its face: sideways and outwards, parts of half its width and depth.
constexpr std::array<std::array<double, 2>, kAround> kRound = {{{0, 1},
                                                                {0.5, 0.97},
                                                                {0.9, 0.78},
                                                                {1, 0.35},
                                                                {0.6, -0.9},
                                                                {-0.6, -0.9},
                                                                {-1, 0.35},
                                                                {-0.9, 0.78},
                                                                {-0.5, 0.97}}};

// One crown where it stands: mirror, the talker's side; side, +1 above; strip, its part of the texture.
// Sections go from the neck (0) to the edge (kSections - 1), then comes the middle of the biting face.
// Crowns touch at the third section; their edges' corners are round, the outer one more.
class StandingCrown {
  public:
    StandingCrown(const Crown& crown, double mirror, double side, int strip)
        : crown_(crown), side_(side), strip_(strip), flipped_(mirror * side > 0) {
        const double facing = crown.facing * std::numbers::pi / 180;
        out_ = Vector3d(mirror * std::sin(facing), 0, std::cos(facing));
        along_ = Vector3d(mirror * std::cos(facing), 0, -std::sin(facing));
        middle_ = Vector3d(mirror * crown.x, crown.edge, crown.z);
    }

    void add_to(PartMesh& part, int first) const {
        for (int s = 0; s < kSections; ++s) {
            for (int k = 0; k < kAround; ++k) {
                part.nodes.row(first + s * kAround + k) = place(s, k).transpose();
                part.uvs.row(first + s * kAround + k) =
                    uv(kRound[static_cast<std::size_t>(k)][0], kHeights[static_cast<std::size_t>(s)]);
            }
        }
        const int cap = first + kSections * kAround;
        part.nodes.row(cap) = biting_middle().transpose();
        part.uvs.row(cap) = uv(0, 1);
        add_triangles(part, first, cap);
    }

  private:
    Vector3d place(int section, int round) const {
        const double h = kHeights[static_cast<std::size_t>(section)];
        const auto [sideways, across] = kRound[static_cast<std::size_t>(round)];
        const double edge_part = std::pow(h, 1.4);
        const double depth =
            crown_.depth * ((1 - edge_part) + edge_part * crown_.thin) * (section == kSections - 1 ? 0.8 : 1);
        const double front =
            crown_.depth * 0.5 * (1 - 0.10 * h * h);  // the face leans back a little at the edge
        const double width = crown_.width * kWidths[static_cast<std::size_t>(section)];
        const double corner = (sideways > 0 ? 0.9 : 0.4) * std::pow(std::abs(sideways), 5) * std::pow(h, 6);
        const double lift = crown_.point * 1.6 * sideways * sideways * h * h + corner;
        const double bow = 0.10 * crown_.width * sideways * sideways;  // a face is round from side to side
        return middle_ + out_ * (front - depth * (0.5 - 0.5 * across) - bow) +
               along_ * (0.5 * width * sideways) + Vector3d(0, side_ * (kCrownHeight * (1 - h) + lift), 0);
    }

    Vector3d biting_middle() const {
        const double inset = crown_.depth * 0.5 * (0.9 - crown_.thin * 0.8);
        return middle_ + out_ * inset + Vector3d(0, side_ * 0.05, 0);
    }

    Eigen::RowVector2f uv(double sideways, double h) const {
        constexpr double kHalf = 0.36, kFoot = 0.03;  // of the strip: off its rims
        return {static_cast<float>((strip_ + 0.5 + kHalf * sideways) / (2 * kPerSide)),
                static_cast<float>(kFoot + (1 - 2 * kFoot) * h)};
    }

    void add_triangles(PartMesh& part, int first, int cap) const {
        const auto add = [&](int a, int b, int c) {
            part.triangles.push_back(flipped_ ? Triangle{a, c, b} : Triangle{a, b, c});
        };
        const auto node = [&](int s, int k) { return first + s * kAround + k % kAround; };
        for (int k = 0; k < kAround; ++k) {
            for (int s = 0; s + 1 < kSections; ++s) {
                add(node(s, k), node(s + 1, k + 1), node(s + 1, k));
                add(node(s, k), node(s, k + 1), node(s + 1, k + 1));
            }
            add(node(kSections - 1, k), node(kSections - 1, k + 1), cap);
        }
    }

    const Crown& crown_;
    double side_;
    int strip_;
    bool flipped_;
    Vector3d out_, along_, middle_;
};

PartMesh teeth(const std::array<Crown, kPerSide>& arch, double side, std::string name, Drive drive) {
    PartMesh part{std::move(name),
                  Material::kTeeth,
                  drive,
                  Nodes(2 * kPerSide * kNodesPerTooth, 3),
                  Uvs(2 * kPerSide * kNodesPerTooth, 2),
                  {}};
    for (int i = 0; i < 2 * kPerSide; ++i) {
        const double mirror = i < kPerSide ? 1 : -1;
        StandingCrown(arch[static_cast<std::size_t>(i % kPerSide)], mirror, side, i)
            .add_to(part, i * kNodesPerTooth);
    }
    return part;
}

// The arch as a curve: 0 at the right end, 1 at the left, through the crowns' middles.
Crown on_arch(const std::array<Crown, kPerSide>& arch, double t) {
    const double place = t * (2 * kPerSide - 1);
    const int k = std::min(static_cast<int>(place), 2 * kPerSide - 2);
    const auto crown = [&](int i) {
        Crown c = arch[static_cast<std::size_t>(i < kPerSide ? kPerSide - 1 - i : i - kPerSide)];
        if (i < kPerSide) {
            c.x = -c.x;
            c.facing = -c.facing;
        }
        return c;
    };
    const Crown a = crown(k), b = crown(k + 1);
    const double s = place - k, r = 1 - s;
    return {r * a.x + s * b.x,
            r * a.z + s * b.z,
            r * a.facing + s * b.facing,
            0,
            r * a.depth + s * b.depth,
            r * a.edge + s * b.edge,
            0,
            0};
}

PartMesh gums(const std::array<Crown, kPerSide>& arch, double side, std::string name, Drive drive) {
    constexpr int kSteps = 4 * (2 * kPerSide - 1) + 1, kAcross = 8;
    // Across the ridge, from the lip's side to the tongue's: outwards of the crown's faces, above the edge,
    // mm. The last two close the roof or leave the floor open, as parts of the way to the middle.
    struct Profile {
        double out, up;
    };
    constexpr std::array<Profile, 6> kProfile = {
        {{0.5, 22}, {1.5, 15}, {0.9, 10.6}, {-1.6, 9.2}, {-1, 9.6}, {-2.5, 13}}};
    PartMesh part{
        std::move(name), Material::kGums, drive, Nodes(kSteps * kAcross, 3), Uvs(kSteps * kAcross, 2), {}};
    for (int i = 0; i < kSteps; ++i) {
        const double t = static_cast<double>(i) / (kSteps - 1);
        const Crown crown = on_arch(arch, t);
        const double facing = crown.facing * std::numbers::pi / 180;
        const Vector3d out(std::sin(facing), 0, std::cos(facing)), middle(crown.x, crown.edge, crown.z);
        const double papilla = 1.8 * (0.5 - 0.5 * std::cos(2 * std::numbers::pi * t * (2 * kPerSide - 1)));
        for (int k = 0; k < kAcross; ++k) {
            Vector3d place;
            if (k < 6) {
                const auto [outward, up] = kProfile[static_cast<std::size_t>(k)];
                const double half = k < 4 ? crown.depth / 2 : -crown.depth / 2;
                const double fold = k == 2 || k == 3 ? papilla : 0;
                place = middle + out * (half + outward) + Vector3d(0, side * (up - fold), 0);
            } else {
                const double inwards = k == 6 ? 0.45 : 0.0;
                place = Vector3d(inwards * crown.x, side * (k == 6 ? 17.5 : 19.5), crown.z - 6);
            }
            part.nodes.row(i * kAcross + k) = place.transpose();
            part.uvs.row(i * kAcross + k) << static_cast<float>(t), static_cast<float>(k) / (kAcross - 1);
        }
    }
    for (int i = 0; i + 1 < kSteps; ++i) {
        for (int k = 0; k + 1 < kAcross; ++k) {
            const int a = i * kAcross + k, b = a + kAcross, c = b + 1, d = a + 1;
            part.triangles.push_back(side > 0 ? Triangle{a, d, c} : Triangle{a, c, d});
            part.triangles.push_back(side > 0 ? Triangle{a, c, b} : Triangle{a, b, c});
        }
    }
    return part;
}

}  // namespace

PartMesh upper_teeth() { return teeth(kUpper, +1, "teeth_upper", Drive::kFixed); }
PartMesh lower_teeth() { return teeth(kLower, -1, "teeth_lower", Drive::kJaw); }
PartMesh upper_gums() { return gums(kUpper, +1, "gums_upper", Drive::kFixed); }
PartMesh lower_gums() { return gums(kLower, -1, "gums_lower", Drive::kJaw); }

}  // namespace viaface

// Small natural motion of the head: slow turns about three axes, each a sum of waves of seeded lengths and
// phases, so that the same seed gives the same motion at any frame rate. Frequencies are those at which heads
// drift while people speak, below 1 Hz. Departure: it does not know what is said.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "facemodel/face.hpp"

namespace viaface {

struct HeadTurn {
    double left = 0, up = 0,
           roll = 0;  // degrees: to the talker's left, chin up, towards the talker's right ear
    bool operator==(const HeadTurn&) const = default;
};

class HeadSway {
  public:
    static constexpr double kWidest = 10;  // degrees

    // amplitude: degrees that a turn to either side never exceeds; nods are two thirds and tilts half of it.
    // InputError("head_motion", ...) outside 0 to kWidest.
    HeadSway(double amplitude, std::uint64_t seed);

    HeadTurn at(double time_s) const;

  private:
    static constexpr int kWaves = 3;
    struct Wave {
        double height, frequency, phase;  // degrees, Hz, radians
    };
    std::array<std::array<Wave, kWaves>, 3> axes_;  // left, up, roll
};

inline const Eigen::Vector3d kNeckPivot(0, -25, -110);  // mm: where skull and neck turn

// The neck lets the head turn while the shoulders stand still.
class Neck {
  public:
    explicit Neck(const Face& face);
    void turn(Nodes& posed, const HeadTurn& turn) const;

  private:
    std::vector<float> shares_;  // of the turn, by node: 1 the head, 0 the shoulders
};

}  // namespace viaface

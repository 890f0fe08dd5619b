// Made-up mouths, the same on every machine.
#pragma once

#include <cmath>
#include <cstdint>

#include "lipmodel/lip_body.hpp"
#include "lipmodel/lip_mesh.hpp"
#include "lipmodel/modes.hpp"

namespace viaface::test {

// Uniform in [-1, 1), by a linear congruence (Knuth's MMIX constants).
class Noise {
  public:
    explicit Noise(std::uint64_t seed) : state_(seed) {}
    double operator()() {
        state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
        return static_cast<double>(state_ >> 11) * 0x1p-52 - 1.0;
    }
    Eigen::MatrixXd matrix(Eigen::Index rows, Eigen::Index columns) {
        return Eigen::MatrixXd::NullaryExpr(rows, columns, [this] { return (*this)(); });
    }

  private:
    std::uint64_t state_;
};

// A mouth at rest that is not the generic one: narrower, fuller, 4 mm lower, a little askew.
inline MarkedPoints resting_mouth() {
    MarkedPoints points = marked_of(as_column(generic_lip_mesh().nodes));
    for (int i = 0; i < LipMesh::kMarked; ++i) {
        Eigen::Ref<Eigen::Vector3d> p = points.segment<3>(3 * i);
        p = Eigen::Vector3d(0.9 * p.x(), 1.15 * p.y() - 4 + 0.02 * p.x(), p.z() - 1);
    }
    return points;
}

// Speaking: opening, spreading, protrusion, a skewed smile and a bite, at unlike frequencies. [48 x frames]
inline Eigen::MatrixXd speaking_mouth(int frames) {
    const MarkedPoints rest = resting_mouth();
    Eigen::MatrixXd spoken(rest.size(), frames);
    for (int n = 0; n < frames; ++n) {
        const double open = 0.5 - 0.5 * std::cos(0.37 * n), spread = std::sin(0.23 * n + 1);
        const double out = std::sin(0.11 * n + 2), skew = 0.5 * std::sin(0.071 * n),
                     bite = std::sin(0.53 * n);
        for (int i = 0; i < LipMesh::kMarked; ++i) {
            const int round = i % 8;
            const double low = round >= 3 && round <= 5 ? 1 : (round == 2 || round == 6 ? 0.4 : 0);
            Eigen::Vector3d p = rest.segment<3>(3 * i);
            const double side = p.x() / 25, middle = 1 - side * side;
            p.x() += 3 * spread * side;
            p.y() += -12 * open * low * middle + 2 * skew * side - (low > 0.5 ? bite : 0);
            p.z() += 4 * out * middle - 3 * open * low - spread * (1 - middle) - (low > 0.5 ? 1.5 * bite : 0);
            spoken.col(n).segment<3>(3 * i) = p;
        }
    }
    return spoken;
}

struct Learned {
    int kept = 10;
    double noise_mm = 0.001;
    Eigen::MatrixXd frames = speaking_mouth(300);
    LipBody body = lip_body(resting_mouth());
    LipModel model = learn_lips(body, frames, {.modes = kept, .noise_mm = noise_mm});
};
inline const Learned& learned() {
    static const Learned made;
    return made;
}

}  // namespace viaface::test

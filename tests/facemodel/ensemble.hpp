// Made-up ensembles of shapes, the same on every machine.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace viaface::test {

// Uniform in [-1, 1), by a linear congruence (Knuth's MMIX constants).
inline Eigen::MatrixXd noise(int rows, int columns, std::uint64_t seed) {
    Eigen::MatrixXd made(rows, columns);
    for (int c = 0; c < columns; ++c) {
        for (int r = 0; r < rows; ++r) {
            seed = seed * 6364136223846793005ull + 1442695040888963407ull;
            made(r, c) = static_cast<double>(seed >> 11) * 0x1p-52 - 1.0;
        }
    }
    return made;
}

// `columns` shapes of `rows` numbers about 100 mm from the origin, that differ by `rank` patterns of falling
// size.
inline Eigen::MatrixXd ensemble(int rows, int columns, int rank, std::uint64_t seed) {
    const Eigen::VectorXd centre = 100.0 * noise(rows, 1, seed + 1);
    Eigen::MatrixXd weights = noise(rank, columns, seed + 2);
    for (int i = 0; i < rank; ++i) weights.row(i) *= 10.0 / (1 + i);
    return (noise(rows, rank, seed + 3) * weights).colwise() + centre;
}

}  // namespace viaface::test

#include "synth/training/bake_noise.hpp"

#include <cmath>
#include <cstdint>

namespace viaface {

// An integer hash of the murmur kind: multiply, shift, exclusive or.
float lattice(int x, int y, int z) {
    std::uint32_t h =
        std::uint32_t(x) * 0x8da6b343u ^ std::uint32_t(y) * 0xd8163841u ^ std::uint32_t(z) * 0xcb1ab31fu;
    h = (h ^ h >> 16) * 0x7feb352du;
    h = (h ^ h >> 15) * 0x846ca68bu;
    return static_cast<float>((h ^ h >> 16) >> 8) / 16777216.0f;
}

float noise(const Eigen::Vector3f& place) {
    int cell[3];
    float share[3];
    for (int k = 0; k < 3; ++k) {
        const float floor = std::floor(place[k]);
        cell[k] = static_cast<int>(floor);
        const float t = place[k] - floor;
        share[k] = t * t * (3 - 2 * t);
    }
    float sum[2];
    for (int z = 0; z < 2; ++z) {
        float row[2];
        for (int y = 0; y < 2; ++y) {
            row[y] = mix(lattice(cell[0], cell[1] + y, cell[2] + z),
                         lattice(cell[0] + 1, cell[1] + y, cell[2] + z), share[0]);
        }
        sum[z] = mix(row[0], row[1], share[1]);
    }
    return mix(sum[0], sum[1], share[2]);
}

float fractal(const Eigen::Vector3f& place, int octaves) {
    float sum = 0, weight = 0.5f, total = 0;
    Eigen::Vector3f at = place;
    for (int k = 0; k < octaves; ++k) {
        sum += weight * noise(at);
        total += weight;
        at = 2.03f * at + Eigen::Vector3f::Constant(7.1f);
        weight /= 2;
    }
    return sum / total;
}

}  // namespace viaface

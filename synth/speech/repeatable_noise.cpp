#include "synth/speech/repeatable_noise.hpp"

namespace {

thread_local std::uint64_t noise_state = 0;

}  // namespace

// SplitMix64 [Steele14], its upper 31 bits: 0 to RAND_MAX as rand() gives.
extern "C" int __wrap_rand() {
    noise_state += 0x9e3779b97f4a7c15ull;
    std::uint64_t z = noise_state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return static_cast<int>((z ^ (z >> 31)) >> 33);
}

void viaface::seed_noise(std::uint64_t seed) { noise_state = seed; }

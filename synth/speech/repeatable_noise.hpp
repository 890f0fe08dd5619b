// The noise of Flite's statistical voices comes from libc's rand(), which all threads share. Programs that
// link this room are linked with --wrap=rand, so that Flite's static libraries draw from a generator of each
// thread instead.
#pragma once

#include <cstdint>

namespace viaface {

// The next draw of this thread begins the sequence of `seed`.
void seed_noise(std::uint64_t seed);

}  // namespace viaface

// Work on all cores whose result does not depend on which core does what.
#pragma once

#include <cstddef>
#include <functional>

namespace viaface {

// job(i) for every i below count. The first failure is thrown on, once all have ended.
void in_parallel(std::size_t count, const std::function<void(std::size_t)>& job);

}  // namespace viaface

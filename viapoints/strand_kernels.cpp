#include "viapoints/strand_kernel.hpp"

namespace viaface {
namespace strands {

namespace baseline {
extern const StrandKernel kernel;
}
namespace avx2 {
extern const StrandKernel kernel;
}

}  // namespace strands

const StrandKernel& baseline_kernel() { return strands::baseline::kernel; }

const StrandKernel& best_kernel() {
#ifdef VIAFACE_AVX2_KERNEL
    if (__builtin_cpu_supports("avx2")) return strands::avx2::kernel;
#endif
    return baseline_kernel();
}

}  // namespace viaface

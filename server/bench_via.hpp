// `viaface bench via`.
#pragma once

#include "server/commands.hpp"

namespace viaface {

Command add_bench_via(CLI::App& bench);

}  // namespace viaface

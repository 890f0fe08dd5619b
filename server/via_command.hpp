// The parts of `viaface via`: each adds its subcommand and returns what runs when it was called.
#pragma once

#include "server/commands.hpp"

namespace viaface {

Command add_via_analyse(CLI::App& via);

}  // namespace viaface

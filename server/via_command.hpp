// The parts of `viaface via`: each adds its subcommand and returns what runs when it was called.
#pragma once

#include "server/commands.hpp"

namespace viaface {

Command add_via_analyse(CLI::App& via);
Command add_via_encode(CLI::App& via);
Command add_via_decode(CLI::App& via);
Command add_via_info(CLI::App& via);
Command add_via_learn(CLI::App& via);

}  // namespace viaface

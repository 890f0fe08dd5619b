// Commands that are made of subcommands.
#pragma once

#include <span>

#include "server/commands.hpp"

namespace viaface {

using CommandAdder = Command (*)(CLI::App&);

// Adds them to `app`, of which one has to be called; runs the one that was.
Command one_of(CLI::App& app, std::span<const CommandAdder> adders);

}  // namespace viaface

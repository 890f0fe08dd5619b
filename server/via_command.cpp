#include "server/via_command.hpp"

#include <array>

#include "server/subcommands.hpp"

namespace viaface {

Command add_via(CLI::App& program) {
    CLI::App* app = program.add_subcommand("via", "Motion as via points.");
    return one_of(*app, std::array<CommandAdder, 5>{add_via_analyse, add_via_encode, add_via_decode,
                                                    add_via_info, add_via_learn});
}

}  // namespace viaface

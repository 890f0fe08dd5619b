#include "server/via_command.hpp"

#include <utility>
#include <vector>

namespace viaface {

Command add_via(CLI::App& program) {
    CLI::App* app = program.add_subcommand("via", "Motion as via points.");
    app->require_subcommand(1);
    using Adder = Command (*)(CLI::App&);
    const Adder adders[] = {add_via_analyse, add_via_encode, add_via_decode, add_via_info, add_via_learn};
    std::vector<std::pair<const CLI::App*, Command>> commands;
    for (const Adder add : adders) {
        Command command = add(*app);
        commands.emplace_back(app->get_subcommands({}).back(), std::move(command));
    }
    return [commands] {
        for (const auto& [subcommand, command] : commands) {
            if (subcommand->parsed()) return command();
        }
        throw std::logic_error("via was called without a subcommand");
    };
}

}  // namespace viaface

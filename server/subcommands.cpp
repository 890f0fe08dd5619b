#include "server/subcommands.hpp"

#include <stdexcept>
#include <utility>
#include <vector>

namespace viaface {

Command one_of(CLI::App& app, std::span<const CommandAdder> adders) {
    app.require_subcommand(1);
    std::vector<std::pair<const CLI::App*, Command>> commands;
    for (const CommandAdder add : adders) {
        Command command = add(app);
        commands.emplace_back(app.get_subcommands({}).back(), std::move(command));
    }
    return [name = app.get_name(), commands] {
        for (const auto& [subcommand, command] : commands) {
            if (subcommand->parsed()) return command();
        }
        throw std::logic_error(name + " was called without a subcommand");
    };
}

}  // namespace viaface

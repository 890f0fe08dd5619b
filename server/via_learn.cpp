#include <cstdio>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "server/via_command.hpp"
#include "viapoints/motion_csv.hpp"
#include "viapoints/stream_train.hpp"

namespace viaface {

Command add_via_learn(CLI::App& via) {
    struct Options {
        std::vector<std::string> motions;
        std::string output, name;
    };
    auto options = std::make_shared<Options>();
    CLI::App* app = via.add_subcommand(
        "learn", "A stream model of a talker (basis and statistics) from recorded motions.");
    app->add_option("motions", options->motions, "motion CSV in mm, one or more")->required();
    app->add_option("-o,--output", options->output, "the model's file: stream.bin of a talker's folder")
        ->required();
    app->add_option("--name", options->name, "the talker's name")->required();
    return [options] {
        if (options->name.empty() || options->name.size() > 64)
            throw InputError("name", options->name, "1 to 64 bytes");
        std::vector<Motion> motions;
        for (const std::string& file : options->motions) motions.push_back(read_motion_csv(file).motion);
        const StreamModel model = learn_stream_model(options->name, motions);
        const Bytes bytes = write_stream_model(model);
        write_whole(options->output, bytes);
        std::printf("%d modes, %zu tables, %zu bytes\n", static_cast<int>(model.basis.size()),
                    model.tables.size(), bytes.size());
        return 0;
    };
}

}  // namespace viaface

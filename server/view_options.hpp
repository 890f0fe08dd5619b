// The options of the command line that say from where the face is seen, and what of it.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "synth/picture/view.hpp"

namespace viaface {

struct ViewOptions {
    View view;
    std::string size = "512x512", background, shown{kShownNames.front()};
    bool texture_off = false;

    // InputError naming what is not allowed.
    View parsed() const;
};

void add_view_options(CLI::App& app, ViewOptions& options);

}  // namespace viaface

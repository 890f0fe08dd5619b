#include "server/view_options.hpp"

#include "server/request_fields.hpp"
#include "server/requests.hpp"

namespace viaface {

View ViewOptions::parsed() const {
    View parsed = view;
    set_size(parsed, size);
    if (!background.empty()) parsed.background = parse_background(background);
    parsed.shown = shown_of(shown);
    parsed.texture = !texture_off;
    check(parsed);
    return parsed;
}

void add_view_options(CLI::App& app, ViewOptions& options) {
    View& view = options.view;
    app.add_option("--size", options.size, description_of("size"))->capture_default_str();
    app.add_option("--view", options.shown, description_of("show"))->capture_default_str();
    app.add_option("--yaw", view.yaw, description_of("yaw"))->capture_default_str();
    app.add_option("--tilt", view.tilt, description_of("tilt"))->capture_default_str();
    app.add_option("--roll", view.roll, description_of("roll"))->capture_default_str();
    app.add_option("--field-of-view", view.field_of_view, description_of("field_of_view"))
        ->capture_default_str();
    app.add_flag("--orthographic", view.orthographic, description_of("orthographic"));
    app.add_option("--px-per-mm", view.px_per_mm, description_of("px_per_mm"));
    app.add_flag("--texture-off", options.texture_off, "each material in one colour");
    app.add_flag("--eyes-occluded", view.eyes_occluded, description_of("eyes_occluded"));
    app.add_option("--background", options.background, description_of("background"));
}

}  // namespace viaface

// What a person looks like apart from the shape: colours, hair, brows, marks of age. Places are those of the
// head without anyone's identity, so that one set of measures serves every person.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace viaface {

struct Srgb {
    float red, green, blue;  // 0 to 255
};

struct Complexion {
    Srgb skin{210, 162, 141};
    float redness = 1;                            // of cheeks, nose, ears and lids, times momo's
    Eigen::Vector3f lips{0.80f, 0.46f, 0.45f};    // times the skin
    float freckles = 1;                           // times momo's
    float beard = 1;                              // shaven, times momo's
    Eigen::Vector3f shaven{0.56f, 0.56f, 0.60f};  // times the skin, where the beard is densest
    float age = 0;                                // 0 to 1: creases, bags under the eyes, spots
};

// A knot of tied hair, an ellipsoid behind the head.
struct HairKnot {
    Eigen::Vector3f middle, radii;  // mm
};

struct HairStyle {
    Srgb colour{46, 33, 25};
    float grey = 0;                               // share of grey hairs
    float thickness = 2.8f;                       // mm where it stands off most
    float flat_crown = 0.85f;                     // of that, missing on the crown
    float forehead = 0;                           // mm: how much higher the line is in the middle
    float temples = 0;                            // mm: how much higher at the temples
    float oval = 0;                               // 0 short hair's line, 1 an oval one without sideburns
    float fade_from = -9, fade_to = 17;           // mm behind the line: from none to all
    float full_at = 34;                           // mm behind the line: where it stands off most
    float ragged = 1;                             // how uneven the line is, times momo's
    float cover = 0.62f;                          // of the skin between the hairs where they begin
    std::optional<HairKnot> knot = std::nullopt;  // combed back to it
};

struct Brows {
    float half_width = 3.7f;  // mm, at the nose
    float grey = 1;           // of the hair's share
    float rise = 0;           // mm above momo's
    float cover = 0.93f;
};

struct Looks {
    Complexion complexion;
    HairStyle hair;
    Brows brows;
    Srgb iris_inner{122, 86, 50}, iris_outer{84, 88, 74};
    float lash_line = 0.75f;  // how dark the upper lashes' roots are
    Srgb cloth{44, 52, 70};
};

}  // namespace viaface

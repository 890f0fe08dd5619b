// What each material looks like at a place of the resting face.
#pragma once

#include <array>

#include "synth/training/bake.hpp"
#include "synth/training/bake_creases.hpp"
#include "synth/training/bake_noise.hpp"
#include "synth/training/bake_texels.hpp"

namespace viaface {

struct Paint {
    Eigen::Vector3f colour;  // linear light, 0 to 1
    float roughness = 0.5f;
    float thinness = 0;  // light that comes through from behind
    float alpha = 1;
    float open = 1;  // openness of its own, beyond what the mesh shows
};

Eigen::Vector3f linear_from_srgb(float red, float green, float blue);  // 0 to 255
inline Eigen::Vector3f linear_from(const Srgb& colour) {
    return linear_from_srgb(colour.red, colour.green, colour.blue);
}

// Skin with lips, brows, hair, stubble, nostrils, and the shirt below the collar.
class SkinPaint {
  public:
    // canvas: as of bake_surfaces(); looks outlives this.
    SkinPaint(const Face& canvas, const Landmarks& landmarks, const Looks& looks);
    Paint at(const Texel& texel, float open) const;
    float height(const Eigen::Vector3f& place) const;  // mm above the mesh: pores, creases, hair

  private:
    struct Brow {
        float along, above, out;  // 0 inner to 1 outer end; mm; mm
    };
    float lip_depth(const Eigen::Vector3f& place) const;  // mm into the red of the lips, < 0 outside
    float lid_distance(const Eigen::Vector3f& place) const;
    float upper_lash_line(const Eigen::Vector3f& place) const;
    Brow brow(const Eigen::Vector3f& place) const;
    float near(int landmark, const Eigen::Vector3f& offset, const Eigen::Vector3f& place, float radius) const;
    Eigen::Vector3f complexion(const Eigen::Vector3f& place) const;
    float brow_cover(const Eigen::Vector3f& place) const;
    float stubble(const Eigen::Vector3f& place) const;
    float nostril(const Eigen::Vector3f& place, float open) const;
    Eigen::Vector3f hair_colour(const Eigen::Vector3f& strand, float share) const;

    std::array<Eigen::Vector3f, 68> marks_;
    std::array<Eigen::Vector3f, LipGrid::kColumns> border_;
    const Looks& looks_;
    Creases creases_;
};

// The left eye's lids: inner corner, two of the upper lid, outer corner, two of the lower lid.
using EyeLids = std::array<Eigen::Vector3f, 6>;

// Of the left eye; the right one wears its mirror picture. apex: the foremost place of the eyeball.
Paint eye_paint(const Texel& texel, const Eigen::Vector3f& apex, const EyeLids& lids, const Looks& looks);
Paint teeth_paint(const Texel& texel);
Paint gums_paint(const Texel& texel);
Paint tongue_paint(const Texel& texel);
Paint lining_paint(const Texel& texel);
Paint lash_paint(const Texel& texel);
Paint cloth_paint(const Eigen::Vector3f& place, const Srgb& colour);

float tongue_height(const Eigen::Vector3f& place);  // mm

}  // namespace viaface

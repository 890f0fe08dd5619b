#include "synth/training/bake.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "synth/training/bake_occlusion.hpp"
#include "synth/training/bake_paint.hpp"
#include "synth/training/bake_texels.hpp"

namespace viaface {
namespace {

using Eigen::Vector3f;
using PaintAt = std::function<Paint(const Texel&, float open)>;
using HeightAt = std::function<float(const Vector3f&)>;

constexpr int kSpread = 24;  // texels: smaller mip levels mix so many

std::uint8_t byte(float share) { return static_cast<std::uint8_t>(clamp01(share) * 255 + 0.5f); }

float srgb(float linear) {
    const float c = clamp01(linear);
    return c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f;
}

Texture blank(int side, int channels, std::uint8_t value) {
    return {side, side, channels, std::vector<std::uint8_t>(std::size_t(side) * side * channels, value)};
}

// Everything that keeps light off a material: the outside of the head, without the material itself where it
// touches itself (lips), moves (lashes, eyes) or has its light from the mouth's opening.
std::vector<Triangle> casters(const Face& face, Material onto) {
    std::vector<Triangle> triangles;
    for (const FacePart& part : face.parts) {
        const bool outside = part.material == Material::kSkin || part.material == Material::kCloth ||
                             (part.material == Material::kLips && onto != Material::kLips);
        if (outside) triangles.insert(triangles.end(), part.triangles.begin(), part.triangles.end());
    }
    return triangles;
}

bool lit_from_outside(Material m) {
    return m == Material::kSkin || m == Material::kLips || m == Material::kCloth;
}

void paint_surface(Surface& surface, const TexelGrid& grid, const std::vector<float>& open,
                   const PaintAt& paint_at, bool transparent) {
    const int channels = transparent ? 4 : 3;
    surface.base_colour = blank(grid.side, channels, 0);
    surface.occlusion_roughness = blank(grid.side, 3, 255);
    for (std::size_t i = 0; i < grid.texels.size(); ++i) {
        if (grid.texels[i].part < 0) continue;
        const Paint paint = paint_at(grid.texels[i], open[i]);
        std::uint8_t* colour = &surface.base_colour.pixels[i * channels];
        for (int k = 0; k < 3; ++k) colour[k] = byte(srgb(paint.colour[k]));
        if (transparent) colour[3] = byte(paint.alpha);
        std::uint8_t* shade = &surface.occlusion_roughness.pixels[i * 3];
        shade[0] = byte(open[i] * paint.open);
        shade[1] = byte(paint.roughness);
        shade[2] = byte(paint.thinness);
    }
    spread(surface.base_colour, grid, kSpread);
    spread(surface.occlusion_roughness, grid, kSpread);
}

// Slopes of the height along the texture's axes, by central differences; 128 is level.
Texture normal_texture(const TexelGrid& grid, const HeightAt& height) {
    constexpr float kStep = 0.3f;  // mm
    Texture texture = blank(grid.side, 3, 128);
    for (std::size_t i = 0; i < grid.texels.size(); ++i) {
        const Texel& t = grid.texels[i];
        std::uint8_t* pixel = &texture.pixels[i * 3];
        pixel[2] = 255;
        if (t.part < 0) continue;
        const auto slope = [&](const Vector3f& way) {
            return (height(t.place + kStep * way) - height(t.place - kStep * way)) / (2 * kStep);
        };
        const Vector3f normal = Vector3f(-slope(t.along_u), -slope(t.along_v), 1).normalized();
        for (int k = 0; k < 3; ++k) pixel[k] = static_cast<std::uint8_t>(128.5f + 127 * normal[k]);
    }
    spread(texture, grid, kSpread);
    return texture;
}

Vector3f apex(const Face& face, const FacePart& part) {
    Eigen::Index foremost = 0;
    face.rest.middleRows(part.first_node, part.nodes).col(2).maxCoeff(&foremost);
    return face.rest.row(part.first_node + foremost).transpose().cast<float>();
}

struct Recipe {
    Material material;
    int side;  // texels
    PaintAt paint;
    HeightAt height;  // none: a smooth surface
};

std::vector<Recipe> recipes(const Face& canvas, const SkinPaint& skin, const EyeLids& lids,
                            const Looks& looks) {
    const PaintAt skin_paint = [&](const Texel& t, float open) { return skin.at(t, open); };
    const HeightAt skin_height = [&](const Vector3f& p) { return skin.height(p); };
    const PaintAt eye = [&](const Texel& t, float) {
        return eye_paint(t, apex(canvas, canvas.parts[t.part]), lids, looks);
    };
    const PaintAt cloth = [&](const Texel& t, float) { return cloth_paint(t.place, looks.cloth); };
    return {{Material::kSkin, 1536, skin_paint, skin_height},
            {Material::kLips, 512, skin_paint, skin_height},
            {Material::kEye, 512, eye, nullptr},
            {Material::kTeeth, 256, [](const Texel& t, float) { return teeth_paint(t); }, nullptr},
            {Material::kGums, 256, [](const Texel& t, float) { return gums_paint(t); }, nullptr},
            {Material::kTongue, 256, [](const Texel& t, float) { return tongue_paint(t); }, tongue_height},
            {Material::kMouth, 256, [](const Texel& t, float) { return lining_paint(t); }, nullptr},
            {Material::kLash, 512, [](const Texel& t, float) { return lash_paint(t); }, nullptr},
            {Material::kCloth, 256, cloth, nullptr}};
}

bool has(const Face& face, Material material) {
    return std::ranges::any_of(
        face.parts, [&](const FacePart& p) { return p.material == material && !p.triangles.empty(); });
}

}  // namespace

void bake_surfaces(Face& face, const Face& canvas, const Landmarks& landmarks, const Looks& looks) {
    constexpr std::size_t kLeftEye = 42;
    const SkinPaint skin(canvas, landmarks, looks);
    EyeLids lids;
    for (std::size_t k = 0; k < lids.size(); ++k) lids[k] = landmarks[kLeftEye + k].cast<float>();
    for (const auto& [material, side, paint, height] : recipes(canvas, skin, lids, looks)) {
        if (!has(face, material)) continue;
        Surface& surface = face.surfaces[static_cast<std::size_t>(material)];
        const TexelGrid grid = lay_out(canvas, material, side);
        const std::vector<float> open =
            lit_from_outside(material)
                ? openness(face, casters(face, material), lay_out(face, material, side))
                : std::vector<float>(grid.texels.size(), 1.0f);
        paint_surface(surface, grid, open, paint, material == Material::kLash);
        if (height) surface.normal = normal_texture(grid, height);
    }
}

}  // namespace viaface

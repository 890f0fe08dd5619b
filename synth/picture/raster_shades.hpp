// The fragment shaders of shaders.cpp, eight fragments at a time; sources and departures in shading.hpp. For
// raster_kernel.cpp alone.
#pragma once

#include "synth/picture/raster_scene.hpp"
#include "synth/picture/raster_wide.hpp"

namespace viaface::raster::VIAFACE_KERNEL {
namespace {

struct Lit {
    Three normal, tangent, to_camera;  // to_camera is unit
    Wide side, light;
    Three base;  // sRGB
    Wide cover;  // occlusion, or the lashes' cover
    Wide slope_x, slope_y, roughness, thinness;
};

struct Lights {
    Three key = three(-0.492f, 0.555f, 0.671f), fill = three(0.768f, 0.144f, 0.624f),
          rim = three(0.640f, 0.427f, -0.640f);
    Three key_light = three(1.75f, 1.58f, 1.40f), fill_light = three(0.26f, 0.30f, 0.37f),
          rim_light = three(1.0f, 1.05f, 1.2f);
};

VIAFACE_INLINE Wide linear(Wide c) { return c * (c * (c * 0.305306011f + 0.682171111f) + 0.012522878f); }
VIAFACE_INLINE Three linear(const Three& c) { return {linear(c.x), linear(c.y), linear(c.z)}; }

VIAFACE_INLINE Three sky(Wide up) {
    const Wide share = up * 0.5f + 0.5f;
    return {share * (0.30f - 0.098f) + 0.098f, share * (0.32f - 0.080f) + 0.080f,
            share * (0.37f - 0.075f) + 0.075f};
}

// A lobe's height as a fraction, so that several cost one division.
struct Lobe {
    Wide over, under;
};
VIAFACE_INLINE Lobe lobe(Wide nh, Wide a) {
    const Wide a2 = a * a, d = nh * nh * (a2 - 1.0f) + 1.0f;
    return {a2, 3.14159f * d * d};
}

VIAFACE_INLINE Wide fresnel(Wide vh) {
    const Wide x = 1.0f - vh, y = x * x;
    return 0.028f + 0.972f * y * y * x;
}

VIAFACE_INLINE Wide filmic(Wide c) {
    c = positive(c - 0.004f);
    return (c * (6.2f * c + 0.5f)) / (c * (6.2f * c + 1.7f) + 0.06f);
}

VIAFACE_INLINE Three bumped(const Lit& f, const Three& smooth) {
    const Wide x = f.slope_x * (255.0f / 127.0f) - 128.0f / 127.0f,
               y = f.slope_y * (255.0f / 127.0f) - 128.0f / 127.0f;
    return unit(smooth + f.tangent * x + cross(f.normal, f.tangent) * (f.side * y));
}

// Diffuse light wrapped round by `wrap` of each channel.
VIAFACE_INLINE Three wrapped(const Three& at, float red, float green, float blue) {
    return positive(Three{(at.x + red) * (1 / (1 + red)), (at.y + green) * (1 / (1 + green)),
                          (at.z + blue) * (1 / (1 + blue))});
}
VIAFACE_INLINE Three wrapped(Wide at, float red, float green, float blue) {
    return wrapped(Three{at, at, at}, red, green, blue);
}

VIAFACE_INLINE Three shade_skin(const Lit& f) {
    const Lights lights;
    const Three albedo = linear(f.base), smooth = unit(f.normal), n = bumped(f, smooth);
    const Wide occlusion = f.cover * f.light;
    const Wide n_key = dot(n, lights.key), smooth_key = dot(smooth, lights.key);
    const Three at_key = wrapped(mix(Three{n_key, n_key, n_key}, Three{smooth_key, smooth_key, smooth_key},
                                     three(0.75f, 0.42f, 0.25f)),
                                 0.27f, 0.15f, 0.09f);
    const Three at_fill = wrapped(dot(n, lights.fill), 0.27f, 0.15f, 0.09f);
    const Three at_rim = wrapped(dot(n, lights.rim), 1.6f * 0.27f, 1.6f * 0.15f, 1.6f * 0.09f);
    const Three open = three(0.22f, 0.02f, -0.06f) * (occlusion * (1.0f - occlusion)) + occlusion;
    const Three light = lights.key_light * at_key * f.light +
                        (lights.fill_light * at_fill + lights.rim_light * at_rim * wide(0.75f) +
                         sky(smooth.y) * wide(1.25f)) *
                            open +
                        three(0.10f, 0.025f, 0.01f) * f.thinness;
    const Three h = unit(lights.key + f.to_camera);
    const Wide nh = positive(dot(n, h)), vh = dot(f.to_camera, h), nl = positive(n_key);
    const Wide a = f.roughness * f.roughness;
    const Lobe broad = lobe(nh, a), narrow = lobe(nh, a * 0.4f);
    const Wide lobes = 0.75f * broad.over * narrow.under + 0.25f * narrow.over * broad.under;
    const Wide oil = lobes * fresnel(vh) * nl / (broad.under * narrow.under * (4.0f * vh * vh + 0.1f));
    const Wide grazing = 1.0f - positive(dot(n, f.to_camera)), g2 = grazing * grazing;
    const Three gloss = (lights.key_light * oil + sky(n.y) * (0.02f + 0.22f * g2 * g2 * grazing)) * occlusion;
    return albedo * light * wide(0.40f) + gloss;
}

VIAFACE_INLINE Three shade_inside(const Lit& f) {
    const Lights lights;
    const Three albedo = linear(f.base), n = unit(f.normal);
    const Wide at_key = positive((dot(n, lights.key) + 0.4f) * (1 / 1.4f));
    const Wide open = f.cover * (0.16f + 0.84f * f.light);
    const Three light = lights.key_light * (at_key * 0.75f) +
                        lights.fill_light * positive(dot(n, lights.fill) + 0.3f) + sky(n.y) * wide(2.4f);
    const Three h = unit(lights.key + f.to_camera);
    const Wide vh = dot(f.to_camera, h), nl = positive(dot(n, lights.key));
    const Lobe film = lobe(positive(dot(n, h)), f.roughness * f.roughness);
    const Wide wet = film.over * fresnel(vh) * nl / (film.under * (4.0f * vh * vh + 0.1f));
    const Three deep = three(0.25f, 0.02f, 0.02f) * (open * (1.0f - open)) + open;
    return albedo * light * deep * wide(0.42f) + lights.key_light * (wet * open * open * 0.9f);
}

VIAFACE_INLINE Three shade_eye(const Lit& f) {
    const Lights lights;
    const Three albedo = linear(f.base), ball = unit(f.normal), n = bumped(f, ball);
    const Wide at_key = positive((dot(ball, lights.key) + 0.25f) * (1 / 1.25f));
    const Three light = lights.key_light * at_key +
                        lights.fill_light * positive(dot(ball, lights.fill) + 0.2f) +
                        sky(ball.y) * wide(2.6f);
    const Three h = unit(lights.key + f.to_camera);
    const Wide reflected_y = 2.0f * dot(n, f.to_camera) * n.y - f.to_camera.y;
    const Lobe glint = lobe(positive(dot(n, h)), wide(0.012f));
    const Wide spot = lesser(glint.over * 0.03f / glint.under, wide(2.0f));
    return (albedo * light * wide(0.32f) + lights.key_light * spot + sky(reflected_y) * wide(0.10f)) *
           f.cover;
}

VIAFACE_INLINE Three shade_cloth(const Lit& f) {
    const Lights lights;
    const Three albedo = linear(f.base), n = unit(f.normal);
    const Three light = lights.key_light * (positive(dot(n, lights.key)) * f.cover) +
                        lights.fill_light * positive(dot(n, lights.fill)) + sky(n.y) * (f.cover * 2.2f);
    const Wide edge = 1.0f - positive(dot(n, f.to_camera));
    return albedo * light * (0.9f + 0.8f * edge * edge) +
           lights.rim_light * (positive(dot(n, lights.rim)) * 0.02f);
}

VIAFACE_INLINE Three shade_lash(const Lit& f) {
    const Lights lights;
    return linear(f.base) * (lights.key_light * wide(0.1f) + wide(0.3f));
}

template <Shade shade>
VIAFACE_INLINE Three shaded(const Lit& f) {
    if constexpr (shade == Shade::kSkin) return shade_skin(f);
    if constexpr (shade == Shade::kInside) return shade_inside(f);
    if constexpr (shade == Shade::kEye) return shade_eye(f);
    if constexpr (shade == Shade::kCloth) return shade_cloth(f);
    return shade_lash(f);
}

// 0 to 255.
VIAFACE_INLINE WideInt byte(Wide c) {
    return __builtin_convertvector(lesser(positive(c), wide(1.0f)) * 255.0f + 0.5f, WideInt);
}

}  // namespace
}  // namespace viaface::raster::VIAFACE_KERNEL

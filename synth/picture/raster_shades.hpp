// The fragment shaders of shaders.cpp, kLanes fragments at a time; sources and departures in shading.hpp. For
// raster_kernel.cpp alone.
#pragma once

#include "synth/picture/lights.hpp"
#include "synth/picture/raster_fragments.hpp"
#include "synth/picture/raster_threes.hpp"
#include "synth/picture/raster_wide.hpp"

namespace viaface::raster::VIAFACE_KERNEL {
namespace {

struct Lights {
    Three key = three(lights::kKeyWay), fill = three(lights::kFillWay), rim = three(lights::kRimWay);
    Three key_light = three(lights::kKey), fill_light = three(lights::kFill), rim_light = three(lights::kRim);
};

VIAFACE_INLINE Wide linear(Wide c) { return c * (c * (c * 0.305306011f + 0.682171111f) + 0.012522878f); }
VIAFACE_INLINE Three linear(const Three& c) { return {linear(c.x), linear(c.y), linear(c.z)}; }

VIAFACE_INLINE Three sky(Wide up) {
    const Three ground = three(lights::kGround);
    return ground + (three(lights::kSky) - ground) * (up * 0.5f + 0.5f);
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

// Light that is partly kept off comes back redder, after a way through flesh.
VIAFACE_INLINE Three reddened(Wide open, float red, float green, float blue) {
    return three(red, green, blue) * (open * (1.0f - open)) + open;
}

// A wet film's or an oily skin's answer to the key light, without the light.
VIAFACE_INLINE Wide glossed(Lobe lobes, Wide vh, Wide nl) {
    return lobes.over * fresnel(vh) * nl / (lobes.under * (4.0f * vh * vh + 0.1f));
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
    const Three open = reddened(occlusion, 0.18f, 0.02f, -0.05f);
    const Three at_window = reddened(f.key, 0.20f, 0.02f, -0.04f) * f.light;
    const Three light = lights.key_light * at_key * at_window +
                        (lights.fill_light * at_fill + lights.rim_light * at_rim * wide(0.75f) +
                         sky(smooth.y) * wide(1.25f)) *
                            open +
                        three(0.10f, 0.025f, 0.01f) * f.thinness;
    const Three h = unit(lights.key + f.to_camera);
    const Wide nh = positive(dot(n, h)), vh = dot(f.to_camera, h), nl = positive(n_key);
    const Wide a = f.roughness * f.roughness;
    const Lobe broad = lobe(nh, a), narrow = lobe(nh, a * 0.4f);
    const Lobe both{0.75f * broad.over * narrow.under + 0.25f * narrow.over * broad.under,
                    broad.under * narrow.under};
    const Wide grazing = 1.0f - positive(dot(n, f.to_camera)), g2 = grazing * grazing;
    const Three gloss = (lights.key_light * (glossed(both, vh, nl) * f.key * 1.1f) +
                         sky(n.y) * (0.02f + 0.22f * g2 * g2 * grazing)) *
                        occlusion;
    return albedo * light * wide(0.43f) + gloss;
}

VIAFACE_INLINE Three shade_inside(const Lit& f) {
    const Lights lights;
    const Three albedo = linear(f.base), n = unit(f.normal), film_n = bumped(f, n);
    const Wide open = f.cover * (0.16f + 0.84f * f.light);
    const Three light = lights.key_light * (positive((dot(n, lights.key) + 0.4f) * (1 / 1.4f)) * 0.75f) +
                        lights.fill_light * positive(dot(n, lights.fill) + 0.3f) + sky(n.y) * wide(2.4f);
    const Three h = unit(lights.key + f.to_camera);
    const Lobe film = lobe(positive(dot(film_n, h)), f.roughness * f.roughness);
    const Wide wet = glossed(film, dot(f.to_camera, h), positive(dot(film_n, lights.key)));
    return albedo * light * reddened(open, 0.25f, 0.02f, 0.02f) * wide(0.42f) +
           lights.key_light * (wet * open * open * 0.9f);
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
    const Lobe glint = lobe(positive(dot(n, h)), wide(0.018f));
    const Wide spot = lesser(glint.over * 0.05f / glint.under, wide(2.0f));
    return (albedo * light * wide(0.32f) + lights.key_light * spot + sky(reflected_y) * wide(0.10f)) *
           f.cover;
}

VIAFACE_INLINE Three shade_cloth(const Lit& f) {
    const Lights lights;
    const Three albedo = linear(f.base), n = unit(f.normal);
    const Three light = lights.key_light * (positive(dot(n, lights.key)) * f.cover * f.key) +
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

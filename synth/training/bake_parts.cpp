#include <algorithm>
#include <cmath>

#include "synth/training/bake_paint.hpp"

namespace viaface {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float kIris = 5.7f, kPupil = 2.0f;  // mm, radii

Vector3f iris(const Vector2f& from_middle, float share, const Looks& looks) {
    const float angle = std::atan2(from_middle.y(), from_middle.x()), c = std::cos(angle),
                s = std::sin(angle);
    const float fibres = 0.75f * fractal(Vector3f(c * 7, s * 7, share * 1.6f)) +
                         0.45f * noise(Vector3f(c * 20, s * 20, share * 2));
    const Vector3f inner = linear_from(looks.iris_inner), outer = linear_from(looks.iris_outer);
    return mix(inner, outer, smooth_step(0.38f, 0.75f, share)) * (0.30f + 1.05f * fibres);
}

Vector3f white_of_eye(const Vector3f& place, float out) {
    const float vein = smooth_step(0.60f, 0.72f, fractal(place.cwiseProduct(Vector3f(0.2f, 0.5f, 0.3f)), 5));
    Vector3f colour = linear_from_srgb(208, 198, 192) * (0.94f + 0.08f * noise(place * 0.3f));
    colour = colour.cwiseProduct(
        mix(Vector3f::Ones(), Vector3f(0.97f, 0.78f, 0.76f), vein * smooth_step(7, 13, out)));
    return colour.cwiseProduct(
        mix(Vector3f::Ones(), Vector3f(0.94f, 0.70f, 0.66f), smooth_step(9.5f, 14, out)));
}

// The height at x of the cubic through four places, x between the first and the last of them.
float height_through(const Vector3f& a, const Vector3f& b, const Vector3f& c, const Vector3f& d, float x) {
    const Vector3f* places[] = {&a, &b, &c, &d};
    const float at = std::clamp(x, std::min(a.x(), d.x()), std::max(a.x(), d.x()));
    float height = 0;
    for (int i = 0; i < 4; ++i) {
        float weight = places[i]->y();
        for (int k = 0; k < 4; ++k) {
            if (k != i) weight *= (at - places[k]->x()) / (places[i]->x() - places[k]->x());
        }
        height += weight;
    }
    return height;
}

struct Hair {
    float root, lean, reach, width;
};
Hair hair(int index, int count) {
    const float spread = 0.5f * (lattice(index, 1, 0) - 0.5f);
    const float root = (index + 0.5f + spread) / count;
    const float clump = 0.03f * (lattice(index / 3, 5, 0) - 0.5f);  // neighbours lean together
    return {root, 0.12f * (root - 0.42f) + clump + 0.012f * (lattice(index, 2, 0) - 0.5f),
            0.55f + 0.45f * lattice(index, 3, 0), 0.0060f + 0.0018f * lattice(index, 4, 0)};
}

}  // namespace

Vector3f linear_from_srgb(float red, float green, float blue) {
    const auto linear = [](float c) {
        c /= 255;
        return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
    };
    return {linear(red), linear(green), linear(blue)};
}

Paint eye_paint(const Texel& texel, const Vector3f& apex, const EyeLids& lids, const Looks& looks) {
    const Vector3f& p = texel.place;
    const Vector2f q = (p - apex).head<2>();
    const float out = q.norm(), share = out / kIris;
    Vector3f colour = iris(q, share, looks) * (1 - 0.92f * smooth_step(0.76f, 0.98f, share));
    colour *= mix(0.015f, 1.0f, smooth_step(kPupil - 0.25f, kPupil + 0.35f, out));
    const float along = (p.x() - lids[0].x()) / (lids[3].x() - lids[0].x());  // 0 inner to 1 outer corner
    const float corners = std::max(smooth_step(0.34f, 0.04f, along), smooth_step(0.74f, 1.0f, along));
    Vector3f white =
        white_of_eye(p, out).cwiseProduct(mix(Vector3f::Ones(), Vector3f(0.80f, 0.64f, 0.60f), corners));
    white = mix(white, linear_from_srgb(188, 112, 104), 0.4f * smooth_step(5.6f, 3.2f, (p - lids[0]).norm()));
    colour = mix(colour, white, smooth_step(kIris - 0.45f, kIris + 0.65f, out));
    const float below_upper = height_through(lids[0], lids[1], lids[2], lids[3], p.x()) - p.y(),
                above_lower = p.y() - height_through(lids[0], lids[5], lids[4], lids[3], p.x());
    Paint paint{colour, 0.12f};
    // What lids hide at rest turns into sight with the gaze: shaded, not black.
    paint.open = mix(0.32f, 1.0f, smooth_step(-0.6f, 4.8f, below_upper)) *
                 mix(0.70f, 1.0f, smooth_step(-0.8f, 2.0f, above_lower)) * mix(1.0f, 0.75f, corners);
    return paint;
}

Paint teeth_paint(const Texel& texel) {
    constexpr int kCrowns = 14;
    const Vector3f& p = texel.place;
    const Vector3f crown = linear_from_srgb(228, 218, 198), neck = linear_from_srgb(210, 186, 148);
    const float strip = texel.u * kCrowns, aside = std::abs(strip - std::floor(strip) - 0.5f) / 0.36f;
    const float incisors = smooth_step(-16, -9, p.z());  // whose edges are thin enough to let light through
    const float edge =
        (0.8f * smooth_step(0.84f, 0.99f, texel.v) + 0.2f * smooth_step(0.7f, 1.0f, aside)) * incisors;
    Vector3f colour = mix(neck, crown, smooth_step(0.05f, 0.5f, texel.v)) * (0.96f + 0.06f * noise(p * 0.5f));
    colour = mix(colour, linear_from_srgb(196, 196, 192), 0.5f * clamp01(edge));
    Paint paint{colour, 0.24f};
    paint.open = mix(0.55f, 1.0f, smooth_step(0.0f, 0.3f, texel.v)) *
                 mix(1.0f, 0.42f, smooth_step(-11, -36, p.z())) *
                 mix(1.0f, 0.75f, smooth_step(0.88f, 1.0f, aside));
    return paint;
}

Paint gums_paint(const Texel& texel) {
    const Vector3f& p = texel.place;
    const Vector3f colour = linear_from_srgb(192, 104, 100) * (0.82f + 0.3f * fractal(p * 0.25f));
    return {colour, 0.30f, 0, 1, mix(1.0f, 0.5f, smooth_step(-14, -45, p.z()))};
}

Paint tongue_paint(const Texel& texel) {
    const Vector3f& p = texel.place;
    const Vector3f edge = linear_from_srgb(206, 112, 108), top = linear_from_srgb(212, 134, 126);
    const float patchy = 0.6f + 0.8f * fractal(p * 0.22f);
    const float coat = smooth_step(17, 3, std::abs(p.x())) * smooth_step(-12, -40, p.z()) * patchy;
    const float buds = smooth_step(0.55f, 0.8f, noise(p * 1.3f));
    Vector3f colour =
        mix(edge, top, 0.75f * clamp01(coat)) * (0.84f + 0.24f * fractal(p * 0.5f) + 0.10f * buds);
    colour *= 1 - 0.10f * smooth_step(2.6f, 0.2f, std::abs(p.x() + noise(p * 0.2f) - 0.5f)) *
                      smooth_step(-14, -30, p.z());
    return {colour, 0.30f};
}

Paint lining_paint(const Texel& texel) {
    const Vector3f& p = texel.place;
    const Vector3f colour = linear_from_srgb(158, 88, 84) * (0.82f + 0.3f * fractal(p * 0.2f));
    const float beside = smooth_step(15, 24, std::abs(p.x())), behind = smooth_step(2, -14, p.z());
    return {colour, 0.34f, 0, 1,
            mix(1.0f, 0.30f, beside * behind) * mix(1.0f, 0.5f, smooth_step(-14, -60, p.z()))};
}

Paint lash_paint(const Texel& texel) {
    constexpr int kHairs = 72;
    constexpr float kEdge = 0.0016f;  // of u: half a texel's softness
    const float ends = smooth_step(0, 0.12f, texel.u) * smooth_step(1, 0.86f, texel.u);
    const float rooted = smooth_step(0, 0.3f, texel.u) * smooth_step(1, 0.8f, texel.u);
    float cover = 0.6f * rooted * smooth_step(0.16f, 0.02f, texel.v);  // roots close together
    for (int i = 0; i < kHairs; ++i) {
        const auto [root, lean, reach, width] = hair(i, kHairs);
        if (texel.v > reach) continue;
        const float half = width * std::pow(1 - texel.v / reach, 0.75f);
        const float off = std::abs(texel.u - root - lean * texel.v * (0.6f + 0.4f * texel.v));
        cover = std::max(cover, smooth_step(half + kEdge, half - kEdge, off));
    }
    return {linear_from_srgb(24, 17, 14), 0.6f, 0, cover * ends};
}

Paint cloth_paint(const Vector3f& place, const Srgb& colour) {
    const float weave = noise(place.cwiseProduct(Vector3f(1.3f, 2.0f, 1.3f)));
    return {linear_from(colour) * (0.8f + 0.25f * weave + 0.15f * fractal(place * 0.05f)), 0.95f};
}

float tongue_height(const Vector3f& place) {
    return 0.35f * noise(place * 0.7f) + 0.22f * noise(place * 1.5f);
}

}  // namespace viaface

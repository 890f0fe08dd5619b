#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "synth/training/bake_paint.hpp"
#include "synth/training/collar.hpp"
#include "synth/training/hairline.hpp"

namespace viaface {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

struct NearSegment {
    float distance, along;
};
NearSegment to_segment(const Vector3f& p, const Vector3f& a, const Vector3f& b) {
    const Vector3f way = b - a;
    const float t = clamp01((p - a).dot(way) / way.squaredNorm());
    return {(p - a - t * way).norm(), t};
}

Vector3f tinted(const Vector3f& colour, const Vector3f& tint, float share) {
    return colour.cwiseProduct(mix(Vector3f::Ones(), tint, clamp01(share)));
}

}  // namespace

SkinPaint::SkinPaint(const Face& canvas, const Landmarks& landmarks, const Looks& looks)
    : looks_(looks), creases_(landmarks, looks.complexion.age) {
    for (std::size_t i = 0; i < marks_.size(); ++i) marks_[i] = landmarks[i].cast<float>();
    for (int c = 0; c < LipGrid::kColumns; ++c) {
        border_[c] = canvas.rest.row(canvas.lips.node(0, c)).transpose().cast<float>();
    }
}

float SkinPaint::lip_depth(const Vector3f& p) const {
    float nearest = 1e9f;
    bool inside = false;
    for (int c = 0; c < LipGrid::kColumns; ++c) {
        const Vector3f &a = border_[c], &b = border_[(c + 1) % LipGrid::kColumns];
        nearest = std::min(nearest, to_segment(p, a, b).distance);
        if ((a.y() > p.y()) == (b.y() > p.y())) continue;
        if (p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y())) inside = !inside;
    }
    return inside && nearest < 25 ? nearest : -nearest;
}

float SkinPaint::lid_distance(const Vector3f& p) const {
    float nearest = 1e9f;
    for (int eye = 36; eye <= 42; eye += 6) {
        for (int k = 0; k < 6; ++k) {
            nearest = std::min(nearest, to_segment(p, marks_[eye + k], marks_[eye + (k + 1) % 6]).distance);
        }
    }
    return nearest;
}

// The roots of the upper lashes, seen as one line.
float SkinPaint::upper_lash_line(const Vector3f& p) const {
    float nearest = 1e9f;
    for (const int first : {36, 42}) {
        for (int k = 0; k < 3; ++k)
            nearest = std::min(nearest, to_segment(p, marks_[first + k], marks_[first + k + 1]).distance);
    }
    return smooth_step(1.5f, 0.4f, nearest);
}

SkinPaint::Brow SkinPaint::brow(const Vector3f& p) const {
    Brow found{0, 0, 1e9f};
    for (int side = 0; side < 2; ++side) {
        for (int k = 0; k < 4; ++k) {
            const Vector3f& inner = marks_[side ? 22 + k : 21 - k];
            const Vector3f& outer = marks_[side ? 23 + k : 20 - k];
            const auto [distance, on] = to_segment(p, inner, outer);
            if (distance >= found.out) continue;
            const float t =
                k > 0 ? on : std::min(on, (p - inner).dot(outer - inner) / (outer - inner).squaredNorm());
            const Vector3f way = (outer - inner).normalized();
            const Vector3f up = (Vector3f::UnitY() - way * way.y()).normalized();
            found = {(k + t) / 4, (p - inner - t * (outer - inner)).dot(up), distance};
        }
    }
    return found;
}

float SkinPaint::near(int landmark, const Vector3f& offset, const Vector3f& p, float radius) const {
    return std::exp(-(p - marks_[landmark] - offset).squaredNorm() / (radius * radius));
}

Vector3f SkinPaint::complexion(const Vector3f& p) const {
    const float broad = fractal(p * 0.055f), fine = fractal(p * 0.27f + Vector3f::Constant(3)),
                grain = noise(p * 1.1f);
    const Complexion& own = looks_.complexion;
    Vector3f colour = linear_from(own.skin) * (0.87f + 0.15f * broad + 0.13f * fine);
    colour = tinted(colour, {1.04f, 0.89f, 0.86f}, smooth_step(0.45f, 0.75f, fine) * 0.8f) *
             (0.96f + 0.07f * grain);
    const float cheeks = near(54, {21, 35, -19}, p, 24) + near(48, {-21, 35, -19}, p, 24);
    const float nose = near(30, {0, -1, -4}, p, 14),
                wings = near(35, {3, 5, 2}, p, 9) + near(31, {-3, 5, 2}, p, 9);
    const float ears =
        smooth_step(74, 84, std::abs(p.x())) * smooth_step(100, 90, p.y()) * smooth_step(-10, 10, p.y());
    const float red =
        0.45f * cheeks + 0.55f * nose + 0.5f * wings + 0.6f * ears + 0.25f * near(8, {0, 12, 2}, p, 15);
    colour = tinted(colour, {1.04f, 0.80f, 0.77f}, own.redness * red);
    const float brow_height = marks_[24].y();
    const float forehead =
        smooth_step(brow_height + 3, brow_height + 33, p.y()) * smooth_step(-66, -26, p.z());
    colour = tinted(colour, {1.02f, 1.0f, 0.93f}, 0.6f * forehead);
    const float below_eyes = near(46, {-4, -9, 2}, p, 10) + near(41, {4, -9, 2}, p, 10);
    colour = tinted(colour, {0.90f, 0.82f, 0.84f}, 0.6f * below_eyes);
    const float above_eyes = near(43, {3, 6, 0}, p, 9) + near(38, {-3, 6, 0}, p, 9);
    colour = tinted(colour, {0.95f, 0.85f, 0.83f}, 0.6f * above_eyes);
    const float lid = lid_distance(p);
    colour = tinted(colour, {0.88f, 0.64f, 0.60f}, (1 - smooth_step(0.3f, 3.0f, lid)) * 0.7f * own.redness);
    const float freckle = smooth_step(0.80f, 0.92f, noise(p * 0.65f + Vector3f::Constant(11))) *
                          smooth_step(0.5f, 0.7f, noise(p * 0.13f)) * (0.3f + 0.6f * clamp01(cheeks + nose));
    colour = tinted(colour, {0.86f, 0.78f, 0.74f}, own.freckles * freckle);
    const float spot = smooth_step(0.80f, 0.90f, noise(p * 0.19f + Vector3f::Constant(5))) *
                       smooth_step(0.50f, 0.70f, noise(p * 0.05f + Vector3f::Constant(9)));
    colour = tinted(colour, {0.80f, 0.68f, 0.60f}, own.age * (0.35f * spot + 0.5f * below_eyes));
    return tinted(colour, {0.74f, 0.56f, 0.53f}, creases_.at(p));
}

Vector3f SkinPaint::hair_colour(const Vector3f& strand, float share) const {
    const float white = smooth_step(0.1f, 0.9f, noise(strand.cwiseProduct(Vector3f(1.7f, 0.8f, 1.7f))));
    return mix(linear_from(looks_.hair.colour), linear_from_srgb(206, 202, 196),
               share * looks_.hair.grey * white);
}

float SkinPaint::brow_cover(const Vector3f& p) const {
    const auto [t, above, out] = brow(p);
    if (out > 9) return 0;
    const float inner = smooth_step(-0.10f, 0.24f, t + 0.05f * (noise(p * 0.7f) - 0.5f));
    const float half = mix(looks_.brows.half_width, 1.5f, smooth_step(0.35f, 1, t)) * (0.75f + 0.25f * inner);
    const float middle =
        above - looks_.brows.rise + 0.6f + 1.1f * (noise(Vector3f(t * 36, above * 0.9f, 1)) - 0.5f);
    const float dense = 1 - smooth_step(half * 0.2f, half * 1.2f, std::abs(middle));
    const float lean =
        mix(0.25f, 1.9f, smooth_step(0, 0.5f, t));  // strands rise at the nose and lie down outwards
    const float strand = noise(Vector3f((t * 44 - above * lean) * 1.25f, above * 0.35f, 5));
    const float hairs = smooth_step(0.15f, 0.65f, strand + 0.2f * noise(Vector3f(t * 150, above * 2.2f, 2)));
    const float past_end = t > 0.5f ? std::sqrt(std::max(0.0f, out * out - above * above)) : 0;
    const float ground = mix(0.62f, 0.42f, inner);  // thin hair at the nose shows no single strands
    return dense * inner * (ground + (1 - ground) * hairs) * smooth_step(2.2f, 0.2f, past_end) *
           (1 - 0.6f * smooth_step(0.85f, 1, t));
}

float SkinPaint::stubble(const Vector3f& p) const {
    const float ax = std::abs(p.x());
    const float rise = 0.35f * std::max(0.0f, ax - 26);
    float beard =
        smooth_step(22, 8, p.y() - rise) * smooth_step(-76, -50, p.z()) * smooth_step(-80, -45, p.y());
    const float side = smooth_step(60, 68, ax) * smooth_step(70, 55, p.y()) * smooth_step(-80, -68, p.z()) *
                       smooth_step(-8, 15, p.y());
    beard = std::max(beard, 0.7f * side);
    return beard * (1 - 0.5f * near(51, {0, 4, 0}, p, 5));
}

float SkinPaint::nostril(const Vector3f& p, float open) const {
    float inside = 0;
    for (const int side : {-1, 1}) {
        const Vector3f middle = (marks_[33 + side] + marks_[33 + 2 * side]) / 2 + Vector3f(0, 4, -5);
        inside = std::max(inside, smooth_step(11.5f, 8, (p - middle).norm()));
    }
    const float off_columella = smooth_step(3.2f, 5.2f, std::abs(p.x() - marks_[33].x()));
    return inside * off_columella * smooth_step(0.60f, 0.30f, open);
}

Paint SkinPaint::at(const Texel& texel, float open) const {
    const Vector3f& p = texel.place;
    constexpr float kHem = 1.1f;  // mm to either side of the collar's edge, about a texel there
    const float cloth = smooth_step(kHem, -kHem, above_collar(p));
    if (cloth == 1) return cloth_paint(p, looks_.cloth);
    const float into_lips = lip_depth(p),
                lips = smooth_step(-1.2f, 1.1f, into_lips + 0.8f * (noise(p * 0.9f) - 0.5f));
    const Vector3f bare = complexion(p);
    const Complexion& own = looks_.complexion;
    const HairStyle& style = looks_.hair;
    const float beard = own.beard * stubble(p) * (1 - lips) * smooth_step(0, -4, into_lips);
    const float points = smooth_step(0.40f, 0.85f, noise(p.cwiseProduct(Vector3f(1.9f, 1.5f, 1.9f))));
    Vector3f colour = tinted(bare, own.shaven, beard * 0.36f * (0.55f + 0.7f * points));
    const Vector3f red =
        bare.cwiseProduct(own.lips) * (0.88f + 0.26f * fractal(p.cwiseProduct(Vector3f(0.9f, 0.25f, 0.4f))));
    colour = mix(colour, red, 0.85f * lips);
    const Vector3f q = strand_place(style, p);
    const float behind = hair_depth(style, p), tips = noise(q.cwiseProduct(Vector3f(1.5f, 1.0f, 1.5f)));
    const float tuft = noise(q.cwiseProduct(Vector3f(0.62f, 0.30f, 0.42f)));
    const float stipple = smooth_step(0.2f, 0.7f, noise(q * 1.7f) * 0.6f + 0.4f * tips);
    const float hair = smooth_step(style.fade_from, style.fade_to, behind) *
                       mix(style.cover + (1 - style.cover) * stipple, 1, smooth_step(6, 30, behind));
    const Vector3f hair_colour = this->hair_colour(q, 1),
                   brow_colour = this->hair_colour(p, looks_.brows.grey);
    const float strands = (0.25f + 1.3f * tips * stipple) * (0.6f + 0.8f * tuft);
    colour = mix(colour, hair_colour * (0.35f + strands), 0.94f * hair);
    colour = mix(colour, brow_colour * 0.85f, looks_.brows.cover * clamp01(brow_cover(p)));
    colour = mix(colour, linear_from_srgb(46, 33, 25) * 0.6f, looks_.lash_line * upper_lash_line(p));
    const float dark = nostril(p, open);
    colour = mix(colour, linear_from_srgb(58, 24, 18), 0.9f * dark);
    const float shine = near(30, {0, 0, 0}, p, 14);
    const float matt = near(39, {1, -9, 4}, p, 13) + near(42, {-1, -9, 4}, p, 13);
    Paint paint{colour, mix(mix(0.55f, 0.49f, shine), 0.66f, clamp01(matt))};
    paint.roughness = mix(paint.roughness, 0.32f, lips);
    const float corners = clamp01(near(48, {0, 0, 0}, p, 7) + near(54, {0, 0, 0}, p, 7));
    paint.roughness = mix(paint.roughness, 0.6f, corners);
    paint.roughness = mix(paint.roughness, 0.62f, std::max(hair, 0.4f * beard));
    paint.open = (1 - 0.5f * dark) * (1 - 0.3f * hair);
    // Lids are thin and wet: their edges never go black; nor do the columella and the corners of the mouth.
    const auto no_darker = [&](float least) { return std::max(1.0f, least / std::max(open, 0.05f)); };
    if (lid_distance(p) < 3) paint.open *= no_darker(0.6f);
    paint.open *= mix(1, no_darker(0.6f), clamp01(1.5f * near(33, {0, 3, 1}, p, 5)) * (1 - dark));
    paint.open *= mix(1, no_darker(0.55f), corners);
    const float ear =
        smooth_step(76, 86, std::abs(p.x())) * smooth_step(100, 90, p.y()) * smooth_step(0, 20, p.y());
    paint.thinness =
        (1 - dark) * clamp01(0.9f * ear + 0.3f * (near(31, {0, 0, 0}, p, 8) + near(35, {0, 0, 0}, p, 8)));
    if (cloth == 0) return paint;
    const Paint below = cloth_paint(p, looks_.cloth);
    paint.colour = mix(paint.colour, below.colour, cloth);
    paint.roughness = mix(paint.roughness, below.roughness, cloth);
    return paint;
}

float SkinPaint::height(const Vector3f& p) const {
    if (above_collar(p) < 0) return 1.2f * smooth_step(0, -1.5f, above_collar(p)) + 0.04f * noise(p * 1.3f);
    const float lips = smooth_step(-0.5f, 1.5f, lip_depth(p)),
                hair = smooth_step(-3, 10, hair_depth(looks_.hair, p));
    const float pores = 0.11f * noise(p * 0.45f) + 0.055f * noise(p * 0.95f);
    const float creases = 0.32f * noise(p.cwiseProduct(Vector3f(0.95f, 0.16f, 0.25f)));
    const Vector3f q = strand_place(looks_.hair, p);
    return mix(mix(pores - 0.9f * creases_.at(p), creases, lips),
               0.5f * noise(q.cwiseProduct(Vector3f(0.8f, 0.5f, 0.6f))) + 0.35f * noise(q * 1.4f), hair);
}

}  // namespace viaface

#include "synth/picture/shaders.hpp"

#include <charconv>

#include "synth/picture/lights.hpp"

namespace viaface {
namespace {

constexpr const char* kVersion = "#version 330 core\n";

constexpr const char* kVertex = R"(
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 light;
layout(location = 3) in vec2 uv;
layout(location = 4) in vec4 tangent;
uniform mat4 world_from_head, clip_from_world;
uniform vec3 camera;
uniform float nearer;
out vec3 N, T, B, V;
out vec2 st;
out float lit, window;
void main() {
    vec4 world = world_from_head * vec4(place, 1);
    mat3 turn = mat3(world_from_head);
    N = turn * normal;
    vec3 along = normalize(tangent.xyz - normal * dot(normal, tangent.xyz));
    T = turn * along;
    B = turn * cross(normal, along) * tangent.w;
    V = normalize(camera - world.xyz);
    st = vec2(uv.x, 1 - uv.y);
    lit = light.x;
    window = light.y;
    gl_Position = clip_from_world * vec4(world.xyz + nearer * V, 1);
}
)";

constexpr const char* kHead = R"(
in vec3 N, T, B, V;
in vec2 st;
in float lit, window;
out vec4 colour;
uniform sampler2D base_texture, detail_texture;
vec3 linear(vec3 c) { return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878); }
vec3 sky(float up) { return mix(ground_light, sky_light, up * 0.5 + 0.5); }
struct Look {
    vec3 albedo, smooth_n, n;
    float cover, roughness, thinness;
};
Look look() {
    vec4 base = texture(base_texture, st), s = texture(detail_texture, st);
    vec2 bump = s.xy * (255.0 / 127.0) - 128.0 / 127.0;
    vec3 smooth_n = normalize(N);
    return Look(linear(base.rgb), smooth_n, normalize(smooth_n + T * bump.x + B * bump.y), base.a, s.z, s.w);
}
float lobe(float nh, float a) {
    float d = nh * nh * (a * a - 1) + 1;
    return a * a / (3.14159 * d * d);
}
float fresnel(float vh) {
    float x = 1 - vh, y = x * x;
    return 0.028 + 0.972 * y * y * x;
}
float glossed(float lobes, float vh, float nl) { return lobes * fresnel(vh) * nl / (4 * vh * vh + 0.1); }
vec3 reddened(float open, vec3 by) { return open + by * open * (1 - open); }
vec3 filmic(vec3 c) {
    c = max(c - 0.004, 0);
    return (c * (6.2 * c + 0.5)) / (c * (6.2 * c + 1.7) + 0.06);
}
)";

constexpr const char* kSkin = R"(
vec3 shade() {
    Look p = look();
    float occlusion = p.cover * lit;
    const vec3 soft = vec3(0.75, 0.42, 0.25), wrap = vec3(0.27, 0.15, 0.09);
    vec3 at_key = max((mix(vec3(dot(p.n, key)), vec3(dot(p.smooth_n, key)), soft) + wrap) / (1 + wrap), 0);
    vec3 at_fill = max((dot(p.n, fill) + wrap) / (1 + wrap), 0);
    vec3 at_rim = max((dot(p.n, rim) + 1.6 * wrap) / (1 + 1.6 * wrap), 0);
    vec3 open = reddened(occlusion, vec3(0.18, 0.02, -0.05));
    vec3 at_window = reddened(window, vec3(0.20, 0.02, -0.04)) * lit;
    vec3 light = key_light * at_key * at_window +
                 (fill_light * at_fill + rim_light * at_rim * 0.75 + sky(p.smooth_n.y) * 1.25) * open +
                 p.thinness * vec3(0.10, 0.025, 0.01);
    vec3 h = normalize(key + V);
    float nh = max(dot(p.n, h), 0), a = p.roughness * p.roughness;
    float oil = glossed(0.75 * lobe(nh, a) + 0.25 * lobe(nh, a * 0.4), dot(V, h), max(dot(p.n, key), 0));
    float grazing = 1 - max(dot(p.n, V), 0), g2 = grazing * grazing;
    vec3 gloss = (key_light * oil * window * 1.1 + sky(p.n.y) * (0.02 + 0.22 * g2 * g2 * grazing)) * occlusion;
    return p.albedo * light * 0.43 + gloss;
}
)";

constexpr const char* kInside = R"(
vec3 shade() {
    Look p = look();
    vec3 n = p.smooth_n;
    float at_key = max((dot(n, key) + 0.4) / 1.4, 0), open = p.cover * (0.16 + 0.84 * lit);
    vec3 light = key_light * at_key * 0.75 + fill_light * max(dot(n, fill) + 0.3, 0) + sky(n.y) * 2.4;
    vec3 h = normalize(key + V);
    float wet = glossed(lobe(max(dot(p.n, h), 0), p.roughness * p.roughness), dot(V, h), max(dot(p.n, key), 0));
    return p.albedo * light * reddened(open, vec3(0.25, 0.02, 0.02)) * 0.42 +
           key_light * wet * open * open * 0.9;
}
)";

constexpr const char* kEye = R"(
vec3 shade() {
    Look p = look();
    vec3 ball = p.smooth_n;
    float at_key = max((dot(ball, key) + 0.25) / 1.25, 0);
    vec3 light = key_light * at_key + fill_light * max(dot(ball, fill) + 0.2, 0) + sky(ball.y) * 2.6;
    vec3 h = normalize(key + V), r = reflect(-V, p.n);
    float spot = min(lobe(max(dot(p.n, h), 0), 0.018) * 0.05, 2.0);
    return (p.albedo * light * 0.32 + key_light * spot + sky(r.y) * 0.10) * p.cover;
}
)";

constexpr const char* kCloth = R"(
vec3 shade() {
    Look p = look();
    vec3 n = p.smooth_n;
    vec3 light = key_light * max(dot(n, key), 0) * p.cover * window + fill_light * max(dot(n, fill), 0) +
                 sky(n.y) * p.cover * 2.2;
    float edge = 1 - max(dot(n, V), 0);
    return p.albedo * light * (0.9 + 0.8 * edge * edge) + 0.02 * rim_light * max(dot(n, rim), 0);
}
)";

constexpr const char* kLash = R"(
vec3 shade() { return look().albedo * (0.3 + 0.1 * key_light); }
)";

constexpr const char* kTail = R"(
void main() { colour = vec4(filmic(shade()), 1); }
)";

constexpr const char* kLashTail = R"(
void main() { colour = vec4(filmic(shade()), texture(base_texture, st).a); }
)";

std::string constant(const char* name, const float (&v)[3]) {
    std::string line = std::string("const vec3 ") + name + " = vec3(";
    for (int i = 0; i < 3; ++i) {
        char digits[32];
        const auto [end, error] =
            std::to_chars(digits, digits + sizeof digits, v[i], std::chars_format::fixed);
        line += std::string(digits, end) + (i < 2 ? ", " : ");\n");
    }
    return line;
}

std::string lights_text() {
    return constant("key", lights::kKeyWay) + constant("fill", lights::kFillWay) +
           constant("rim", lights::kRimWay) + constant("key_light", lights::kKey) +
           constant("fill_light", lights::kFill) + constant("rim_light", lights::kRim) +
           constant("ground_light", lights::kGround) + constant("sky_light", lights::kSky);
}

const char* body_of(Material material) {
    switch (material) {
        case Material::kSkin:
        case Material::kLips:
            return kSkin;
        case Material::kMouth:
        case Material::kGums:
        case Material::kTeeth:
        case Material::kTongue:
            return kInside;
        case Material::kEye:
            return kEye;
        case Material::kLash:
            return kLash;
        case Material::kCloth:
            return kCloth;
    }
    return kSkin;
}

}  // namespace

std::string vertex_shader() { return std::string(kVersion) + kVertex; }

std::string fragment_shader(Material material) {
    return std::string(kVersion) + lights_text() + kHead + body_of(material) +
           (material == Material::kLash ? kLashTail : kTail);
}

std::string background_vertex_shader() {
    return std::string(kVersion) + R"(
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4 - 1, 0, 1); }
)";
}

std::string background_fragment_shader() {
    return std::string(kVersion) + R"(
uniform sampler2D picture;
out vec4 colour;
void main() { colour = texelFetch(picture, ivec2(gl_FragCoord.xy), 0); }
)";
}

}  // namespace viaface

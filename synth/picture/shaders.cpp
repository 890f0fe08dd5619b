#include "synth/picture/shaders.hpp"

namespace viaface {
namespace {

constexpr const char* kVersion = "#version 330 core\n";

constexpr const char* kVertex = R"(
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in float light;
layout(location = 3) in vec2 uv;
layout(location = 4) in vec4 tangent;
uniform mat4 world_from_head, clip_from_world;
uniform vec3 camera;
uniform float nearer;
out vec3 N, T, B, V;
out vec2 st;
out float lit;
void main() {
    vec4 world = world_from_head * vec4(place, 1);
    mat3 turn = mat3(world_from_head);
    N = turn * normal;
    vec3 along = normalize(tangent.xyz - normal * dot(normal, tangent.xyz));
    T = turn * along;
    B = turn * cross(normal, along) * tangent.w;
    V = normalize(camera - world.xyz);
    st = vec2(uv.x, 1 - uv.y);
    lit = light;
    gl_Position = clip_from_world * vec4(world.xyz + nearer * V, 1);
}
)";

constexpr const char* kHead = R"(
in vec3 N, T, B, V;
in vec2 st;
in float lit;
out vec4 colour;
uniform sampler2D base_texture, detail_texture;
const vec3 key = vec3(-0.492, 0.555, 0.671), fill = vec3(0.768, 0.144, 0.624), rim = vec3(0.640, 0.427, -0.640);
const vec3 key_light = vec3(1.75, 1.58, 1.40), fill_light = vec3(0.26, 0.30, 0.37), rim_light = vec3(1.0, 1.05, 1.2);
vec3 linear(vec3 c) { return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878); }
vec3 sky(float up) { return mix(vec3(0.098, 0.080, 0.075), vec3(0.30, 0.32, 0.37), up * 0.5 + 0.5); }
float lobe(float nh, float a) {
    float d = nh * nh * (a * a - 1) + 1;
    return a * a / (3.14159 * d * d);
}
float fresnel(float vh) {
    float x = 1 - vh, y = x * x;
    return 0.028 + 0.972 * y * y * x;
}
vec3 filmic(vec3 c) {
    c = max(c - 0.004, 0);
    return (c * (6.2 * c + 0.5)) / (c * (6.2 * c + 1.7) + 0.06);
}
)";

constexpr const char* kSkin = R"(
vec3 shade() {
    vec4 base = texture(base_texture, st), s = texture(detail_texture, st);
    vec3 albedo = linear(base.rgb);
    vec2 bump = s.xy * (255.0 / 127.0) - 128.0 / 127.0;
    vec3 smooth_n = normalize(N), n = normalize(smooth_n + T * bump.x + B * bump.y);
    float occlusion = base.a * lit;
    const vec3 soft = vec3(0.75, 0.42, 0.25), wrap = vec3(0.27, 0.15, 0.09);
    vec3 at_key = max((mix(vec3(dot(n, key)), vec3(dot(smooth_n, key)), soft) + wrap) / (1 + wrap), 0);
    vec3 at_fill = max((dot(n, fill) + wrap) / (1 + wrap), 0);
    vec3 at_rim = max((dot(n, rim) + 1.6 * wrap) / (1 + 1.6 * wrap), 0);
    vec3 open = occlusion + vec3(0.22, 0.02, -0.06) * occlusion * (1 - occlusion);
    vec3 light = key_light * at_key * lit + fill_light * at_fill * open +
                 rim_light * at_rim * open * 0.75 + sky(smooth_n.y) * open * 1.25 +
                 s.w * vec3(0.10, 0.025, 0.01);
    vec3 h = normalize(key + V);
    float nh = max(dot(n, h), 0), vh = dot(V, h), nl = max(dot(n, key), 0), a = s.z * s.z;
    float oil = (0.75 * lobe(nh, a) + 0.25 * lobe(nh, a * 0.4)) * fresnel(vh) * nl / (4 * vh * vh + 0.1);
    float grazing = 1 - max(dot(n, V), 0), g2 = grazing * grazing;
    vec3 gloss = key_light * oil * occlusion + sky(n.y) * (0.02 + 0.22 * g2 * g2 * grazing) * occlusion;
    return albedo * light * 0.40 + gloss;
}
)";

constexpr const char* kInside = R"(
vec3 shade() {
    vec4 base = texture(base_texture, st), s = texture(detail_texture, st);
    vec3 albedo = linear(base.rgb);
    vec3 n = normalize(N);
    float at_key = max((dot(n, key) + 0.4) / 1.4, 0), open = base.a * (0.16 + 0.84 * lit);
    vec3 light = key_light * at_key * 0.75 + fill_light * max(dot(n, fill) + 0.3, 0) + sky(n.y) * 2.4;
    vec3 h = normalize(key + V);
    float vh = dot(V, h), nl = max(dot(n, key), 0);
    float wet = lobe(max(dot(n, h), 0), s.z * s.z) * fresnel(vh) * nl / (4 * vh * vh + 0.1);
    vec3 deep = open + vec3(0.25, 0.02, 0.02) * open * (1 - open);
    return albedo * light * deep * 0.42 + key_light * wet * open * open * 0.9;
}
)";

constexpr const char* kEye = R"(
vec3 shade() {
    vec4 base = texture(base_texture, st), s = texture(detail_texture, st);
    vec3 albedo = linear(base.rgb);
    vec2 bump = s.xy * (255.0 / 127.0) - 128.0 / 127.0;
    vec3 ball = normalize(N), n = normalize(ball + T * bump.x + B * bump.y);
    float at_key = max((dot(ball, key) + 0.25) / 1.25, 0);
    vec3 light = key_light * at_key + fill_light * max(dot(ball, fill) + 0.2, 0) + sky(ball.y) * 2.6;
    vec3 h = normalize(key + V), r = reflect(-V, n);
    float spot = min(lobe(max(dot(n, h), 0), 0.012) * 0.03, 2.0);
    vec3 glow = sky(r.y) * 0.10;
    return (albedo * light * 0.32 + key_light * spot + glow) * base.a;
}
)";

constexpr const char* kCloth = R"(
vec3 shade() {
    vec4 base = texture(base_texture, st), s = texture(detail_texture, st);
    vec3 albedo = linear(base.rgb);
    vec3 n = normalize(N);
    vec3 light = key_light * max(dot(n, key), 0) * base.a + fill_light * max(dot(n, fill), 0) + sky(n.y) * base.a * 2.2;
    float edge = 1 - max(dot(n, V), 0);
    return albedo * light * (0.9 + 0.8 * edge * edge) + 0.02 * rim_light * max(dot(n, rim), 0);
}
)";

constexpr const char* kLash = R"(
vec3 shade() {
    vec3 albedo = linear(texture(base_texture, st).rgb);
    return albedo * (0.3 + 0.1 * key_light);
}
)";

constexpr const char* kTail = R"(
void main() { colour = vec4(filmic(shade()), 1); }
)";

constexpr const char* kLashTail = R"(
void main() { colour = vec4(filmic(shade()), texture(base_texture, st).a); }
)";

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
    return std::string(kVersion) + kHead + body_of(material) +
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

#include "facemodel/gltf.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "facemodel/png.hpp"

namespace viaface {
namespace {

using nlohmann::json;

Texture checks(int size, int channels) {
    Texture texture{size, size, channels, {}};
    for (int i = 0; i < size * size * channels; ++i)
        texture.pixels.push_back(static_cast<std::uint8_t>((i * 37) & 0xff));
    return texture;
}

// A skin of four nodes and a flat lip grid; every member filled.
Face small_face() {
    Face face;
    constexpr int kSkinNodes = 4, kLipNodes = LipGrid::kRows * LipGrid::kColumns,
                  kAll = kSkinNodes + kLipNodes;
    face.rest = Nodes::Zero(kAll, 3);
    face.rest.topRows(kSkinNodes) << 0, 0, 0, 10, 0, 0, 10, 10, 0, 0, 10, 0;
    for (int i = 0; i < kLipNodes; ++i) face.rest.row(kSkinNodes + i) << i % 40, i / 40, 0.25 * i;
    face.uvs = decltype(face.uvs)::Constant(kAll, 2, 0.25F);
    for (int i = 0; i < kAll; ++i) face.weld.push_back(i == 4 ? 0 : i);
    face.parts.push_back({"skin", Material::kSkin, Drive::kModes, 0, kSkinNodes, {{0, 1, 2}, {0, 2, 3}}});
    face.parts.push_back({"lips", Material::kLips, Drive::kLips, kSkinNodes, kLipNodes, {{4, 5, 44}}});
    face.mean = Eigen::VectorXd::LinSpaced(3 * kAll, 0, 100);
    face.modes = Eigen::MatrixXd::Zero(3 * kAll, 2);
    face.modes(1, 0) = 1;
    face.modes(5, 1) = -1;
    face.mode_variance = Eigen::Vector2d(9, 4);
    face.shapes = {{"jawOpen", Nodes::Constant(kAll, 3, 1.5)}, {"still", Nodes::Zero(kAll, 3)}};
    face.lips.first_node = kSkinNodes;
    face.jaw_hinge = {0, 30, -70};
    face.surfaces[0] = {checks(4, 3), checks(4, 3), checks(2, 3)};
    face.surfaces[7].base_colour = checks(4, 4);
    return face;
}

json document_of(const Bytes& glb) {
    std::uint32_t length = 0;
    std::memcpy(&length, glb.data() + 12, 4);
    return json::parse(glb.begin() + 20, glb.begin() + 20 + length);
}

TEST(Gltf, ReadsBackWhatWasWritten) {
    const Face face = small_face();
    const Face read = read_glb(write_glb(face, "nobody"));
    constexpr double kFloat = 1e-5;  // a 32-bit float near 100
    EXPECT_TRUE(read.rest.isApprox(face.rest, kFloat));
    EXPECT_TRUE(read.uvs.isApprox(face.uvs));
    EXPECT_EQ(read.weld, face.weld);
    ASSERT_EQ(read.parts.size(), 2u);
    EXPECT_EQ(read.parts[1].name, "lips");
    EXPECT_EQ(read.parts[1].drive, Drive::kLips);
    EXPECT_EQ(read.parts[1].triangles, face.parts[1].triangles);
    EXPECT_TRUE(read.mean.isApprox(face.mean, kFloat));
    EXPECT_TRUE(read.modes.isApprox(face.modes, kFloat));
    EXPECT_TRUE(read.mode_variance.isApprox(face.mode_variance));
    ASSERT_EQ(read.shapes.size(), 2u);
    EXPECT_TRUE(read.shapes[0].delta.isApprox(face.shapes[0].delta));
    EXPECT_TRUE(read.shapes[1].delta.isZero());
    EXPECT_EQ(read.lips.first_node, 4);
    EXPECT_EQ(read.jaw_hinge, face.jaw_hinge);
    EXPECT_EQ(read.surfaces[0].normal.pixels, face.surfaces[0].normal.pixels);
    EXPECT_EQ(read.surfaces[7].base_colour.channels, 4);
    EXPECT_TRUE(read.surfaces[3].base_colour.pixels.empty());
}

TEST(Gltf, WritesTheSameBytesAgainAndAfterReading) {
    const Bytes once = write_glb(small_face(), "nobody");
    EXPECT_EQ(once, write_glb(small_face(), "nobody"));
    EXPECT_EQ(once, write_glb(read_glb(once), "nobody"));
}

// The rules of glTF 2.0 that viewers rely on.
TEST(Gltf, KeepsTheRulesOfTheFormat) {
    const Bytes glb = write_glb(small_face(), "nobody");
    EXPECT_EQ(glb.size() % 4, 0u);
    const json document = document_of(glb);
    EXPECT_EQ(document["asset"]["version"], "2.0");
    const auto& accessors = document["accessors"];
    for (const auto& accessor : accessors) {
        const auto& view = document["bufferViews"][accessor["bufferView"].get<std::size_t>()];
        EXPECT_EQ(view["byteOffset"].get<int>() % 4, 0);
        EXPECT_LE(view["byteOffset"].get<int>() + view["byteLength"].get<int>(),
                  document["buffers"][0]["byteLength"].get<int>());
    }
    for (const auto& mesh : document["meshes"]) {
        const auto& primitive = mesh["primitives"][0];
        const auto& position = accessors[primitive["attributes"]["POSITION"].get<std::size_t>()];
        EXPECT_EQ(position["min"].size(), 3u);
        EXPECT_EQ(position["max"].size(), 3u);
        EXPECT_EQ(accessors[primitive["attributes"]["NORMAL"].get<std::size_t>()]["count"],
                  position["count"]);
        EXPECT_EQ(accessors[primitive["indices"].get<std::size_t>()]["count"].get<int>() % 3, 0);
        const auto targets = primitive.value("targets", json::array());
        EXPECT_EQ(mesh["extras"]["targetNames"].size(), targets.size());
        EXPECT_EQ(mesh.value("weights", json::array()).size(), targets.size());
        for (const auto& target : targets) {
            const auto& delta = accessors[target["POSITION"].get<std::size_t>()];
            EXPECT_EQ(delta["count"], position["count"]);
            EXPECT_EQ(delta["min"].size(), 3u);
        }
    }
    for (const auto& image : document["images"]) EXPECT_EQ(image["mimeType"], "image/png");
}

TEST(Gltf, EveryCutIsRefusedByName) {
    const Bytes glb = write_glb(small_face(), "nobody");
    for (std::size_t size = 0; size < glb.size(); size += 1 + size / 50) {
        try {
            read_glb(std::span(glb).first(size));
            ADD_FAILURE() << size;
        } catch (const InputError& error) {
            EXPECT_EQ(error.field(), "face");
        }
    }
}

TEST(Png, RoundTripsAndRefusesRubbish) {
    for (const int channels : {3, 4}) {
        const Texture texture = checks(16, channels);
        const Texture read = decode_png(encode_png(texture));
        EXPECT_EQ(read.channels, channels);
        EXPECT_EQ(read.pixels, texture.pixels);
    }
    EXPECT_THROW(decode_png(Bytes(100, 7)), InputError);
    Bytes cut = encode_png(checks(16, 3));
    cut.resize(cut.size() / 2);
    EXPECT_THROW(decode_png(cut), InputError);
}

}  // namespace
}  // namespace viaface

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <numbers>

#include "base/error.hpp"
#include "facemodel/gltf_scan.hpp"
#include "facemodel/ply.hpp"
#include "facemodel/range_scan.hpp"
#include "facemodel/vtk_polydata.hpp"

namespace viaface {
namespace {

Bytes bytes_of(std::string_view text) { return {text.begin(), text.end()}; }

template <class T>
void put(Bytes& bytes, T value, bool big) {
    std::array<std::uint8_t, sizeof value> raw;
    std::memcpy(raw.data(), &value, sizeof value);
    if (big) std::reverse(raw.begin(), raw.end());
    bytes.insert(bytes.end(), raw.begin(), raw.end());
}

void put_text(Bytes& bytes, std::string_view text) { bytes.insert(bytes.end(), text.begin(), text.end()); }

const float kSquare[4][3] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0.5f}, {0, 2, 0}};

// What every format has to give back: a square of two triangles with its places in the picture.
void expect_square(const ScanMesh& mesh) {
    ASSERT_EQ(mesh.nodes.rows(), 4);
    for (int i = 0; i < 4; ++i) {
        for (int k = 0; k < 3; ++k) EXPECT_EQ(mesh.nodes(i, k), kSquare[i][k]);
    }
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
    ASSERT_EQ(mesh.uv_triangles.size(), 2u);
    for (std::size_t t = 0; t < 2; ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto uv = mesh.uvs.row(mesh.uv_triangles[t][k]);
            EXPECT_EQ(uv.x(), kSquare[mesh.triangles[t][k]][0] / 2);
            EXPECT_EQ(uv.y(), kSquare[mesh.triangles[t][k]][1] / 2);
        }
    }
}

const std::string kPlyHead =
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
    "property uchar green\nproperty uchar blue\nproperty double s\nproperty double t\n"
    "element face 1\nproperty uchar flag\nproperty list uchar int vertex_indices\nend_header\n";

Bytes binary_ply(bool big) {
    Bytes bytes = bytes_of(std::string("ply\nformat binary_") + (big ? "big" : "little") +
                           "_endian 1.0\ncomment TextureFile skin.png\n" + kPlyHead);
    for (const auto& place : kSquare) {
        for (const float x : place) put(bytes, x, big);
        for (const int c : {10, 20, 30}) put(bytes, static_cast<std::uint8_t>(c), big);
        put(bytes, place[0] / 2.0, big);
        put(bytes, place[1] / 2.0, big);
    }
    put(bytes, std::uint8_t{7}, big);
    put(bytes, std::uint8_t{4}, big);
    for (const int node : {0, 1, 2, 3}) put(bytes, node, big);
    return bytes;
}

TEST(Ply, GivesTheSameSurfaceInTextAndInEitherByteOrder) {
    std::string text = "ply\nformat ascii 1.0\n" + kPlyHead;
    text += "0 0 0 10 20 30 0 0\n2 0 0 10 20 30 1 0\n2 2 0.5 10 20 30 1 1\n0 2 0 10 20 30 0 1\n7 4 0 1 2 3\n";
    for (const Bytes& bytes : {bytes_of(text), binary_ply(false), binary_ply(true)}) {
        const ScanMesh mesh = parse_ply(bytes);
        expect_square(mesh);
        ASSERT_EQ(mesh.colours.size(), 4u);
        EXPECT_EQ(mesh.colours[2], (std::array<std::uint8_t, 3>{10, 20, 30}));
    }
    EXPECT_EQ(parse_ply(binary_ply(true)).pictures, std::vector<std::string>{"skin.png"});
}

TEST(Ply, RefusesWhatIsCutOrPointsNowhere) {
    const Bytes whole = binary_ply(false);
    for (std::size_t size = 0; size < whole.size(); ++size)
        EXPECT_THROW(parse_ply(std::span(whole).first(size)), InputError) << size;
    Bytes astray = whole;
    astray[astray.size() - 4] = 4;
    EXPECT_THROW(parse_ply(astray), InputError);
    Bytes not_a_number = whole;
    const float nan = std::nanf("");
    const auto first_node =
        std::string_view(reinterpret_cast<const char*>(whole.data()), whole.size()).find("end_header\n") + 11;
    std::memcpy(&not_a_number[first_node], &nan, sizeof nan);
    EXPECT_THROW(parse_ply(not_a_number), InputError);
    EXPECT_THROW(parse_ply(bytes_of("ply\nformat ascii 1.0\nelement vertex 10000000000\nproperty float x\n")),
                 InputError);
}

TEST(Ply, ErrorsNameTheLine) {
    try {
        parse_ply(
            bytes_of("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                     "property float z\nend_header\n0 zero 0\n"));
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(error.value().find("line 8"), std::string::npos) << error.value();
        EXPECT_NE(error.value().find("zero"), std::string::npos) << error.value();
    }
}

TEST(Ply, CutsStrips) {
    const auto mesh = parse_ply(
        bytes_of("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                 "property float z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n"
                 "0 0 0 2 0 0 0 2 0 2 2 0\n8 0 1 2 3 -1 3 1 2\n"));
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}, {3, 1, 2}}));
}

Bytes vtk_head(bool text) {
    return bytes_of(std::string("# vtk DataFile Version 4.2\nsquare\n") + (text ? "ASCII" : "BINARY") +
                    "\nDATASET POLYDATA\n");
}

Bytes binary_vtk(bool fifth) {
    Bytes bytes = vtk_head(false);
    put_text(bytes, "POINTS 4 float\n");
    for (const auto& place : kSquare) {
        for (const float x : place) put(bytes, x, true);
    }
    if (fifth) {
        put_text(bytes, "\nMETADATA\nINFORMATION 0\n\nPOLYGONS 2 4\nOFFSETS vtktypeint64\n");
        for (const std::int64_t k : {0, 4}) put(bytes, k, true);
        put_text(bytes, "\nCONNECTIVITY vtktypeint64\n");
        for (const std::int64_t k : {0, 1, 2, 3}) put(bytes, k, true);
    } else {
        put_text(bytes, "\nPOLYGONS 1 5\n");
        for (const int k : {4, 0, 1, 2, 3}) put(bytes, k, true);
    }
    put_text(bytes, "\nCELL_DATA 1\nPOINT_DATA 4\nSCALARS heat double 1\nLOOKUP_TABLE default\n");
    for (const double k : {1, 2, 3, 4}) put(bytes, k, true);
    put_text(bytes, "\nTEXTURE_COORDINATES tcoords 2 float\n");
    for (const auto& place : kSquare) {
        put(bytes, place[0] / 2, true);
        put(bytes, place[1] / 2, true);
    }
    put_text(bytes, "\n");
    return bytes;
}

TEST(VtkPolydata, GivesTheSameSurfaceInTextAndBinaryOfOldAndNewVersions) {
    Bytes text = vtk_head(true);
    put_text(text,
             "POINTS 4 double\n0 0 0 2 0 0\n2 2 0.5 0 2 0\nVERTICES 1 2\n1 0\nPOLYGONS 1 5\n4 0 1 2 3\n"
             "POINT_DATA 4\nNORMALS n float\n0 0 1 0 0 1 0 0 1 0 0 1\nFIELD more 1\na 1 4 int\n1 2 3 4\n"
             "TEXTURE_COORDINATES t 2 float\n0 0 1 0 1 1 0 1\n");
    expect_square(parse_vtk(text));
    expect_square(parse_vtk(binary_vtk(false)));
    expect_square(parse_vtk(binary_vtk(true)));
}

TEST(VtkPolydata, CutsStrips) {
    Bytes text = vtk_head(true);
    put_text(text, "POINTS 4 float\n0 0 0 2 0 0 0 2 0 2 2 0\nTRIANGLE_STRIPS 1 5\n4 0 1 2 3\n");
    EXPECT_EQ(parse_vtk(text).triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}}));
}

TEST(VtkPolydata, RefusesWhatIsCutOrOfAnotherKind) {
    for (const bool fifth : {false, true}) {
        const Bytes whole = binary_vtk(fifth);
        const auto needed =
            std::string_view(reinterpret_cast<const char*>(whole.data()), whole.size()).find("CELL_DATA");
        for (std::size_t size = 0; size < needed - 1; ++size)
            EXPECT_THROW(parse_vtk(std::span(whole).first(size)), InputError) << size;
    }
    EXPECT_THROW(parse_vtk(bytes_of("# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_GRID\n")),
                 InputError);
    Bytes astray = vtk_head(true);
    put_text(astray, "POINTS 3 float\n0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1 3\n");
    EXPECT_THROW(parse_vtk(astray), InputError);
}

std::string base64(const Bytes& bytes) {
    static const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t held = 0;
        for (std::size_t k = 0; k < 3; ++k) held = held << 8 | (i + k < bytes.size() ? bytes[i + k] : 0);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? digits[held >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::string gltf_square(const std::string& uri) {
    return R"({"asset":{"version":"2.0"},"nodes":[{"children":[1],"scale":[2,2,1]},{"mesh":0}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2,"material":0}]}],
      "materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],"textures":[{"source":0}],
      "images":[{"uri":"skin.jpg"}],
      "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
        {"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"},
        {"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"}],
      "bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":32},
        {"buffer":0,"byteOffset":80,"byteLength":12}],"buffers":[{"byteLength":92,"uri":")" +
           uri + "\"}]}";
}

Bytes gltf_buffer() {
    Bytes bytes;
    for (const auto& place : kSquare) {
        put(bytes, place[0] / 2, false);
        put(bytes, place[1] / 2, false);
        put(bytes, place[2], false);
    }
    for (const auto& place : kSquare) {
        put(bytes, place[0] / 2, false);
        put(bytes, 1 - place[1] / 2, false);
    }
    for (const int k : {0, 1, 2, 0, 2, 3}) put(bytes, static_cast<std::uint16_t>(k), false);
    return bytes;
}

TEST(GltfScan, FollowsNodesAndReadsBuffersInsideAndBeside) {
    const auto none = [](const std::string& name) -> Bytes { throw InputError("scan", name, "nothing"); };
    const ScanMesh inside = parse_gltf_scan(
        bytes_of(gltf_square("data:application/octet-stream;base64," + base64(gltf_buffer()))), none);
    expect_square(inside);
    EXPECT_EQ(inside.pictures, std::vector<std::string>{"skin.jpg"});
    expect_square(parse_gltf_scan(bytes_of(gltf_square("square.bin")), [](const std::string& name) {
        EXPECT_EQ(name, "square.bin");
        return gltf_buffer();
    }));
}

TEST(GltfScan, RefusesBuffersThatAreTooShort) {
    for (std::size_t size = 0; size < gltf_buffer().size(); ++size) {
        EXPECT_THROW(parse_gltf_scan(bytes_of(gltf_square("square.bin")),
                                     [&](const std::string&) {
                                         Bytes bytes = gltf_buffer();
                                         bytes.resize(size);
                                         return bytes;
                                     }),
                     InputError);
    }
}

Bytes pgm(int columns, int rows, std::uint16_t value) {
    Bytes bytes =
        bytes_of("P5\n# range\n" + std::to_string(columns) + " " + std::to_string(rows) + "\n65535\n");
    for (int i = 0; i < columns * rows; ++i) put(bytes, value, true);
    return bytes;
}

TEST(RangeScan, OfOneRadiusIsAClosedCylinder) {
    const auto mesh = range_surface(parse_pgm(pgm(36, 5, 1000)), {0.1, 0, 360, -10, 10, 0.1});
    EXPECT_EQ(mesh.nodes.rows(), 36 * 5);
    EXPECT_EQ(mesh.triangles.size(), 2u * 36 * 4);
    for (Eigen::Index i = 0; i < mesh.nodes.rows(); ++i)
        EXPECT_NEAR(std::hypot(mesh.nodes(i, 0), mesh.nodes(i, 2)), 100, 1e-9);
    EXPECT_NEAR(mesh.nodes(0, 1), 8, 1e-12);
    EXPECT_NEAR(mesh.nodes(0, 0), 100 * std::sin(5 * std::numbers::pi / 180), 1e-9);
    for (const Triangle& t : mesh.triangles) {  // seen from outside
        const Eigen::Vector3d a = mesh.nodes.row(t[0]), b = mesh.nodes.row(t[1]), c = mesh.nodes.row(t[2]);
        const Eigen::Vector3d normal = (b - a).cross(c - a);
        EXPECT_GT(normal.dot(Eigen::Vector3d(a.x() + b.x() + c.x(), 0, a.z() + b.z() + c.z())), 0);
    }
}

TEST(RangeScan, LeavesHolesOpenAndTearsAtJumps) {
    RangePicture picture = parse_pgm(pgm(10, 10, 1000));
    picture.values[55] = 0;
    const RangeLayout sector{0.1, -45, 45, 0, 90, 0.1};
    EXPECT_EQ(range_surface(picture, sector).triangles.size(), 2u * (81 - 4));
    picture.values[55] = 1200;
    EXPECT_EQ(range_surface(picture, sector).triangles.size(), 2u * (81 - 4));
    picture.values[55] = 1050;
    EXPECT_EQ(range_surface(picture, sector).triangles.size(), 2u * 81);
}

TEST(RangeScan, RefusesWhatIsCutOrHasNoSize) {
    const Bytes whole = pgm(3, 3, 7);
    for (std::size_t size = 0; size < whole.size(); ++size)
        EXPECT_THROW(parse_pgm(std::span(whole).first(size)), InputError) << size;
    EXPECT_THROW(range_surface(parse_pgm(pgm(4, 4, 9)), {0, 0, 360, 0, 1, 0.1}), InputError);
    EXPECT_THROW(range_surface(parse_pgm(pgm(4, 4, 0)), {1, 0, 360, 0, 1, 0.1}), InputError);
}

TEST(Mtl, NamesColourPicturesByMaterial) {
    const auto pictures =
        parse_mtl("# x\nnewmtl skin\r\nKd 1 1 1\r\nmap_Kd -s 1 1 1 face.jpg\r\nnewmtl cloth\n");
    EXPECT_EQ(pictures, (std::map<std::string, std::string>{{"skin", "face.jpg"}}));
}

TEST(ScanMesh, ThinnedKeepsTheShapeWithFewerNodes) {
    const auto fine = range_surface(parse_pgm(pgm(360, 50, 1000)), {0.1, 0, 360, 0, 87, 0.1});
    const auto thin = thinned(fine, 8.0);
    EXPECT_LT(thin.nodes.rows(), fine.nodes.rows() / 9);
    EXPECT_GT(thin.triangles.size(), 500u);
    for (Eigen::Index i = 0; i < thin.nodes.rows(); ++i)
        EXPECT_NEAR(std::hypot(thin.nodes(i, 0), thin.nodes(i, 2)), 100, 1e-9);
    EXPECT_EQ(pieces_of(thin).size(), 1u);
}

}  // namespace
}  // namespace viaface

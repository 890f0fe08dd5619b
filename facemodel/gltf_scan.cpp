#include "facemodel/gltf_scan.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "facemodel/gltf_layout.hpp"

namespace viaface {
namespace {

using nlohmann::json;

[[noreturn]] void refuse(const std::string& value, const std::string& allowed) {
    throw InputError("scan", value, allowed);
}

Bytes from_base64(std::string_view text) {
    Bytes bytes;
    std::uint32_t held = 0;
    int bits = 0;
    for (const char c : text) {
        int value = -1;
        if (c >= 'A' && c <= 'Z') value = c - 'A';
        if (c >= 'a' && c <= 'z') value = c - 'a' + 26;
        if (c >= '0' && c <= '9') value = c - '0' + 52;
        if (c == '+') value = 62;
        if (c == '/') value = 63;
        if (c == '=') break;
        if (value < 0) refuse(std::string("a base64 text with '") + c + "'", "A-Z a-z 0-9 + /");
        held = held << 6 | static_cast<std::uint32_t>(value);
        bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        bytes.push_back(static_cast<std::uint8_t>(held >> bits));
    }
    return bytes;
}

class GltfScan {
  public:
    GltfScan(std::span<const std::uint8_t> bytes, const FileBeside& file_beside) : file_beside_(file_beside) {
        std::uint32_t magic = 0;
        if (bytes.size() >= 4) std::memcpy(&magic, bytes.data(), 4);
        if (magic == gltf::kMagic) {
            read_chunks(bytes);
        } else {
            gltf_ = json::parse(bytes.begin(), bytes.end());
        }
        if (!gltf_.is_object()) refuse("no JSON object", "a glTF 2.0 file");
        for (const auto& name : gltf_.value("extensionsRequired", json::array())) {
            if (name.get<std::string>().find("materials") == std::string::npos)
                refuse("extension " + name.get<std::string>(), "plain glTF 2.0");
        }
        for (const auto& buffer : gltf_.value("buffers", json::array())) buffers_.push_back(load(buffer));
    }

    ScanMesh read() {
        const auto& nodes = gltf_.value("nodes", json::array());
        std::vector<char> is_child(nodes.size());
        for (const auto& node : nodes) {
            for (const auto& child : node.value("children", json::array()))
                is_child.at(child.get<std::size_t>()) = 1;
        }
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            if (!is_child[i]) add_node(i, Eigen::Affine3d::Identity(), 0);
        }
        return joined();
    }

  private:
    static constexpr int kDeepest = 64;

    struct Accessor {
        std::span<const std::uint8_t> bytes;
        std::size_t count, stride, components;
        int type;
        bool normalised;
    };

    void read_chunks(std::span<const std::uint8_t> bytes) {
        ByteReader reader(bytes);
        reader.take(12);
        while (reader.left() >= 8) {
            const auto size = reader.get<std::uint32_t>(), kind = reader.get<std::uint32_t>();
            const auto chunk = reader.take(size);
            if (kind == gltf::kJsonChunk) gltf_ = json::parse(chunk.begin(), chunk.end());
            if (kind == gltf::kBinChunk) binary_.assign(chunk.begin(), chunk.end());
        }
    }

    Bytes load(const json& thing) {
        if (!thing.contains("uri")) return binary_;
        const std::string uri = thing["uri"];
        if (!uri.starts_with("data:")) return file_beside_(uri);
        const auto comma = uri.find(";base64,");
        if (comma == std::string::npos) refuse("a data URI", "in base64");
        return from_base64(std::string_view(uri).substr(comma + 8));
    }

    std::span<const std::uint8_t> view(std::size_t index) const {
        const json& view = gltf_.at("bufferViews").at(index);
        const Bytes& buffer = buffers_.at(view.at("buffer").get<std::size_t>());
        const auto first = view.value("byteOffset", std::size_t{0});
        const auto size = view.at("byteLength").get<std::size_t>();
        if (first > buffer.size() || size > buffer.size() - first)
            refuse("buffer view " + std::to_string(index), "within its buffer");
        return {buffer.data() + first, size};
    }

    static std::size_t size_of(int type) {
        if (type == 5120 || type == 5121) return 1;
        if (type == 5122 || type == 5123) return 2;
        if (type == gltf::kUnsigned || type == gltf::kFloat) return 4;
        refuse("component type " + std::to_string(type), "5120 to 5123, 5125 or 5126");
    }

    Accessor accessor(const json& index, const std::string& kind) const {
        const json& a = gltf_.at("accessors").at(index.get<std::size_t>());
        if (a.contains("sparse") || !a.contains("bufferView")) refuse("a sparse accessor", "plain accessors");
        if (a.at("type") != kind) refuse("accessor of type " + a.at("type").dump(), kind);
        Accessor found{};
        found.type = a.at("componentType");
        found.components = kind == "SCALAR" ? 1 : static_cast<std::size_t>(kind.back() - '0');
        found.normalised = a.value("normalized", false);
        found.count = a.at("count").get<std::size_t>();
        const auto view_index = a["bufferView"].get<std::size_t>();
        const auto whole = view(view_index);
        const std::size_t each = size_of(found.type) * found.components;
        found.stride = gltf_["bufferViews"][view_index].value("byteStride", each);
        const auto first = a.value("byteOffset", std::size_t{0});
        if (found.count == 0 || found.count > kLargestScanTriangles * 3 || found.stride < each ||
            found.stride > 4096 || first > whole.size() ||
            (found.count - 1) * found.stride + each > whole.size() - first)
            refuse("accessor " + index.dump(), "within its buffer view");
        found.bytes = whole.subspan(first);
        return found;
    }

    static double component(const Accessor& a, std::size_t item, std::size_t k) {
        const std::uint8_t* at = a.bytes.data() + item * a.stride + k * size_of(a.type);
        const auto as = [&]<class T>(T value) {
            std::memcpy(&value, at, sizeof value);
            return static_cast<double>(value);
        };
        switch (a.type) {
            case 5121:
                return as(std::uint8_t{}) / (a.normalised ? 255 : 1);
            case 5123:
                return as(std::uint16_t{}) / (a.normalised ? 65535 : 1);
            case 5125:
                return as(std::uint32_t{});
            case 5126:
                return as(float{});
            default:
                refuse("component type " + std::to_string(a.type), "unsigned or float");
        }
    }

    static Eigen::Affine3d place_of(const json& node) {
        Eigen::Affine3d place = Eigen::Affine3d::Identity();
        if (node.contains("matrix")) {
            const auto numbers = node["matrix"].get<std::array<double, 16>>();
            place.matrix() = Eigen::Map<const Eigen::Matrix4d>(numbers.data());
            return place;
        }
        const auto t = node.value("translation", std::array<double, 3>{0, 0, 0});
        const auto r = node.value("rotation", std::array<double, 4>{0, 0, 0, 1});
        const auto s = node.value("scale", std::array<double, 3>{1, 1, 1});
        return Eigen::Translation3d(t[0], t[1], t[2]) *
               Eigen::Quaterniond(r[3], r[0], r[1], r[2]).normalized() * Eigen::Scaling(s[0], s[1], s[2]);
    }

    void add_node(std::size_t index, const Eigen::Affine3d& parent, int depth) {
        if (depth > kDeepest || ++visited_ > 100'000) refuse("nodes within nodes", "a tree, at most 64 deep");
        const json& node = gltf_.at("nodes").at(index);
        const Eigen::Affine3d place = parent * place_of(node);
        if (node.contains("mesh")) {
            for (const json& primitive :
                 gltf_.at("meshes").at(node["mesh"].get<std::size_t>()).at("primitives"))
                add_primitive(primitive, place);
        }
        for (const auto& child : node.value("children", json::array()))
            add_node(child.get<std::size_t>(), place, depth + 1);
    }

    void add_primitive(const json& primitive, const Eigen::Affine3d& place) {
        const int mode = primitive.value("mode", 4);
        if (mode < 4) return;
        const json& attributes = primitive.at("attributes");
        const Accessor places = accessor(attributes.at("POSITION"), "VEC3");
        const auto first = static_cast<int>(places_.size() / 3);
        if (places_.size() / 3 + places.count > kLargestScanNodes)
            refuse("more nodes", "at most " + std::to_string(kLargestScanNodes));
        for (std::size_t i = 0; i < places.count; ++i) {
            const Eigen::Vector3d at =
                place *
                Eigen::Vector3d(component(places, i, 0), component(places, i, 1), component(places, i, 2));
            places_.insert(places_.end(), at.data(), at.data() + 3);
        }
        add_uvs(attributes, places.count);
        std::vector<int> corners;
        if (primitive.contains("indices")) {
            const Accessor indices = accessor(primitive["indices"], "SCALAR");
            for (std::size_t i = 0; i < indices.count; ++i) {
                const double node = component(indices, i, 0);
                if (node >= static_cast<double>(places.count))
                    refuse("index " + std::to_string(node), "a node");
                corners.push_back(first + static_cast<int>(node));
            }
        } else {
            for (std::size_t i = 0; i < places.count; ++i) corners.push_back(first + static_cast<int>(i));
        }
        add_triangles(mode, corners);
        note_picture(primitive);
    }

    void add_uvs(const json& attributes, std::size_t count) {
        if (!attributes.contains("TEXCOORD_0")) {
            all_mapped_ = false;
            uvs_.resize(uvs_.size() + 2 * count);
            return;
        }
        const Accessor uvs = accessor(attributes["TEXCOORD_0"], "VEC2");
        if (uvs.count != count) refuse("TEXCOORD_0 of another count", "as many as POSITION");
        for (std::size_t i = 0; i < count; ++i) {
            uvs_.push_back(component(uvs, i, 0));
            uvs_.push_back(1 - component(uvs, i, 1));
        }
    }

    void add_triangles(int mode, const std::vector<int>& corners) {
        if (mode == 5) return add_strip(mesh_, corners);
        if (mode == 6) return add_polygon(mesh_, corners, {});
        for (std::size_t k = 0; k + 2 < corners.size(); k += 3)
            mesh_.triangles.push_back({corners[k], corners[k + 1], corners[k + 2]});
    }

    void note_picture(const json& primitive) {
        if (!mesh_.picture.empty() || !mesh_.pictures.empty() || !primitive.contains("material")) return;
        const json& material = gltf_.at("materials").at(primitive["material"].get<std::size_t>());
        const json colour =
            material.value("pbrMetallicRoughness", json::object()).value("baseColorTexture", json::object());
        if (!colour.contains("index")) return;
        const json& texture = gltf_.at("textures").at(colour["index"].get<std::size_t>());
        if (!texture.contains("source")) return;
        const json& image = gltf_.at("images").at(texture["source"].get<std::size_t>());
        if (image.contains("bufferView")) {
            const auto bytes = view(image["bufferView"].get<std::size_t>());
            mesh_.picture.assign(bytes.begin(), bytes.end());
        } else if (image.value("uri", "").starts_with("data:")) {
            mesh_.picture = load(image);
        } else if (image.contains("uri")) {
            mesh_.pictures.push_back(image["uri"]);
        }
    }

    ScanMesh joined() {
        mesh_.nodes =
            Eigen::Map<const Nodes>(places_.data(), static_cast<Eigen::Index>(places_.size() / 3), 3);
        if (all_mapped_ && !uvs_.empty()) {
            mesh_.uvs = Eigen::Map<const decltype(mesh_.uvs)>(uvs_.data(),
                                                              static_cast<Eigen::Index>(uvs_.size() / 2), 2);
            share_uvs_with_nodes(mesh_);
        }
        check(mesh_);
        return std::move(mesh_);
    }

    const FileBeside& file_beside_;
    json gltf_;
    Bytes binary_;
    std::vector<Bytes> buffers_;
    std::vector<double> places_, uvs_;
    bool all_mapped_ = true;
    int visited_ = 0;
    ScanMesh mesh_;
};

}  // namespace

ScanMesh parse_gltf_scan(std::span<const std::uint8_t> bytes, const FileBeside& file_beside) {
    try {
        return GltfScan(bytes, file_beside).read();
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) {
        refuse(error.what(), "a glTF 2.0 file");
    }
}

}  // namespace viaface

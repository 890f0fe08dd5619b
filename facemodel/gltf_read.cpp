#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "facemodel/gltf.hpp"
#include "facemodel/gltf_layout.hpp"
#include "facemodel/png.hpp"

namespace viaface {
namespace {

using nlohmann::json;
using FloatRows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

[[noreturn]] void refuse(const std::string& met, const std::string& allowed) {
    throw InputError("face", met, allowed);
}

template <std::size_t N>
std::size_t index_in(const std::array<const char*, N>& names, const std::string& name) {
    const auto found =
        std::find_if(names.begin(), names.end(), [&](const char* each) { return name == each; });
    if (found == names.end()) refuse(name, "a material or drive of this format");
    return static_cast<std::size_t>(found - names.begin());
}

class Reader {
  public:
    explicit Reader(std::span<const std::uint8_t> bytes) { unpack(bytes); }

    Face read(Textures textures) {
        const json& extras = json_.at("asset").at("extras").at("viaface");
        if (extras.at("format") != gltf::kFormat) refuse(extras.at("format").dump(), "format 1");
        read_parts();
        read_extras(extras);
        if (textures == Textures::kRead) read_textures();
        return std::move(face_);
    }

  private:
    void unpack(std::span<const std::uint8_t> bytes) {
        ByteReader in(bytes);
        if (in.get<std::uint32_t>() != gltf::kMagic || in.get<std::uint32_t>() != gltf::kVersion)
            refuse("another magic or version", "binary glTF 2.0");
        if (in.get<std::uint32_t>() != bytes.size())
            refuse("a length that is not the file's", "the file's length");
        const auto text = chunk(in, gltf::kJsonChunk);
        json_ = json::parse(text.begin(), text.end());
        bin_ = chunk(in, gltf::kBinChunk);
    }

    static std::span<const std::uint8_t> chunk(ByteReader& in, std::uint32_t type) {
        const auto size = in.get<std::uint32_t>();
        if (in.get<std::uint32_t>() != type) refuse("another chunk", "a JSON chunk, then a BIN chunk");
        return in.take(size);
    }

    std::span<const std::uint8_t> view(const json& index) const {
        const json& view = json_.at("bufferViews").at(index.get<std::size_t>());
        const auto offset = view.at("byteOffset").get<std::size_t>(),
                   length = view.at("byteLength").get<std::size_t>();
        if (offset > bin_.size() || length > bin_.size() - offset)
            refuse("a buffer view past the end", "views inside the BIN chunk");
        return bin_.subspan(offset, length);
    }

    template <class T>
    std::vector<T> elements(const json& index, int component, std::size_t width) const {
        static constexpr const char* kTypes[] = {"", "SCALAR", "VEC2", "VEC3"};
        const json& accessor = json_.at("accessors").at(index.get<std::size_t>());
        const auto bytes = view(accessor.at("bufferView"));
        const auto count = accessor.at("count").get<std::size_t>();
        if (accessor.at("componentType") != component || accessor.at("type") != kTypes[width] ||
            count > bytes.size() || count * width * sizeof(T) != bytes.size()) {
            refuse("accessor " + index.dump(), "one of the kind this format has");
        }
        std::vector<T> result(count * width);
        std::memcpy(result.data(), bytes.data(), bytes.size());
        return result;
    }

    FloatRows rows(const json& index, int width, Eigen::Index expected = -1) const {
        const auto floats = elements<float>(index, gltf::kFloat, static_cast<std::size_t>(width));
        FloatRows result = Eigen::Map<const FloatRows>(
            floats.data(), static_cast<Eigen::Index>(floats.size()) / width, width);
        if (!result.allFinite()) refuse("numbers that are not finite", "finite numbers");
        if (expected >= 0 && result.rows() != expected)
            refuse(std::to_string(result.rows()) + " elements", std::to_string(expected));
        return result;
    }

    Eigen::VectorXd numbers(const json& index, Eigen::Index expected) const {
        return rows(index, 1, expected).col(0).cast<double>();
    }

    void read_parts() {
        std::vector<FloatRows> places, uvs;
        int nodes = 0;
        for (const json& mesh : json_.at("meshes")) {
            const json& primitive = mesh.at("primitives").at(0);
            const json& attributes = primitive.at("attributes");
            places.push_back(rows(attributes.at("POSITION"), 3));
            uvs.push_back(rows(attributes.at("TEXCOORD_0"), 2, places.back().rows()));
            FacePart part;
            part.name = mesh.at("name");
            const auto material = primitive.at("material").get<std::size_t>();
            if (material >= kMaterials)
                refuse("material " + std::to_string(material), "a material of this format");
            part.material = static_cast<Material>(material);
            part.drive = static_cast<Drive>(index_in(gltf::kDriveNames, mesh.at("extras").at("drive")));
            part.first_node = nodes;
            part.nodes = static_cast<int>(places.back().rows());
            part.triangles = triangles(primitive.at("indices"), part);
            nodes += part.nodes;
            gather_targets(mesh, primitive, part);
            face_.parts.push_back(std::move(part));
        }
        if (nodes == 0) refuse("no nodes", "a face");
        face_.rest.resize(nodes, 3);
        face_.uvs.resize(nodes, 2);
        for (std::size_t i = 0; i < places.size(); ++i) {
            const FacePart& part = face_.parts[i];
            face_.rest.middleRows(part.first_node, part.nodes) = places[i].cast<double>();
            face_.uvs.middleRows(part.first_node, part.nodes) = uvs[i];
        }
        face_.uvs.col(1) = 1 - face_.uvs.col(1).array();
    }

    std::vector<Triangle> triangles(const json& index, const FacePart& part) const {
        const auto corners = elements<std::uint32_t>(index, gltf::kUnsigned, 1);
        std::vector<Triangle> result(corners.size() / 3);
        for (std::size_t i = 0; i < 3 * result.size(); ++i) {
            if (corners[i] >= static_cast<std::uint32_t>(part.nodes))
                refuse("index " + std::to_string(corners[i]), "a node of its part");
            result[i / 3][i % 3] = part.first_node + static_cast<int>(corners[i]);
        }
        return result;
    }

    void gather_targets(const json& mesh, const json& primitive, const FacePart& part) {
        const json& names = mesh.at("extras").at("targetNames");
        const json targets = primitive.value("targets", json::array());
        if (names.size() != targets.size()) refuse("targets without names", "a name for each target");
        for (std::size_t i = 0; i < names.size(); ++i) {
            targets_[names[i]].push_back({part.first_node, rows(targets[i].at("POSITION"), 3, part.nodes)});
        }
    }

    Nodes target(const std::string& name) const {
        Nodes delta = Nodes::Zero(face_.rest.rows(), 3);
        const auto found = targets_.find(name);
        if (found == targets_.end()) return delta;
        for (const auto& [first, part] : found->second)
            delta.middleRows(first, part.rows()) = part.cast<double>();
        return delta;
    }

    void read_extras(const json& extras) {
        const Eigen::Index nodes = face_.rest.rows();
        const auto weld = elements<std::uint32_t>(extras.at("weld"), gltf::kUnsigned, 1);
        if (weld.size() != static_cast<std::size_t>(nodes))
            refuse("a weld of another size", "one node per node");
        for (const std::uint32_t node : weld) {
            if (node >= static_cast<std::uint32_t>(nodes)) refuse("weld " + std::to_string(node), "a node");
            face_.weld.push_back(static_cast<int>(node));
        }
        face_.mean = numbers(extras.at("mean"), 3 * nodes);
        face_.mode_variance = numbers(extras.at("mode_variance"), -1);
        face_.modes.resize(3 * nodes, face_.mode_variance.size());
        for (Eigen::Index k = 0; k < face_.modes.cols(); ++k) {
            if (!(face_.mode_variance(k) > 0)) refuse("a variance of 0 or less", "variances above 0");
            const Nodes delta = target("mode_" + std::to_string(k + 1)) / std::sqrt(face_.mode_variance(k));
            face_.modes.col(k) = Eigen::Map<const Eigen::VectorXd>(delta.data(), 3 * nodes);
        }
        for (const json& name : extras.at("shapes")) face_.shapes.push_back({name, target(name)});
        face_.lips.first_node = extras.at("lips_first_node");
        if (face_.lips.first_node < 0 || face_.lips.first_node + LipGrid::kRows * LipGrid::kColumns > nodes)
            refuse("a lip grid past the nodes", "600 nodes of the face");
        const auto hinge = extras.at("jaw_hinge").get<std::array<double, 3>>();
        face_.jaw_hinge = {hinge[0], hinge[1], hinge[2]};
    }

    void read_textures() {
        const json& materials = json_.at("materials");
        if (materials.size() != kMaterials)
            refuse(std::to_string(materials.size()) + " materials", std::to_string(kMaterials));
        for (std::size_t i = 0; i < kMaterials; ++i) {
            const json& pbr = materials[i].at("pbrMetallicRoughness");
            Surface& surface = face_.surfaces[i];
            if (pbr.contains("baseColorTexture")) surface.base_colour = texture(pbr["baseColorTexture"]);
            if (pbr.contains("metallicRoughnessTexture"))
                surface.occlusion_roughness = texture(pbr["metallicRoughnessTexture"]);
            if (materials[i].contains("normalTexture"))
                surface.normal = texture(materials[i]["normalTexture"]);
        }
    }

    Texture texture(const json& reference) const {
        const json& texture = json_.at("textures").at(reference.at("index").get<std::size_t>());
        return decode_png(
            view(json_.at("images").at(texture.at("source").get<std::size_t>()).at("bufferView")));
    }

    struct PartTarget {
        int first_node;
        FloatRows delta;
    };

    json json_;
    std::span<const std::uint8_t> bin_;
    std::map<std::string, std::vector<PartTarget>> targets_;
    Face face_;
};

}  // namespace

Face read_glb(std::span<const std::uint8_t> bytes, Textures textures) {
    try {
        return Reader(bytes).read(textures);
    } catch (const InputError&) {
        throw;
    } catch (const json::exception& error) {
        refuse(error.what(), "the JSON of a face.glb");
    } catch (const std::runtime_error& error) {
        refuse(error.what(), "a whole face.glb");
    }
}

}  // namespace viaface

#include <Eigen/Geometry>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "facemodel/gltf.hpp"
#include "facemodel/gltf_layout.hpp"
#include "facemodel/png.hpp"

namespace viaface {
namespace {

using nlohmann::json;
using FloatRows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double kLeastMove = 1e-4;  // mm: a target that moves a part by less is left out of it

Nodes normals_of(const Face& face) {
    Nodes normals = Nodes::Zero(face.rest.rows(), 3);
    const auto at = [&](int node) { return Eigen::RowVector3d(face.rest.row(node)); };
    for (const FacePart& part : face.parts) {
        for (const Triangle& t : part.triangles) {
            const Eigen::RowVector3d area = (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0]));
            for (const int node : t) normals.row(face.weld[static_cast<std::size_t>(node)]) += area;
        }
    }
    Nodes result(normals.rows(), 3);
    for (Eigen::Index i = 0; i < result.rows(); ++i) {
        const Eigen::RowVector3d sum = normals.row(face.weld[static_cast<std::size_t>(i)]);
        result.row(i) = sum.norm() > 0 ? Eigen::RowVector3d(sum.normalized()) : Eigen::RowVector3d::UnitZ();
    }
    return result;
}

// An array of one. Braces around one value are an array to one compiler and the value to another.
json only(json value) {
    json array = json::array();
    array.push_back(std::move(value));
    return array;
}

class Writer {
  public:
    explicit Writer(const Face& face) : face_(face), normals_(normals_of(face)) {
        json_ = {{"scene", 0}, {"scenes", only({{"nodes", only(0)}})}};
        json_["nodes"] =
            only({{"name", "head"}, {"scale", {0.001, 0.001, 0.001}}, {"children", json::array()}});
        for (const char* list : {"meshes", "accessors", "bufferViews", "materials"})
            json_[list] = json::array();
    }

    Bytes write(const std::string& copyright) {
        add_materials();
        for (const FacePart& part : face_.parts) add_part(part);
        json_["asset"] = {{"version", "2.0"},
                          {"generator", "viaface"},
                          {"copyright", copyright},
                          {"extras", {{"viaface", extras()}}}};
        json_["buffers"] = only({{"byteLength", bin_.size()}});
        return packed();
    }

  private:
    int add_view(std::span<const std::uint8_t> bytes, int target) {
        bin_.resize((bin_.size() + 3) / 4 * 4, 0);
        json view = {{"buffer", 0}, {"byteOffset", bin_.size()}, {"byteLength", bytes.size()}};
        if (target != 0) view["target"] = target;
        bin_.insert(bin_.end(), bytes.begin(), bytes.end());
        json_["bufferViews"].push_back(std::move(view));
        return static_cast<int>(json_["bufferViews"].size()) - 1;
    }

    template <class T>
    int add_accessor(const T* data, std::size_t count, int width, int component, int target,
                     json bounds = json::object()) {
        static constexpr const char* kTypes[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(data);
        bounds.update(
            {{"bufferView", add_view({bytes, count * static_cast<std::size_t>(width) * sizeof(T)}, target)},
             {"componentType", component},
             {"count", count},
             {"type", kTypes[width]}});
        json_["accessors"].push_back(std::move(bounds));
        return static_cast<int>(json_["accessors"].size()) - 1;
    }

    int add_rows(const FloatRows& rows, int target, bool bounded) {
        json bounds = json::object();
        if (bounded) {
            for (Eigen::Index k = 0; k < rows.cols(); ++k) {
                bounds["min"].push_back(rows.col(k).minCoeff());
                bounds["max"].push_back(rows.col(k).maxCoeff());
            }
        }
        return add_accessor(rows.data(), static_cast<std::size_t>(rows.rows()), static_cast<int>(rows.cols()),
                            gltf::kFloat, target, bounds);
    }

    int add_numbers(const Eigen::Ref<const Eigen::VectorXd>& numbers) {
        const Eigen::VectorXf floats = numbers.cast<float>();
        return add_accessor(floats.data(), static_cast<std::size_t>(floats.size()), 1, gltf::kFloat, 0);
    }

    std::optional<int> add_texture(const Texture& texture) {
        if (texture.pixels.empty()) return std::nullopt;
        const Bytes png = encode_png(texture);
        json_["images"].push_back({{"bufferView", add_view(png, 0)}, {"mimeType", "image/png"}});
        json_["textures"].push_back({{"source", json_["images"].size() - 1}});
        return static_cast<int>(json_["textures"].size()) - 1;
    }

    void add_materials() {
        for (std::size_t i = 0; i < face_.surfaces.size(); ++i) {
            const Surface& surface = face_.surfaces[i];
            json material = {{"name", gltf::kMaterialNames[i]},
                             {"pbrMetallicRoughness", {{"metallicFactor", 0}}}};
            if (const auto t = add_texture(surface.base_colour)) {
                material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", *t}};
                if (surface.base_colour.channels == 4)
                    material.update({{"alphaMode", "BLEND"}, {"doubleSided", true}});
            }
            if (const auto t = add_texture(surface.occlusion_roughness)) {
                material["occlusionTexture"] = {{"index", *t}};
                material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", *t}};
            }
            if (const auto t = add_texture(surface.normal)) material["normalTexture"] = {{"index", *t}};
            json_["materials"].push_back(std::move(material));
        }
    }

    void add_part(const FacePart& part) {
        FloatRows uvs = face_.uvs.middleRows(part.first_node, part.nodes);
        uvs.col(1) = 1 - uvs.col(1).array();  // glTF counts v downwards
        std::vector<std::uint32_t> indices;
        for (const Triangle& t : part.triangles) {
            for (const int node : t) indices.push_back(static_cast<std::uint32_t>(node - part.first_node));
        }
        json primitive;
        primitive["attributes"] = {
            {"POSITION", add_rows(face_.rest.middleRows(part.first_node, part.nodes).cast<float>(),
                                  gltf::kVertexBuffer, true)},
            {"NORMAL", add_rows(normals_.middleRows(part.first_node, part.nodes).cast<float>(),
                                gltf::kVertexBuffer, false)},
            {"TEXCOORD_0", add_rows(uvs, gltf::kVertexBuffer, false)}};
        primitive["indices"] =
            add_accessor(indices.data(), indices.size(), 1, gltf::kUnsigned, gltf::kIndexBuffer);
        primitive["material"] = static_cast<int>(part.material);
        json names = json::array();
        add_targets(part, primitive, names);
        json mesh = {
            {"name", part.name},
            {"extras",
             {{"targetNames", names}, {"drive", gltf::kDriveNames[static_cast<std::size_t>(part.drive)]}}}};
        if (!names.empty()) mesh["weights"] = std::vector<double>(names.size(), 0.0);
        mesh["primitives"] = only(std::move(primitive));
        json_["meshes"].push_back(std::move(mesh));
        json_["nodes"].push_back({{"name", part.name}, {"mesh", json_["meshes"].size() - 1}});
        json_["nodes"][0]["children"].push_back(json_["nodes"].size() - 1);
    }

    void add_targets(const FacePart& part, json& primitive, json& names) {
        const auto add = [&](const std::string& name, const FloatRows& delta) {
            if (delta.size() == 0 || delta.cwiseAbs().maxCoeff() < kLeastMove) return;
            primitive["targets"].push_back({{"POSITION", add_rows(delta, gltf::kVertexBuffer, true)}});
            names.push_back(name);
        };
        for (Eigen::Index k = 0; k < face_.modes.cols(); ++k) {
            const Eigen::VectorXd mode = face_.modes.col(k) * std::sqrt(face_.mode_variance(k));
            const Eigen::Map<const Nodes> delta(mode.data(), face_.rest.rows(), 3);
            add(mode_name(k), delta.middleRows(part.first_node, part.nodes).cast<float>());
        }
        for (const NamedShape& shape : face_.shapes)
            add(shape.name, shape.delta.middleRows(part.first_node, part.nodes).cast<float>());
    }

    static std::string mode_name(Eigen::Index k) { return "mode_" + std::to_string(k + 1); }

    json extras() {
        const std::vector<std::uint32_t> weld(face_.weld.begin(), face_.weld.end());
        json shapes = json::array();
        for (const NamedShape& shape : face_.shapes) shapes.push_back(shape.name);
        return {{"format", gltf::kFormat},
                {"units", "mm, head frame: x to the talker's left, y up, z forward"},
                {"weld", add_accessor(weld.data(), weld.size(), 1, gltf::kUnsigned, 0)},
                {"mean", add_numbers(face_.mean)},
                {"mode_variance", add_numbers(face_.mode_variance)},
                {"shapes", shapes},
                {"lips_first_node", face_.lips.first_node},
                {"jaw_hinge", {face_.jaw_hinge.x(), face_.jaw_hinge.y(), face_.jaw_hinge.z()}}};
    }

    Bytes packed() const {
        std::string text = json_.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        Bytes bin = bin_;
        bin.resize((bin.size() + 3) / 4 * 4, 0);
        ByteWriter out;
        out.put(gltf::kMagic);
        out.put(gltf::kVersion);
        out.put(static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + bin.size()));
        out.put(static_cast<std::uint32_t>(text.size()));
        out.put(gltf::kJsonChunk);
        out.put_text(text);
        out.put(static_cast<std::uint32_t>(bin.size()));
        out.put(gltf::kBinChunk);
        out.put_bytes(bin);
        return out.bytes();
    }

    const Face& face_;
    const Nodes normals_;
    json json_;
    Bytes bin_;
};

}  // namespace

Bytes write_glb(const Face& face, const std::string& copyright) { return Writer(face).write(copyright); }

}  // namespace viaface

#include "facemodel/ply.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "facemodel/scan_words.hpp"

namespace viaface {
namespace {

enum class Type { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

const std::map<std::string, Type>& type_names() {
    static const std::map<std::string, Type> names = {
        {"char", Type::kInt8},     {"int8", Type::kInt8},     {"uchar", Type::kUint8},
        {"uint8", Type::kUint8},   {"short", Type::kInt16},   {"int16", Type::kInt16},
        {"ushort", Type::kUint16}, {"uint16", Type::kUint16}, {"int", Type::kInt32},
        {"int32", Type::kInt32},   {"uint", Type::kUint32},   {"uint32", Type::kUint32},
        {"float", Type::kFloat},   {"float32", Type::kFloat}, {"double", Type::kDouble},
        {"float64", Type::kDouble}};
    return names;
}

struct Property {
    std::string name;
    Type type = Type::kFloat;
    std::optional<Type> count;  // of a list
};

struct Element {
    std::string name;
    std::size_t count = 0;
    std::vector<Property> properties;
};

class PlyParser {
  public:
    explicit PlyParser(std::span<const std::uint8_t> bytes) : words_(bytes) {}

    ScanMesh parse() {
        read_header();
        for (const Element& element : elements_) {
            if (element.name == "vertex") {
                read_nodes(element);
            } else {
                read_polygons(element);
            }
        }
        if (mesh_.uv_triangles.empty() && mesh_.uvs.rows() == mesh_.nodes.rows()) share_uvs_with_nodes(mesh_);
        if (!wedge_uvs_.empty()) {
            mesh_.uvs = Eigen::Map<const decltype(mesh_.uvs)>(
                wedge_uvs_.data(), static_cast<Eigen::Index>(wedge_uvs_.size() / 2), 2);
        }
        check(mesh_);
        return std::move(mesh_);
    }

  private:
    void read_header() {
        if (words_.line() != "ply") words_.fail("no \"ply\"", "\"ply\" on the first line");
        for (std::string_view text = words_.line(); text != "end_header"; text = words_.line()) {
            ScanWords line({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
            if (!line.at_end()) read_header_line(line);
        }
        if (!order_known_) words_.fail("no \"format\" line", "a format");
    }

    void read_header_line(ScanWords& line) {
        const std::string key(line.word());
        if (key == "format") read_format(std::string(line.word()));
        if (key == "element") add_element(line);
        if (key == "property") add_property(line);
        if (key == "comment" && line.next_is("TextureFile")) {
            line.word();
            if (!line.at_end()) mesh_.pictures.emplace_back(line.word());
        }
    }

    void read_format(const std::string& name) {
        text_ = name == "ascii";
        order_ = name == "binary_big_endian" ? std::endian::big : std::endian::little;
        order_known_ = text_ || order_ == std::endian::big || name == "binary_little_endian";
        if (!order_known_) words_.fail(name, "ascii, binary_little_endian or binary_big_endian");
    }

    void add_element(ScanWords& line) {
        Element element;
        element.name = line.word();
        element.count = static_cast<std::size_t>(line.whole(0, static_cast<long>(kLargestScanTriangles)));
        if (elements_.size() >= 32) words_.fail(element.name, "at most 32 elements");
        if (element.name == "vertex" && element.count > kLargestScanNodes)
            words_.fail(std::to_string(element.count) + " nodes",
                        "at most " + std::to_string(kLargestScanNodes));
        elements_.push_back(std::move(element));
    }

    Type type_of(std::string_view name) const {
        const auto found = type_names().find(std::string(name));
        if (found == type_names().end()) words_.fail(std::string(name), "a type of PLY");
        return found->second;
    }

    void add_property(ScanWords& line) {
        if (elements_.empty()) words_.fail("a property", "after its element");
        Property property;
        const std::string first(line.word());
        if (first == "list") property.count = type_of(line.word());
        property.type = type_of(first == "list" ? line.word() : std::string_view(first));
        property.name = line.word();
        if (elements_.back().properties.size() >= 256) words_.fail(property.name, "at most 256 properties");
        elements_.back().properties.push_back(std::move(property));
    }

    template <class T>
    double in_order() {
        return static_cast<double>(words_.binary<T>(order_));
    }

    double value(Type type) {
        if (text_) return words_.number();
        switch (type) {
            case Type::kInt8:
                return in_order<std::int8_t>();
            case Type::kUint8:
                return in_order<std::uint8_t>();
            case Type::kInt16:
                return in_order<std::int16_t>();
            case Type::kUint16:
                return in_order<std::uint16_t>();
            case Type::kInt32:
                return in_order<std::int32_t>();
            case Type::kUint32:
                return in_order<std::uint32_t>();
            case Type::kFloat:
                return in_order<float>();
            case Type::kDouble:
                break;
        }
        return in_order<double>();
    }

    std::vector<double> values(const Property& property) {
        if (!property.count) return {value(property.type)};
        const double count = value(*property.count);
        if (!(count >= 0 && count <= static_cast<double>(words_.left())) || count != std::floor(count))
            words_.fail(std::to_string(count), "the length of a list that the file holds");
        std::vector<double> list(static_cast<std::size_t>(count));
        for (double& item : list) item = value(property.type);
        return list;
    }

    void read_nodes(const Element& element) {
        static const std::map<std::string, int> columns = {
            {"x", 0}, {"y", 1},         {"z", 2},         {"s", 3},   {"t", 4},     {"u", 3},
            {"v", 4}, {"texture_u", 3}, {"texture_v", 4}, {"red", 5}, {"green", 6}, {"blue", 7}};
        std::vector<int> to;
        std::array<bool, 8> has{};
        for (const Property& p : element.properties) {
            const auto found = columns.find(p.name);
            to.push_back(found == columns.end() || p.count ? -1 : found->second);
            if (to.back() >= 0) has[static_cast<std::size_t>(to.back())] = true;
        }
        if (!(has[0] && has[1] && has[2])) words_.fail("vertex without x, y, z", "all three");
        if (element.count > words_.left()) words_.fail("the end of the file", "every node that is announced");
        mesh_.nodes.resize(static_cast<Eigen::Index>(element.count), 3);
        if (has[3] && has[4]) mesh_.uvs.resize(static_cast<Eigen::Index>(element.count), 2);
        if (has[5] && has[6] && has[7]) mesh_.colours.resize(element.count);
        for (std::size_t i = 0; i < element.count; ++i) read_node(element, to, static_cast<Eigen::Index>(i));
    }

    void read_node(const Element& element, const std::vector<int>& to, Eigen::Index node) {
        std::array<double, 8> found{};
        for (std::size_t k = 0; k < to.size(); ++k) {
            const auto list = values(element.properties[k]);
            if (to[k] >= 0) found[static_cast<std::size_t>(to[k])] = list[0];
        }
        mesh_.nodes.row(node) << found[0], found[1], found[2];
        if (mesh_.uvs.rows() > 0) mesh_.uvs.row(node) << found[3], found[4];
        if (mesh_.colours.empty()) return;
        for (std::size_t k = 0; k < 3; ++k)
            mesh_.colours[static_cast<std::size_t>(node)][k] =
                static_cast<std::uint8_t>(std::clamp(found[5 + k], 0.0, 255.0));
    }

    void read_polygons(const Element& element) {
        for (std::size_t i = 0; i < element.count; ++i) {
            std::vector<double> corners, uvs;
            for (const Property& p : element.properties) {
                auto list = values(p);
                if (p.name == "vertex_indices" || p.name == "vertex_index") corners = std::move(list);
                if (p.name == "texcoord") uvs = std::move(list);
            }
            if (element.properties.empty()) return;
            if (element.name == "face") add_face(corners, uvs);
            if (element.name == "tristrips") add_strips(corners);
        }
    }

    int index(double value) const {
        if (!(value >= 0 && value < static_cast<double>(mesh_.nodes.rows())))
            words_.fail("node " + std::to_string(value), "0 to the count of nodes less one");
        return static_cast<int>(value);
    }

    void add_face(const std::vector<double>& corners, const std::vector<double>& uvs) {
        std::vector<int> nodes, places;
        for (const double corner : corners) nodes.push_back(index(corner));
        if (nodes.size() < 3) words_.fail(std::to_string(nodes.size()) + " corners", "three or more");
        if (uvs.size() == 2 * nodes.size()) {
            for (std::size_t k = 0; k < nodes.size(); ++k)
                places.push_back(static_cast<int>(wedge_uvs_.size() / 2 + k));
            wedge_uvs_.insert(wedge_uvs_.end(), uvs.begin(), uvs.end());
        }
        add_polygon(mesh_, nodes, places);
        if (mesh_.triangles.size() > kLargestScanTriangles)
            words_.fail("more triangles", "at most " + std::to_string(kLargestScanTriangles));
    }

    void add_strips(const std::vector<double>& corners) {
        std::vector<int> strip;
        for (const double corner : corners) {
            if (corner >= 0) {
                strip.push_back(index(corner));
                continue;
            }
            add_strip(mesh_, strip);
            strip.clear();
        }
        add_strip(mesh_, strip);
    }

    ScanWords words_;
    bool text_ = false, order_known_ = false;
    std::endian order_ = std::endian::little;
    std::vector<Element> elements_;
    std::vector<double> wedge_uvs_;
    ScanMesh mesh_;
};

}  // namespace

ScanMesh parse_ply(std::span<const std::uint8_t> bytes) { return PlyParser(bytes).parse(); }

}  // namespace viaface

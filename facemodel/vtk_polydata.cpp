#include "facemodel/vtk_polydata.hpp"

#include <cmath>
#include <map>

#include "facemodel/scan_words.hpp"

namespace viaface {
namespace {

// Size in bytes of a value, and whether it is a floating-point number.
struct Type {
    std::size_t size;
    bool real, negative;
};

const std::map<std::string, Type>& type_names() {
    static const std::map<std::string, Type> names = {
        {"char", {1, false, true}},         {"unsigned_char", {1, false, false}},
        {"short", {2, false, true}},        {"unsigned_short", {2, false, false}},
        {"int", {4, false, true}},          {"unsigned_int", {4, false, false}},
        {"long", {8, false, true}},         {"unsigned_long", {8, false, false}},
        {"float", {4, true, true}},         {"double", {8, true, true}},
        {"vtktypeint64", {8, false, true}}, {"vtkidtype", {4, false, true}},
        {"vtktypeint32", {4, false, true}}, {"vtktypeuint8", {1, false, false}},
        {"signed_char", {1, false, true}},  {"vtktypeuint64", {8, false, false}}};
    return names;
}

class VtkParser {
  public:
    explicit VtkParser(std::span<const std::uint8_t> bytes) : words_(bytes) {}

    ScanMesh parse() {
        read_head();
        while (!words_.at_end()) read_section();
        if (mesh_.uvs.rows() > 0 && mesh_.uvs.rows() == mesh_.nodes.rows()) share_uvs_with_nodes(mesh_);
        check(mesh_);
        return std::move(mesh_);
    }

  private:
    void read_head() {
        if (!words_.line().starts_with("# vtk DataFile Version "))
            words_.fail("another first line", "\"# vtk DataFile Version ...\"");
        words_.line();
        const std::string kind = lower(words_.word());
        if (kind != "ascii" && kind != "binary") words_.fail(kind, "ASCII or BINARY");
        text_ = kind == "ascii";
        if (lower(words_.word()) != "dataset") words_.fail("no DATASET", "DATASET POLYDATA");
        const std::string set(words_.word());
        if (lower(set) != "polydata") words_.fail("DATASET " + set, "DATASET POLYDATA");
    }

    void read_section() {
        const std::string key = lower(words_.word());
        if (key == "points") return read_points();
        if (key == "polygons") return read_cells(&VtkParser::add_face);
        if (key == "triangle_strips") return read_cells(&VtkParser::add_strip_of);
        if (key == "vertices" || key == "lines") return read_cells(nullptr);
        if (key == "point_data" || key == "cell_data") return begin_attributes(key == "point_data");
        if (key == "metadata") return skip_metadata();
        read_attribute(key);
    }

    std::size_t count(std::size_t most = kLargestScanTriangles) {
        return static_cast<std::size_t>(words_.whole(0, static_cast<long>(most)));
    }

    Type type() {
        const std::string name = lower(words_.word());
        const auto found = type_names().find(name);
        if (found == type_names().end()) words_.fail(name, "a data type of VTK");
        return found->second;
    }

    void begin_values() {  // binary values begin on the line after the keyword's
        if (!text_) words_.line();
    }

    double value(const Type& type) {
        if (text_) return words_.number();
        if (type.real) return type.size == 4 ? big<float>() : big<double>();
        switch (type.size) {
            case 1:
                return type.negative ? big<std::int8_t>() : big<std::uint8_t>();
            case 2:
                return type.negative ? big<std::int16_t>() : big<std::uint16_t>();
            case 4:
                return type.negative ? big<std::int32_t>() : big<std::uint32_t>();
            default:
                return type.negative ? big<std::int64_t>() : big<std::uint64_t>();
        }
    }
    template <class T>
    double big() {
        return static_cast<double>(words_.binary<T>(std::endian::big));
    }

    void need(std::size_t values, const Type& type) {
        const std::size_t least = text_ ? 2 * values - (values > 0) : values * type.size;
        if (least > words_.left())
            words_.fail("the end of the file", std::to_string(values) + " more values");
    }

    void skip(std::size_t values, const Type& type) {
        need(values, type);
        if (text_) {
            words_.skip_words(values);
        } else {
            words_.take(values * type.size);
        }
    }

    void read_points() {
        if (mesh_.nodes.rows() > 0) words_.fail("POINTS again", "once");
        const std::size_t points = count(kLargestScanNodes);
        const Type kind = type();
        begin_values();
        need(3 * points, kind);
        mesh_.nodes.resize(static_cast<Eigen::Index>(points), 3);
        for (Eigen::Index i = 0; i < mesh_.nodes.size(); ++i) mesh_.nodes.data()[i] = value(kind);
    }

    using AddCell = void (VtkParser::*)(const std::vector<int>&);

    void read_cells(AddCell add) {
        const std::size_t first = count(), second = count(4 * kLargestScanTriangles);
        begin_values();
        if (words_.next_is("OFFSETS")) return read_cells_by_offset(first, second, add);
        const Type kind{4, false, true};
        need(second, kind);
        std::size_t used = 0;
        for (std::size_t cell = 0; cell < first; ++cell) {
            const std::size_t corners = corner_count(value(kind), second - used);
            used += corners + 1;
            std::vector<int> nodes(corners);
            for (int& node : nodes) node = index(value(kind));
            if (add) (this->*add)(nodes);
        }
    }

    std::size_t corner_count(double corners, std::size_t left) const {
        if (!(corners >= 1 && corners < static_cast<double>(left)) || corners != std::floor(corners))
            words_.fail(std::to_string(corners) + " corners", "as many as the section announces");
        return static_cast<std::size_t>(corners);
    }

    int index(double node) const {
        if (!(node >= 0 && node < static_cast<double>(mesh_.nodes.rows())) || node != std::floor(node))
            words_.fail("node " + std::to_string(node),
                        "0 to " + std::to_string(mesh_.nodes.rows() - 1) + ", points before cells");
        return static_cast<int>(node);
    }

    void read_cells_by_offset(std::size_t offsets, std::size_t corners, AddCell add) {
        words_.word();
        const auto ends = array(offsets);
        if (lower(words_.word()) != "connectivity") words_.fail("no CONNECTIVITY", "CONNECTIVITY");
        const auto nodes = array(corners);
        for (std::size_t cell = 0; cell + 1 < ends.size(); ++cell) {
            if (!(ends[cell] >= 0 && ends[cell] <= ends[cell + 1] &&
                  ends[cell + 1] <= static_cast<double>(nodes.size())))
                words_.fail("offset " + std::to_string(ends[cell + 1]), "rising offsets into CONNECTIVITY");
            std::vector<int> corner;
            for (auto k = static_cast<std::size_t>(ends[cell]); k < static_cast<std::size_t>(ends[cell + 1]);
                 ++k)
                corner.push_back(index(nodes[k]));
            if (add) (this->*add)(corner);
        }
    }

    std::vector<double> array(std::size_t values) {
        const Type kind = type();
        begin_values();
        need(values, kind);
        std::vector<double> list(values);
        for (double& item : list) item = value(kind);
        return list;
    }

    void add_face(const std::vector<int>& nodes) { add_polygon(mesh_, nodes, {}); }
    void add_strip_of(const std::vector<int>& nodes) { add_strip(mesh_, nodes); }

    void begin_attributes(bool of_points) {
        of_points_ = of_points;
        items_ = count();
    }

    void skip_metadata() {
        words_.line();
        while (words_.left() > 0 && !words_.line().empty()) {
        }
    }

    void read_attribute(const std::string& key) {
        const std::string name(words_.word());
        if (key == "texture_coordinates") return read_uvs();
        if (key == "normals" || key == "vectors") return skip_typed(3);
        if (key == "tensors") return skip_typed(9);
        if (key == "scalars") return skip_scalars();
        if (key == "color_scalars")
            return skip_values(items_ * count(16), text_ ? Type{4, true, true} : Type{1, false, false});
        if (key == "lookup_table")
            return skip_values(4 * count(), text_ ? Type{4, true, true} : Type{1, false, false});
        if (key == "field") return skip_field();
        words_.fail(key, "a section of polydata");
    }

    void skip_values(std::size_t values, const Type& kind) {
        begin_values();
        skip(values, kind);
    }

    void skip_typed(std::size_t each) {
        const Type kind = type();
        skip_values(each * items_, kind);
    }

    void skip_scalars() {
        const Type kind = type();
        std::size_t each = 1;
        if (!words_.next_is("LOOKUP_TABLE")) each = count(4);
        if (words_.next_is("LOOKUP_TABLE")) words_.skip_words(2);
        skip_values(each * items_, kind);
    }

    void skip_field() {
        const std::size_t arrays = count(4096);
        for (std::size_t k = 0; k < arrays; ++k) {
            if (words_.next_is("METADATA")) {
                words_.word();
                skip_metadata();
            }
            words_.word();
            const std::size_t each = count(4096), tuples = count();
            const Type kind = type();
            skip_values(each * tuples, kind);
        }
    }

    void read_uvs() {
        const std::size_t each = count(3);
        const Type kind = type();
        begin_values();
        need(each * items_, kind);
        const bool kept = of_points_ && each >= 2;
        if (kept) mesh_.uvs.resize(static_cast<Eigen::Index>(items_), 2);
        for (std::size_t i = 0; i < items_; ++i) {
            for (std::size_t k = 0; k < each; ++k) {
                const double number = value(kind);
                if (kept && k < 2)
                    mesh_.uvs(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = number;
            }
        }
    }

    ScanWords words_;
    bool text_ = false, of_points_ = false;
    std::size_t items_ = 0;
    ScanMesh mesh_;
};

}  // namespace

ScanMesh parse_vtk(std::span<const std::uint8_t> bytes) { return VtkParser(bytes).parse(); }

}  // namespace viaface

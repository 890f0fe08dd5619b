#include "facemodel/obj.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.hpp"
#include "base/whole_file.hpp"

namespace viaface {
namespace {

constexpr std::size_t kLargestFile = 1u << 30;

class ObjParser {
  public:
    explicit ObjParser(std::string_view text) : text_(text) {}

    ObjScan parse() {
        while (!text_.empty()) read_line();
        if (positions_.empty()) throw InputError("scan", "no \"v\" lines", "an OBJ file with nodes");
        scan_.nodes =
            Eigen::Map<const Nodes>(positions_.data(), static_cast<Eigen::Index>(positions_.size() / 3), 3);
        scan_.uvs =
            Eigen::Map<const decltype(scan_.uvs)>(uvs_.data(), static_cast<Eigen::Index>(uvs_.size() / 2), 2);
        check_indices();
        return std::move(scan_);
    }

  private:
    void read_line() {
        const std::size_t end = std::min(text_.find('\n'), text_.size());
        rest_ = text_.substr(0, end);
        text_.remove_prefix(std::min(end + 1, text_.size()));
        ++line_;
        const std::string_view key = word();
        if (key == "v") read_numbers(positions_, 3);
        if (key == "vt") read_numbers(uvs_, 2);
        if (key == "f") read_face();
        if (key == "usemtl") use_material(word());
        if (key == "mtllib") scan_.libraries.emplace_back(word());
    }

    std::string_view word() {
        const auto first = std::min(rest_.find_first_not_of(" \t\r"), rest_.size());
        rest_.remove_prefix(first);
        const auto length = std::min(rest_.find_first_of(" \t\r"), rest_.size());
        const std::string_view found = rest_.substr(0, length);
        rest_.remove_prefix(length);
        return found;
    }

    void read_numbers(std::vector<double>& to, int count) {
        for (int i = 0; i < count; ++i) {
            const std::string_view text = word();
            double value = 0;
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
            if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
                fail(text, "a finite number");
            to.push_back(value);
        }
    }

    int read_index(std::string_view text, std::size_t count) {
        long value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc() || end != text.data() + text.size()) fail(text, "an index");
        const long index = value < 0 ? static_cast<long>(count) + value : value - 1;
        if (value == 0 || index < 0 || index > 100'000'000) fail(text, "an index of an earlier line");
        return static_cast<int>(index);
    }

    void read_face() {
        std::vector<std::array<int, 2>> corners;
        for (std::string_view corner = word(); !corner.empty(); corner = word()) {
            const auto slash = corner.find('/');
            const int node = read_index(corner.substr(0, slash), positions_.size() / 3);
            int uv = -1;
            if (slash != std::string_view::npos) {
                const std::string_view tail = corner.substr(slash + 1);
                const std::string_view middle = tail.substr(0, tail.find('/'));
                if (!middle.empty()) uv = read_index(middle, uvs_.size() / 2);
            }
            corners.push_back({node, uv});
        }
        if (corners.size() < 3) fail(std::to_string(corners.size()) + " corners", "three or more corners");
        add_fan(corners);
    }

    void add_fan(const std::vector<std::array<int, 2>>& corners) {
        if (corners.size() == 4) return add_face({corners[0], corners[1], corners[2], corners[3]});
        for (std::size_t k = 2; k < corners.size(); ++k)
            add_face({corners[0], corners[k - 1], corners[k], {-1, -1}});
    }

    void add_face(const std::array<std::array<int, 2>, 4>& corners) {
        ObjFace face;
        face.material = material_;
        for (std::size_t k = 0; k < 4; ++k) {
            face.nodes[k] = corners[k][0];
            face.uvs[k] = corners[k][1];
        }
        scan_.faces.push_back(face);
    }

    void use_material(std::string_view name) {
        auto& names = scan_.materials;
        const auto found = std::find(names.begin(), names.end(), name);
        material_ = static_cast<int>(found - names.begin());
        if (found == names.end()) names.emplace_back(name);
    }

    void check_indices() const {
        for (const ObjFace& face : scan_.faces) {
            for (std::size_t k = 0; k < 4; ++k) {
                if (face.nodes[k] >= scan_.nodes.rows() || face.uvs[k] >= scan_.uvs.rows()) {
                    throw InputError("scan",
                                     "a face with node " + std::to_string(face.nodes[k] + 1) + ", uv " +
                                         std::to_string(face.uvs[k] + 1),
                                     "indices up to the count of \"v\" and \"vt\" lines");
                }
            }
        }
    }

    [[noreturn]] void fail(std::string_view value, const std::string& allowed) const {
        throw InputError("scan", "line " + std::to_string(line_) + ": " + std::string(value), allowed);
    }

    std::string_view text_, rest_;
    std::size_t line_ = 0;
    int material_ = -1;
    std::vector<double> positions_, uvs_;
    ObjScan scan_;
};

}  // namespace

ObjScan parse_obj(std::string_view text) { return ObjParser(text).parse(); }

std::map<std::string, std::string> parse_mtl(std::string_view text) {
    std::map<std::string, std::string> pictures;
    std::string material;
    while (!text.empty()) {
        std::string_view line = text.substr(0, text.find_first_of("\r\n"));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
        line.remove_prefix(std::min(line.size(), line.find_first_not_of(" \t")));
        if (line.starts_with("newmtl ")) material = line.substr(7);
        if (line.starts_with("map_Kd ")) pictures[material] = line.substr(line.find_last_of(" \t") + 1);
    }
    return pictures;
}

ObjScan read_obj(const std::filesystem::path& path) {
    try {
        return parse_obj(read_text(path, "scan", kLargestFile));
    } catch (const InputError& error) {
        throw InputError(error.field(), path.filename().string() + ": " + error.value(), error.allowed());
    }
}

}  // namespace viaface

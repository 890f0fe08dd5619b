#include "synth/motion/npy.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>

#include "base/error.hpp"
#include "viapoints/cells.hpp"

namespace viaface {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr std::size_t kLongestHeader = 65536;
static_assert(std::endian::native == std::endian::little);

struct Header {
    std::string_view kind;  // "<f8"
    bool columns_first = false;
    std::size_t rows = 0, columns = 0;
};

class Reader {
  public:
    Reader(std::span<const std::uint8_t> bytes, const std::string& field) : bytes_(bytes), field_(field) {}

    RowMatrix table() const {
        const std::string_view text = header_text();
        const Header header{quoted(value_of(text, "descr")), is_true(value_of(text, "fortran_order")), 0, 0};
        const auto [rows, columns] = shape(value_of(text, "shape"));
        const std::size_t size = number_size(header.kind);
        const std::size_t left = bytes_.size() - data_at(text);
        if (columns != 0 && (rows > left / size / columns || rows * columns * size != left))
            fail(std::to_string(left) + " bytes of numbers", std::to_string(rows) + " x " +
                                                                 std::to_string(columns) + " of " +
                                                                 std::to_string(size) + " bytes");
        return numbers({header.kind, header.columns_first, rows, columns}, data_at(text), size);
    }

  private:
    [[noreturn]] void fail(const std::string& value, const std::string& allowed) const {
        throw InputError(field_, value, allowed);
    }

    std::string_view header_text() const {
        if (!is_npy(bytes_) || bytes_.size() < 12) fail("no NumPy file", "a whole file of NumPy");
        const std::size_t major = bytes_[6];
        if (major < 1 || major > 3) fail("version " + std::to_string(major), "versions 1 to 3");
        const std::size_t wide = major == 1 ? 2 : 4, start = 8 + wide;
        std::size_t length = 0;
        for (std::size_t i = 0; i < wide; ++i) length |= std::size_t{bytes_[8 + i]} << (8 * i);
        if (length > kLongestHeader || length > bytes_.size() - start)
            fail("a header of " + std::to_string(length) + " bytes", "a whole header up to 65536 bytes");
        return {reinterpret_cast<const char*>(bytes_.data() + start), length};
    }

    std::size_t data_at(std::string_view header) const {
        const auto* data = reinterpret_cast<const std::uint8_t*>(header.data() + header.size());
        return static_cast<std::size_t>(data - bytes_.data());
    }

    // What stands behind 'name': in the header.
    std::string_view value_of(std::string_view header, const std::string& name) const {
        const std::size_t at = header.find("'" + name + "':");
        if (at == header.npos) fail("a header without " + name, "descr, fortran_order and shape");
        return trimmed(header.substr(at + name.size() + 3));
    }

    std::string_view quoted(std::string_view value) const {
        if (value.size() < 2 || value.front() != '\'') fail("a header of another kind", "'<f8' or '<f4'");
        return value.substr(1, value.find('\'', 1) - 1);
    }

    bool is_true(std::string_view value) const {
        if (value.starts_with("True")) return true;
        if (!value.starts_with("False")) fail("fortran_order", "True or False");
        return false;
    }

    std::pair<std::size_t, std::size_t> shape(std::string_view value) const {
        const std::string_view inside = value.substr(0, value.find(')'));
        std::vector<std::size_t> sides;
        for (std::string_view cell : cells_of(inside.substr(std::min<std::size_t>(1, inside.size())), ',')) {
            if (cell.ends_with('L')) cell.remove_suffix(1);
            if (cell.empty()) continue;
            std::size_t side = 0;
            const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), side);
            if (error != std::errc() || end != cell.data() + cell.size()) sides.clear();
            sides.push_back(side);
        }
        if (sides.size() != 2 || sides[0] == 0 || sides[1] == 0)
            fail("shape " + std::string(inside), "(rows, columns)");
        return {sides[0], sides[1]};
    }

    std::size_t number_size(std::string_view kind) const {
        if (kind == "<f8" || kind == ">f8") return 8;
        if (kind != "<f4" && kind != ">f4")
            fail(std::string(kind), "floats of 4 or 8 bytes: <f4, <f8, >f4, >f8");
        return 4;
    }

    RowMatrix numbers(const Header& header, std::size_t start, std::size_t size) const {
        RowMatrix table(static_cast<Eigen::Index>(header.rows), static_cast<Eigen::Index>(header.columns));
        for (std::size_t k = 0; k < header.rows * header.columns; ++k) {
            const std::size_t row = header.columns_first ? k % header.rows : k / header.columns,
                              column = header.columns_first ? k / header.rows : k % header.columns;
            table(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) =
                number(bytes_.subspan(start + k * size, size), header.kind.front() == '>');
        }
        return table;
    }

    static double number(std::span<const std::uint8_t> bytes, bool backwards) {
        std::uint8_t raw[8] = {};
        std::copy(bytes.begin(), bytes.end(), raw);
        if (backwards) std::reverse(raw, raw + bytes.size());
        float single = 0;
        double value = 0;
        if (bytes.size() == sizeof single) {
            std::memcpy(&single, raw, sizeof single);
            return single;
        }
        std::memcpy(&value, raw, sizeof value);
        return value;
    }

    std::span<const std::uint8_t> bytes_;
    const std::string& field_;
};

}  // namespace

bool is_npy(std::span<const std::uint8_t> bytes) {
    return bytes.size() >= 8 &&
           std::equal(kMagic.begin(), kMagic.end(), bytes.begin(),
                      [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

RowMatrix parse_npy(std::span<const std::uint8_t> bytes, const std::string& field) {
    return Reader(bytes, field).table();
}

}  // namespace viaface

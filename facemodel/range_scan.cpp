#include "facemodel/range_scan.hpp"

#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "facemodel/scan_words.hpp"

namespace viaface {
namespace {

long header_number(ScanWords& words, long low, long high) {
    while (words.next_is("#")) words.line();
    return words.whole(low, high);
}

// A quad between samples, or nothing where one is missing or the surface is torn.
void add_cell(ScanMesh& mesh, const RangePicture& picture, const std::vector<int>& index, int column,
              int next, int row, double largest_jump) {
    const auto at = [&](int c, int r) { return static_cast<std::size_t>(r) * picture.columns + c; };
    const std::size_t corners[4] = {at(column, row + 1), at(next, row + 1), at(next, row), at(column, row)};
    double least = 1e300, greatest = 0;
    std::vector<int> nodes, uvs;
    for (int k = 0; k < 4; ++k) {
        if (index[corners[k]] < 0) return;
        const double value = picture.values[corners[k]];
        least = std::min(least, value);
        greatest = std::max(greatest, value);
        nodes.push_back(index[corners[k]]);
        const int uv_column = next < column && (k == 1 || k == 2) ? picture.columns
                              : k == 0 || k == 3                  ? column
                                                                  : next;
        uvs.push_back((k < 2 ? row + 1 : row) * (picture.columns + 1) + uv_column);
    }
    if (greatest - least <= largest_jump * greatest) add_polygon(mesh, nodes, uvs);
}

}  // namespace

RangePicture parse_pgm(std::span<const std::uint8_t> bytes) {
    ScanWords words(bytes);
    if (words.word() != "P5") words.fail("no \"P5\"", "a binary PGM");
    RangePicture picture;
    picture.columns = static_cast<int>(header_number(words, 2, kLargestRangeSide));
    picture.rows = static_cast<int>(header_number(words, 2, kLargestRangeSide));
    const long greatest = header_number(words, 1, 65535);
    words.take(1);
    picture.values.resize(static_cast<std::size_t>(picture.columns) * picture.rows);
    if (words.left() < picture.values.size() * (greatest > 255 ? 2 : 1))
        words.fail("the end of the file", "every sample that is announced");
    for (auto& value : picture.values) {
        value = greatest > 255 ? words.binary<std::uint16_t>(std::endian::big)
                               : words.binary<std::uint8_t>(std::endian::big);
    }
    return picture;
}

ScanMesh range_surface(const RangePicture& picture, const RangeLayout& layout) {
    const double turn = layout.angle_to_deg - layout.angle_from_deg;
    if (!(layout.step > 0)) throw InputError("scans.json", "step", "a number above 0");
    if (!(layout.top > layout.bottom)) throw InputError("scans.json", "top", "a number above \"bottom\"");
    if (!(std::abs(turn) > 1 && std::abs(turn) <= 360.0001))
        throw InputError("scans.json", "angle_to_deg", "1 to 360 degrees from angle_from_deg");
    ScanMesh mesh;
    std::vector<int> index(picture.values.size(), -1);
    std::vector<double> places;
    for (int row = 0; row < picture.rows; ++row) {
        for (int column = 0; column < picture.columns; ++column) {
            const std::size_t at = static_cast<std::size_t>(row) * picture.columns + column;
            if (picture.values[at] == 0) continue;
            const double r = layout.step * picture.values[at];
            const double angle =
                (layout.angle_from_deg + turn * (column + 0.5) / picture.columns) * std::numbers::pi / 180;
            index[at] = static_cast<int>(places.size() / 3);
            places.insert(
                places.end(),
                {r * std::sin(angle), layout.top - (layout.top - layout.bottom) * (row + 0.5) / picture.rows,
                 r * std::cos(angle)});
        }
    }
    mesh.nodes = Eigen::Map<const Nodes>(places.data(), static_cast<Eigen::Index>(places.size() / 3), 3);
    mesh.uvs.resize(static_cast<Eigen::Index>(picture.rows) * (picture.columns + 1), 2);
    for (int row = 0; row < picture.rows; ++row) {
        for (int column = 0; column <= picture.columns; ++column)
            mesh.uvs.row(row * (picture.columns + 1) + column) << (column + 0.5) / picture.columns,
                1 - (row + 0.5) / picture.rows;
    }
    const bool closed = std::abs(std::abs(turn) - 360) < 1e-3;
    for (int row = 0; row + 1 < picture.rows; ++row) {
        for (int column = 0; column + (closed ? 0 : 1) < picture.columns; ++column)
            add_cell(mesh, picture, index, column, (column + 1) % picture.columns, row, layout.largest_jump);
    }
    if (turn < 0) {
        for (auto* triangles : {&mesh.triangles, &mesh.uv_triangles}) {
            for (Triangle& t : *triangles) std::swap(t[1], t[2]);
        }
    }
    check(mesh);
    return mesh;
}

}  // namespace viaface

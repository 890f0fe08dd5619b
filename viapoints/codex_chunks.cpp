#include "viapoints/codex_chunks.hpp"

#include <algorithm>

#include "viapoints/layout.hpp"

namespace viaface::codex_chunks {
namespace {

void put_name(ByteWriter& writer, std::string_view name) {
    writer.put(static_cast<std::uint8_t>(name.size()));
    writer.put_text(name);
}

std::string take_name(ByteReader& reader) {
    const auto name = reader.take(reader.get<std::uint8_t>());
    return {name.begin(), name.end()};
}

void put_all(ByteWriter& writer, const auto& values) {
    for (Eigen::Index i = 0; i < values.size(); ++i) writer.put(values.data()[i]);
}

void take_all(ByteReader& reader, auto& values) {
    for (Eigen::Index i = 0; i < values.size(); ++i) values.data()[i] = reader.get<double>();
}

}  // namespace

Bytes put_layout() {
    ByteWriter writer;
    writer.put(static_cast<std::uint16_t>(kPoints));
    for (int p = 0; p < kPoints; ++p) put_name(writer, point_name(p));
    return writer.bytes();
}

void check_layout(ByteReader& reader) {
    const auto count = reader.get<std::uint16_t>();
    demand(count == kPoints, std::to_string(count) + " points, known are " + std::to_string(kPoints), reader);
    for (int p = 0; p < kPoints; ++p) {
        const std::string name = take_name(reader);
        demand(name == point_name(p),
               "point " + std::to_string(p) + " is \"" + name + "\", known is " + std::string(point_name(p)),
               reader);
    }
}

Bytes put_phones() {
    ByteWriter writer;
    writer.put(static_cast<std::uint8_t>(phone_table().size()));
    for (const PhoneInfo& info : phone_table()) put_name(writer, info.name);
    return writer.bytes();
}

std::vector<PhoneId> take_phones(ByteReader& reader) {
    const auto table = phone_table();
    std::vector<PhoneId> ids(reader.get<std::uint8_t>());
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const std::string name = take_name(reader);
        const auto found = std::find_if(table.begin(), table.end(),
                                        [&](const PhoneInfo& info) { return info.name == name; });
        demand(found != table.end(), "phone \"" + name + "\" is not known", reader);
        ids[i] = static_cast<PhoneId>(found - table.begin());
        demand(std::count(ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(i), ids[i]) == 0,
               "phone \"" + name + "\" stands twice", reader);
    }
    return ids;
}

Bytes put_basis(const Codex& codex) {
    ByteWriter writer;
    writer.put(static_cast<std::uint16_t>(codex.rest.size()));
    put_all(writer, codex.basis.mean);
    put_all(writer, codex.basis.modes);
    put_all(writer, codex.rest);
    return writer.bytes();
}

StoredBasis take_basis(ByteReader& reader) {
    const int k = reader.get<std::uint16_t>();
    demand(k >= 1 && k <= kMostComponents, std::to_string(k) + " components, allowed are 1 to 64", reader);
    StoredBasis stored{{{}, Eigen::MatrixXd(kCoordinates, k)}, Eigen::VectorXd(k)};
    take_all(reader, stored.basis.mean);
    take_all(reader, stored.basis.modes);
    take_all(reader, stored.rest);
    return stored;
}

}  // namespace viaface::codex_chunks

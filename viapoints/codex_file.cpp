#include "viapoints/codex_file.hpp"

#include <algorithm>
#include <array>

#include "viapoints/codex_chunks.hpp"
#include "viapoints/via_chunks.hpp"

namespace viaface {
namespace {

using namespace codex_chunks;

constexpr std::size_t kLongestProvenance = 65536;

const ViaChunk* find(const std::vector<ViaChunk>& chunks, std::string_view type) {
    const auto found =
        std::find_if(chunks.begin(), chunks.end(), [&](const ViaChunk& chunk) { return chunk.type == type; });
    return found == chunks.end() ? nullptr : &*found;
}

// The content of one chunk, all of it, by `take`.
auto taken(const std::vector<ViaChunk>& chunks, std::string_view type, const auto& take) {
    const ViaChunk* chunk = find(chunks, type);
    if (!chunk) throw std::runtime_error("codex file: chunk " + std::string(type) + " is missing");
    try {
        ByteReader reader(chunk->content);
        auto result = take(reader);
        demand(reader.left() == 0, "bytes left over", reader);
        return result;
    } catch (const std::exception&) {
        std::throw_with_nested(std::runtime_error("codex file: chunk " + std::string(type) +
                                                  ", content from byte " + std::to_string(chunk->offset)));
    }
}

void check_types(const std::vector<ViaChunk>& chunks) {
    constexpr std::array<std::string_view, 6> kKnown = {"LAYO", "PHON", "BASE", "RECI", "scat", "prov"};
    for (const ViaChunk& chunk : chunks) {
        const std::string where = "codex file: chunk " + std::string(chunk.type) + ", content from byte " +
                                  std::to_string(chunk.offset);
        const bool known = std::find(kKnown.begin(), kKnown.end(), chunk.type) != kKnown.end();
        if (!known && !is_optional(chunk)) throw std::runtime_error(where + ": required, but not known");
        if (known && find(chunks, chunk.type) != &chunk) throw std::runtime_error(where + ": stands twice");
    }
}

std::string provenance_in(const std::vector<ViaChunk>& chunks) {
    const ViaChunk* chunk = find(chunks, "prov");
    if (!chunk) return {};
    if (chunk->content.size() > kLongestProvenance)
        throw std::runtime_error("codex file: chunk prov is over 65536 bytes");
    return {chunk->content.begin(), chunk->content.end()};
}

}  // namespace

Bytes write_codex(const Codex& codex) {
    fits(codex.rest.size() <= kMostComponents, "over 64 components");
    fits(codex.provenance.size() <= kLongestProvenance, "a provenance over 65536 bytes");
    ViaChunkWriter writer(ViaKind::kCodex);
    writer.add("LAYO", put_layout());
    writer.add("PHON", put_phones());
    writer.add("BASE", put_basis(codex));
    writer.add("RECI", put_recitations(codex));
    if (codex.scatter_mm) {
        ByteWriter scatter;
        scatter.put(*codex.scatter_mm);
        writer.add("scat", scatter.bytes());
    }
    const auto* text = reinterpret_cast<const std::uint8_t*>(codex.provenance.data());
    if (!codex.provenance.empty()) writer.add("prov", {text, codex.provenance.size()});
    return writer.finish();
}

Codex read_codex(std::span<const std::uint8_t> bytes) {
    const std::vector<ViaChunk> chunks = read_chunks(bytes, ViaKind::kCodex);
    check_types(chunks);
    taken(chunks, "LAYO", [](ByteReader& reader) { return check_layout(reader), true; });
    const auto ids = taken(chunks, "PHON", take_phones);
    StoredBasis stored = taken(chunks, "BASE", take_basis);
    auto recitations = taken(chunks, "RECI", [&](ByteReader& reader) {
        return take_recitations(reader, stored.rest.size(), ids);
    });
    std::optional<double> scatter_mm;
    if (find(chunks, "scat"))
        scatter_mm = taken(chunks, "scat", [](ByteReader& reader) { return reader.get<double>(); });
    try {
        return make_codex(std::move(stored.basis), std::move(stored.rest), std::move(recitations),
                          provenance_in(chunks), scatter_mm);
    } catch (const std::invalid_argument&) {
        std::throw_with_nested(
            std::runtime_error("codex file: chunks BASE, RECI and scat do not make a codex"));
    }
}

}  // namespace viaface

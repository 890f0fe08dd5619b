// The framing of `.via` bytes, as FORMAT.md has it: header, checked chunks, end. Shared by every kind.
#pragma once

#include <string_view>
#include <vector>

#include "base/bytes.hpp"

namespace viaface {

inline constexpr std::uint32_t kLongestViaChunk = 1u << 28;

enum class ViaKind : std::uint16_t { kCodex = 1, kStream = 2, kStreamModel = 3 };

struct ViaChunk {
    std::string_view type;  // four letters; views into the bytes that were read
    std::span<const std::uint8_t> content;
    std::size_t offset = 0;  // of the content in those bytes
};

// Of what FORMAT.md says about a kind.
inline constexpr std::uint16_t via_version(ViaKind kind) { return kind == ViaKind::kCodex ? 1 : 2; }

inline bool is_optional(const ViaChunk& chunk) { return chunk.type[0] >= 'a'; }

class ViaChunkWriter {
  public:
    explicit ViaChunkWriter(ViaKind kind);
    void add(std::string_view type, std::span<const std::uint8_t> content);
    Bytes finish();                                         // adds the end
    const Bytes& bytes() const { return writer_.bytes(); }  // what was added so far

  private:
    ByteWriter writer_;
};

// The header and the chunks one by one; each throws as read_chunks does.
void read_via_header(ByteReader& reader, std::span<const std::uint8_t> bytes, ViaKind kind);
ViaChunk read_via_chunk(ByteReader& reader, std::span<const std::uint8_t> bytes);

// Every chunk but the end. Throws std::runtime_error that names the chunk and the byte for whatever is not as
// FORMAT.md has it.
std::vector<ViaChunk> read_chunks(std::span<const std::uint8_t> bytes, ViaKind kind);

}  // namespace viaface

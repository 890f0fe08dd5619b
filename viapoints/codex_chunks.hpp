// The contents of a codex file's chunks, as FORMAT.md has them: each written and taken apart again. What is
// written must fit (std::invalid_argument); what is taken must be as FORMAT.md has it (std::runtime_error
// that names the byte of the content).
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "base/bytes.hpp"
#include "viapoints/codex.hpp"

namespace viaface::codex_chunks {

inline constexpr int kMostComponents = 64;

inline void demand(bool holds, const std::string& what, const ByteReader& reader) {
    if (holds) return;
    throw std::runtime_error(what + " (byte " + std::to_string(reader.offset()) + " of the content)");
}
inline void fits(bool holds, const std::string& what) {
    if (!holds) throw std::invalid_argument("codex file: " + what);
}

// LAYO: the names of the points.
Bytes put_layout();
void check_layout(ByteReader& reader);

// PHON: the phone that each index of the file stands for.
Bytes put_phones();
std::vector<PhoneId> take_phones(ByteReader& reader);

// BASE
struct StoredBasis {
    ConfigurationBasis basis;
    Eigen::VectorXd rest;
};

Bytes put_basis(const Codex& codex);
StoredBasis take_basis(ByteReader& reader);

// RECI: k components; ids as PHON has them.
Bytes put_recitations(const Codex& codex);
std::vector<Recitation> take_recitations(ByteReader& reader, Eigen::Index k, const std::vector<PhoneId>& ids);

}  // namespace viaface::codex_chunks

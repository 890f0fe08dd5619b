// Any bytes are a codex or a std::runtime_error; and a codex written is the same bytes when read and written
// again. The first byte says what the others are: a whole file, or the content of one chunk of a good file,
// since checksums would stop most guesses.
#include <cstdlib>

#include "viapoints/codex_file.hpp"
#include "viapoints/via_chunks.hpp"

namespace viaface {
namespace {

Bytes good_file() {
    ConfigurationBasis basis{Configuration::Zero(), Eigen::MatrixXd::Identity(kCoordinates, 2)};
    const RowMatrix points = RowMatrix::Constant(2, 2, 1.5);
    const Recitation recitation = {{kPause, 0, true, 0.2, {0, 0.5}, points, 1},
                                   {3, 1, true, 0.1, {0.25, 0.75}, points, 0}};
    return write_codex(make_codex(basis, Eigen::VectorXd::Zero(2), {recitation}, "fuzz", 0.5));
}

Bytes with_one_content(std::size_t which, std::span<const std::uint8_t> content) {
    static const Bytes good = good_file();
    const auto chunks = read_chunks(good, ViaKind::kCodex);
    ViaChunkWriter writer(ViaKind::kCodex);
    for (std::size_t i = 0; i < chunks.size(); ++i) {
        writer.add(chunks[i].type, i == which % chunks.size() ? content : chunks[i].content);
    }
    return writer.finish();
}

}  // namespace
}  // namespace viaface

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace viaface;
    if (size == 0) return 0;
    const std::span<const std::uint8_t> rest(data + 1, size - 1);
    Codex codex;
    try {
        codex = read_codex(data[0] == 0 ? Bytes(rest.begin(), rest.end()) : with_one_content(data[0], rest));
    } catch (const std::runtime_error&) {
        return 0;
    }
    const Bytes written = write_codex(codex);
    if (write_codex(read_codex(written)) != written) std::abort();
    return 0;
}

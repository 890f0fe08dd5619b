#include "synth/motion/blend_recording.hpp"

#include "base/whole_file.hpp"
#include "synth/motion/facegood.hpp"
#include "synth/motion/live_link.hpp"
#include "synth/motion/npy.hpp"

namespace viaface {

BlendRecording read_blend_recording(const std::filesystem::path& path, const std::string& field) {
    const Bytes bytes = read_bytes(path, field, kLargestNpy);
    if (is_npy(bytes)) return facegood_recording(parse_npy(bytes, field), field);
    return parse_live_link({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, field);
}

}  // namespace viaface

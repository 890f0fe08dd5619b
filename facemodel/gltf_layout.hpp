// Names and numbers that the writer and the reader of face.glb share.
#pragma once

#include <array>
#include <cstdint>

namespace viaface::gltf {

inline constexpr std::uint32_t kMagic = 0x46546c67, kVersion = 2;  // "glTF"
inline constexpr std::uint32_t kJsonChunk = 0x4e4f534a, kBinChunk = 0x004e4942;
inline constexpr int kFloat = 5126, kUnsigned = 5125;
inline constexpr int kVertexBuffer = 34962, kIndexBuffer = 34963;
inline constexpr int kFormat = 1;  // of extras.viaface

inline constexpr std::array<const char*, 9> kMaterialNames = {"skin",   "lips", "mouth", "gums", "teeth",
                                                              "tongue", "eye",  "lash",  "cloth"};
inline constexpr std::array<const char*, 6> kDriveNames = {"modes", "lips",   "mouth",
                                                           "jaw",   "tongue", "fixed"};

}  // namespace viaface::gltf

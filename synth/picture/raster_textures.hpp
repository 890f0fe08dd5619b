// A material's textures as the kernels fetch them: base and detail side by side, with their mip levels.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "synth/picture/packed_textures.hpp"
#include "synth/picture/raster_scene.hpp"

namespace viaface {

class RasterTextures {
  public:
    explicit RasterTextures(const PackedTextures& packed);
    const std::array<raster::Level, raster::kLevels>& levels() const { return levels_; }

  private:
    std::vector<std::vector<std::uint8_t>> texels_;      // of each level
    std::array<raster::Level, raster::kLevels> levels_;  // the coarsest repeated
};

}  // namespace viaface

// How much of the light outside reaches the inside of the mouth. The opening between the inner lips is a
// polygon that glows evenly; the flow of its light at a point is Lambert's closed sum over its edges,
//   F = 1 / (2 pi) * sum of angle_i * unit(r_i x r_i+1),
// (J. H. Lambert, Photometria, 1760; D. R. Baum, H. E. Rushmeier, J. M. Winget, "Improving radiosity
// solutions through the use of analytically determined form-factors", SIGGRAPH 1989), |F| = 1 in the opening
// itself. Departures: what is between point and lips casts no shadow, and half of the light comes from
// everywhere, as it does after the first bounce off wet walls. On the lips themselves light fails where they
// touch.
#pragma once

#include <span>
#include <vector>

#include "synth/picture/surface_frame.hpp"
#include "synth/picture/work_pool.hpp"

namespace viaface {

class MouthLight {
  public:
    explicit MouthLight(const Face& face);
    // light[node], 0 to 1 in steps of 1/255, of the given nodes inside the mouth and of the lips. Without
    // lips nothing is darker than elsewhere, and `light` stays as it is.
    void compute(const NodesF& places, const NodesF& normals, std::span<const int> inside, WorkPool& pool,
                 std::vector<float>& light) const;

  private:
    void light_lips(const NodesF& places, std::vector<float>& light) const;

    bool has_lips_ = false;
    LipGrid lips_;
};

}  // namespace viaface

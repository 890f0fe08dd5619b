#include "synth/training/tongue.hpp"

#include "synth/pose/inside.hpp"

namespace viaface {
namespace {

// u = column / columns, v = row / (rows - 1).
Uvs grid_uvs(int rows, int columns, int more) {
    Uvs uvs = Uvs::Zero(rows * columns + more, 2);
    for (int i = 0; i < rows * columns; ++i) {
        uvs.row(i) << static_cast<float>(i % columns) / static_cast<float>(columns),
            static_cast<float>(i / columns) / static_cast<float>(rows - 1);
    }
    return uvs;
}

}  // namespace

PartMesh tongue() {
    Uvs uvs = grid_uvs(TongueSweep::kSections, TongueSweep::kAround, 2);
    uvs.row(TongueSweep::kNodes - 1) << 0, 1;
    return {"tongue",       Material::kTongue,        Drive::kTongue, TongueSweep::rest(),
            std::move(uvs), TongueSweep::triangles(0)};
}

PartMesh mouth_lining(const Nodes& lining) {
    Uvs uvs = grid_uvs(MouthLining::kRings, MouthLining::kColumns, 1);
    uvs.row(MouthLining::kNodes - 1) << 0, 1;
    return {"mouth", Material::kMouth, Drive::kMouth, lining, std::move(uvs), MouthLining::triangles(0)};
}

}  // namespace viaface

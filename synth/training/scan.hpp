// A posture of the blend-shape head as a laser scanner would give it, and the generic mesh fitted to it.
// [ATR98, "Static face scans" and "Face and lip mesh adaptation"]
#pragma once

#include "facemodel/adaptation.hpp"
#include "synth/training/postures.hpp"

namespace viaface {

struct FaceScan {
    RangeMap range;
    FeaturePoints features;  // unrolled, from the 68 landmarks and the 18 markers
    Configuration points;    // of the whole layout, mm
};
FaceScan scan(const BlendHead& head, const ShapeWeights& weights);

struct FittedPosture {
    std::string name;
    FaceScan scan;
    AdaptedFace face;
};
FittedPosture fit(const BlendHead& head, const GenericMesh& mesh, const Posture& posture);

}  // namespace viaface

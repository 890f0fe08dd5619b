// Makes the talker's face from the blend-shape head: display mesh, lips, mouth, teeth, tongue, eyes, lashes,
// the modes over the talker's postures and every shape of the head by name. [ATR98, eqs. 1-7]
#pragma once

#include "facemodel/face.hpp"
#include "facemodel/pca.hpp"
#include "synth/pose/training.hpp"
#include "synth/training/blend_head.hpp"
#include "synth/training/display_mesh.hpp"
#include "synth/training/eyes.hpp"
#include "synth/training/looks.hpp"
#include "synth/training/part_mesh.hpp"
#include "synth/training/postures.hpp"

namespace viaface {

// What the scan lacks, at rest.
struct BesideScan {
    Configuration points;  // of the scan
    Nodes lining;
    std::array<EyeBall, 2> eyes;  // left, right
    std::optional<HairKnot> knot;
};

// Poses every node of the face as the head is posed; what the scan lacks follows the scan's points. The mesh
// and its texture places are those of the head without identity: all people share them.
class HeadToFace {
  public:
    explicit HeadToFace(const BlendHead& head, const HairStyle& hair = {});

    const BlendHead& head() const { return head_; }
    const DisplayAnchors& anchors() const { return anchors_; }
    // The scan with its lids as low as they rest: the scans' eyes are wide open.
    Nodes resting(const Nodes& scan) const;
    Nodes posed(const Nodes& scan) const;  // [nodes of the face x 3], mm, lids at rest
    Face unposed() const;                  // parts, uvs, welds and the rest nodes: no modes, no shapes
    Face canvas() const;                   // the same of the head without identity: where looks are painted

  private:
    BesideScan beside(const Nodes& neutral, const HairStyle& hair) const;
    Face face_of(const BesideScan& beside, const Nodes& hair, const Nodes& scan) const;

    const BlendHead& head_;  // outlives this
    DisplayAnchors anchors_;
    BesideScan beside_, generic_beside_;
    Nodes lowered_;              // the lids' way to rest, [nodes of the scan x 3], mm
    Nodes hair_, generic_hair_;  // what hair adds, [nodes of the face x 3], mm
};

Face make_face(const HeadToFace& source, const std::vector<Posture>& postures = talker_postures());

// What the estimators learn from, over the same postures as the face's modes.
PoseTraining pose_training(const HeadToFace& source, const Face& face,
                           const std::vector<Posture>& postures = talker_postures());

}  // namespace viaface

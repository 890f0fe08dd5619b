// Makes the talker's face from the blend-shape head: display mesh, lips, mouth, teeth, tongue, eyes, lashes,
// the modes over the talker's postures and every shape of the head by name. [ATR98, eqs. 1-7]
#pragma once

#include "facemodel/face.hpp"
#include "facemodel/pca.hpp"
#include "synth/pose/training.hpp"
#include "synth/training/blend_head.hpp"
#include "synth/training/display_mesh.hpp"
#include "synth/training/part_mesh.hpp"
#include "synth/training/postures.hpp"

namespace viaface {

// Poses every node of the face as the head is posed; what the scan lacks follows the scan's points.
class HeadToFace {
  public:
    explicit HeadToFace(const BlendHead& head);

    const BlendHead& head() const { return head_; }
    const DisplayAnchors& anchors() const { return anchors_; }
    // The scan with its lids as low as they rest: the scans' eyes are wide open.
    Nodes resting(const Nodes& scan) const;
    Nodes posed(const Nodes& scan) const;  // [nodes of the face x 3], mm, lids at rest
    Face unposed() const;                  // parts, uvs, welds and the rest nodes: no modes, no shapes

  private:
    std::vector<PartMesh> parts(const Nodes& scan) const;  // at the posture of `scan`, in the face's order

    const BlendHead& head_;  // outlives this
    DisplayAnchors anchors_;
    Configuration rest_points_;
    Nodes lining_;
    Nodes lowered_;  // the lids' way to rest, [nodes of the scan x 3], mm
    Nodes hair_;     // what hair adds, [nodes of the face x 3], mm
};

Face make_face(const HeadToFace& source, const std::vector<Posture>& postures = talker_postures());

// What the estimators learn from, over the same postures as the face's modes.
PoseTraining pose_training(const HeadToFace& source, const Face& face,
                           const std::vector<Posture>& postures = talker_postures());

}  // namespace viaface

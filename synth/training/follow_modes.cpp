#include "synth/training/follow_modes.hpp"

#include "base/decompositions.hpp"

namespace viaface {

void follow_modes(Face& face, const HeadToFace& source, const PoseTraining& training,
                  const std::vector<Posture>& postures) {
    Eigen::MatrixXd shapes(face.rest.size(), static_cast<Eigen::Index>(postures.size()));
    for (std::size_t k = 0; k < postures.size(); ++k) {
        const Nodes posed = source.posed(source.head().pose(postures[k].weights));
        shapes.col(static_cast<Eigen::Index>(k)) =
            Eigen::Map<const Eigen::VectorXd>(posed.data(), posed.size());
    }
    shapes.colwise() -= shapes.rowwise().mean().eval();
    const Eigen::MatrixXd& c = training.coefficients;  // their mean over the postures is 0
    const Eigen::MatrixXd normal = c * c.transpose();
    for (const FacePart& part : face.parts) {
        if (part.drive == Drive::kModes) continue;
        const auto rows = shapes.middleRows(3 * part.first_node, 3 * part.nodes);
        face.modes.middleRows(3 * part.first_node, 3 * part.nodes) =
            solve_positive(normal, Eigen::MatrixXd(c * rows.transpose())).transpose();
    }
}

}  // namespace viaface

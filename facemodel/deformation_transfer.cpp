#include "facemodel/deformation_transfer.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "facemodel/smooth_fit.hpp"

namespace viaface {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

constexpr double kHold = 1e3;

Matrix3d frame_of(const Nodes& nodes, const Triangle& t) {
    const Vector3d a = nodes.row(t[0]), u = nodes.row(t[1]).transpose() - a,
                   v = nodes.row(t[2]).transpose() - a;
    const Vector3d n = u.cross(v);
    Matrix3d frame;
    frame << u, v, n / std::sqrt(std::max(n.norm(), 1e-9));
    return frame;
}

}  // namespace

DeformationTransfer::DeformationTransfer(Nodes source_rest, Nodes target_rest,
                                         std::vector<Triangle> triangles, const std::vector<bool>& still)
    : source_(std::move(source_rest)), target_(std::move(target_rest)), triangles_(std::move(triangles)) {
    if (source_.rows() != target_.rows() || still.size() != static_cast<std::size_t>(source_.rows()))
        throw std::invalid_argument("deformation transfer between meshes of different topology");
    if (std::ranges::none_of(still, [](bool s) { return s; }))
        throw std::invalid_argument("deformation transfer with nothing that stays");
    for (const Triangle& t : triangles_) {
        const Matrix3d frame = frame_of(source_, t);
        const bool flat = std::abs(frame.determinant()) < 1e-9;
        from_rest_.push_back(flat ? Matrix3d::Zero() : Matrix3d(frame.inverse()));
    }
    std::vector<bool> used(still.size());
    for (const Triangle& t : triangles_) {
        for (const int node : t) used[node] = true;
    }
    hold_.resize(source_.rows(), source_.rows());
    hold_.setIdentity();
    for (std::size_t i = 0; i < still.size(); ++i)
        hold_.coeffRef(static_cast<int>(i), static_cast<int>(i)) = still[i] || !used[i] ? kHold : 0;
    solver_.compute(Eigen::SparseMatrix<double>(cotangent_laplacian(target_, triangles_) + hold_));
    if (solver_.info() != Eigen::Success) throw std::runtime_error("deformation transfer cannot be solved");
}

Nodes DeformationTransfer::operator()(const Nodes& pose) const {
    Nodes right = hold_ * target_;
    for (std::size_t k = 0; k < triangles_.size(); ++k) {
        const Triangle& t = triangles_[k];
        const Matrix3d way = from_rest_[k].isZero() ? Matrix3d(Matrix3d::Identity())
                                                    : Matrix3d(frame_of(pose, t) * from_rest_[k]);
        for (int c = 0; c < 3; ++c) {
            const int i = t[(c + 1) % 3], j = t[(c + 2) % 3];
            const double w = cotangent_weight(target_, t, c);
            const Eigen::RowVector3d edge =
                w * (way * (target_.row(i) - target_.row(j)).transpose()).transpose();
            right.row(i) += edge;
            right.row(j) -= edge;
        }
    }
    return solver_.solve(right);
}

}  // namespace viaface

#include "lipmodel/grounded.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace viaface {
namespace {

std::vector<Eigen::Index> free_freedoms(Eigen::Index freedoms, std::span<const int> held_nodes) {
    std::vector<Eigen::Index> found;
    for (Eigen::Index i = 0; i < freedoms; ++i) {
        if (std::ranges::find(held_nodes, i / 3) == held_nodes.end()) found.push_back(i);
    }
    return found;
}

Eigen::SparseMatrix<double> kept(const Eigen::SparseMatrix<double>& whole,
                                 const std::vector<Eigen::Index>& keep) {
    std::vector<Eigen::Index> place(whole.rows(), -1);
    for (std::size_t i = 0; i < keep.size(); ++i) place[keep[i]] = static_cast<Eigen::Index>(i);
    std::vector<Eigen::Triplet<double>> entries;
    for (Eigen::Index column = 0; column < whole.outerSize(); ++column) {
        for (Eigen::SparseMatrix<double>::InnerIterator entry(whole, column); entry; ++entry) {
            if (place[entry.row()] >= 0 && place[column] >= 0)
                entries.emplace_back(place[entry.row()], place[column], entry.value());
        }
    }
    Eigen::SparseMatrix<double> part(keep.size(), keep.size());
    part.setFromTriplets(entries.begin(), entries.end());
    return part;
}

}  // namespace

GroundedBody::GroundedBody(const Eigen::SparseMatrix<double>& stiffness, std::span<const int> held_nodes)
    : freedoms_(stiffness.rows()), free_(free_freedoms(freedoms_, held_nodes)) {
    auto factored =
        std::make_unique<Eigen::SimplicialLLT<Eigen::SparseMatrix<double>>>(kept(stiffness, free_));
    const double least = factored->info() == Eigen::Success
                             ? Eigen::VectorXd(factored->matrixL().nestedExpression().diagonal()).minCoeff()
                             : 0;
    // A pivot of round-off size is a freedom that nothing holds.
    if (!(least > 1e-7)) throw std::runtime_error("GroundedBody: the body is not held enough");
    factored_ = std::move(factored);
}

Eigen::MatrixXd GroundedBody::displacements(const Eigen::MatrixXd& forces) const {
    if (forces.rows() != freedoms_) throw std::invalid_argument("GroundedBody: forces of another size");
    Eigen::MatrixXd moved = Eigen::MatrixXd::Zero(freedoms_, forces.cols());
    const Eigen::MatrixXd pressed = forces(free_, Eigen::all);
    const Eigen::MatrixXd solved = factored_->solve(pressed);  // Eigen 3.4 solves wrongly into a view
    moved(free_, Eigen::all) = solved;
    return moved;
}

}  // namespace viaface

#include "facemodel/smooth_fit.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viaface {
namespace {

using Eigen::Vector3d;
using Sparse = Eigen::SparseMatrix<double>;

constexpr double kAgreeing = 0.4;        // cosine between the normals of node and scan
constexpr double kFades = 60;            // mm: so far beyond the scan the start is kept again
constexpr double kLargestCotangent = 8;  // of slivers

struct Pull {
    Nodes places;
    Eigen::VectorXd weights;
};

Pull pull_of(const Nodes& now, const std::vector<Triangle>& triangles, const NearestSurface& scan,
             const Eigen::VectorXd& trust, double reach) {
    Pull pull{now, Eigen::VectorXd::Zero(now.rows())};
    const Nodes normals = node_normals(now, triangles);
    for (Eigen::Index i = 0; i < now.rows(); ++i) {
        if (trust[i] <= 0) continue;
        const Vector3d place = now.row(i);
        const SurfacePlace near = scan(place);
        const Vector3d normal = scan.normal(near);
        if (near.distance > reach || normal.dot(normals.row(i).transpose()) < kAgreeing ||
            scan.on_border(near))
            continue;
        pull.places.row(i) = (place - normal * normal.dot(place - near.place)).transpose();
        pull.weights[i] = trust[i];
    }
    return pull;
}

// The integral of the squared laplacian as a quadratic form. [nodes x nodes]
Sparse bending_of(const Nodes& nodes, const std::vector<Triangle>& triangles) {
    const Sparse laplacian = cotangent_laplacian(nodes, triangles);
    const Eigen::VectorXd by_area =
        node_areas(nodes, triangles).unaryExpr([](double a) { return a > 0 ? 1 / std::max(a, 1e-3) : 0; });
    return laplacian * (by_area.asDiagonal() * laplacian);
}

}  // namespace

double cotangent_weight(const Nodes& nodes, const Triangle& t, int k) {
    const Vector3d apex = nodes.row(t[k]);
    const Vector3d u = nodes.row(t[(k + 1) % 3]).transpose() - apex,
                   v = nodes.row(t[(k + 2) % 3]).transpose() - apex;
    return std::clamp(0.5 * u.dot(v) / std::max(u.cross(v).norm(), 1e-12), 0.01, kLargestCotangent);
}

Sparse cotangent_laplacian(const Nodes& nodes, const std::vector<Triangle>& triangles) {
    std::vector<Eigen::Triplet<double>> entries;
    for (const Triangle& t : triangles) {
        for (int k = 0; k < 3; ++k) {
            const double w = cotangent_weight(nodes, t, k);
            const int i = t[(k + 1) % 3], j = t[(k + 2) % 3];
            entries.insert(entries.end(), {{i, i, w}, {j, j, w}, {i, j, -w}, {j, i, -w}});
        }
    }
    Sparse laplacian(nodes.rows(), nodes.rows());
    laplacian.setFromTriplets(entries.begin(), entries.end());
    return laplacian;
}

Eigen::VectorXd node_areas(const Nodes& nodes, const std::vector<Triangle>& triangles) {
    Eigen::VectorXd areas = Eigen::VectorXd::Zero(nodes.rows());
    for (const Triangle& t : triangles) {
        const Vector3d a = nodes.row(t[0]), b = nodes.row(t[1]), c = nodes.row(t[2]);
        for (const int node : t) areas[node] += (b - a).cross(c - a).norm() / 6;
    }
    return areas;
}

Nodes smoothed(const Nodes& start, const std::vector<Triangle>& triangles, const Nodes& wanted,
               double wavelength) {
    const Eigen::VectorXd areas = node_areas(start, triangles);
    Sparse eye(start.rows(), start.rows());
    eye.setIdentity();
    Sparse system = std::pow(wavelength, 4) * bending_of(start, triangles) + 1e-6 * eye;
    system.diagonal() += areas.unaryExpr([](double a) { return a > 0 ? a : 1; });
    const Eigen::SimplicialLDLT<Sparse> solver(system);
    if (solver.info() != Eigen::Success) throw std::runtime_error("the smoothing cannot be solved");
    const Nodes right = areas.asDiagonal() * (wanted - start);
    return start + Nodes(solver.solve(right));
}

SmoothFit fit_smoothly(const Nodes& start, const std::vector<Triangle>& triangles, const NearestSurface& scan,
                       const Eigen::VectorXd& trust, const std::vector<Pin>& pins,
                       std::span<const FitStage> stages, const Nodes* begun) {
    const Eigen::VectorXd areas = node_areas(start, triangles);
    const Sparse laplacian = cotangent_laplacian(start, triangles);
    const Eigen::VectorXd by_area =
        areas.unaryExpr([](double a) { return a > 0 ? 1 / std::max(a, 1e-3) : 0; });
    const Sparse bending = laplacian * (by_area.asDiagonal() * laplacian);
    Sparse loose(start.rows(), start.rows());  // keeps what nothing holds
    loose.setIdentity();
    SmoothFit fit{begun ? *begun : start, {}};
    Eigen::SimplicialLDLT<Sparse> solver;
    solver.analyzePattern(Sparse(bending + loose));
    for (const FitStage& stage : stages) {
        const double l4 = std::pow(stage.wavelength, 4);
        for (int round = 0; round < stage.rounds; ++round) {
            Pull pull = pull_of(fit.nodes, triangles, scan, trust, stage.reach);
            fit.covered.assign(static_cast<std::size_t>(start.rows()), false);
            for (Eigen::Index i = 0; i < start.rows(); ++i) fit.covered[i] = pull.weights[i] > 0;
            pull.weights = pull.weights.cwiseProduct(areas);
            Nodes right = pull.weights.asDiagonal() * (pull.places - start);
            for (const Pin& pin : pins) {
                pull.weights[pin.node] += pin.weight;
                right.row(pin.node) += pin.weight * (pin.place.transpose() - start.row(pin.node));
            }
            Sparse system = l4 * bending + 1e-6 * loose;
            system.diagonal() += pull.weights + l4 / std::pow(kFades, 4) * areas;
            solver.factorize(system);
            if (solver.info() != Eigen::Success) throw std::runtime_error("the smooth fit cannot be solved");
            fit.nodes = start + Nodes(solver.solve(right));
        }
    }
    return fit;
}

}  // namespace viaface

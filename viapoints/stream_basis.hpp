// A basis as streams hold it: means in single precision, modes in 1/32767, so that both ends draw with the
// same numbers.
#pragma once

#include "base/bytes.hpp"
#include "viapoints/basis.hpp"

namespace viaface {

inline constexpr int kMostStreamComponents = 114;
inline constexpr double kBasisShare = 0.35;  // of a bound, that the modes in use may leave

// The basis rounded to what a stream holds; its modes are orthonormal to 1e-4 only.
ConfigurationBasis stored_basis(const ConfigurationBasis& basis);

void put_point_set(ByteWriter& writer, const std::vector<int>& points);
std::vector<int> take_point_set(ByteReader& reader);  // rising layout indices; std::runtime_error when empty
void put_mean(ByteWriter& writer, const ConfigurationBasis& basis);
Configuration take_mean(ByteReader& reader);
void put_modes(ByteWriter& writer, const ConfigurationBasis& basis,
               Eigen::Index from);                                               // mode `from` and later
Eigen::MatrixXd take_modes(ByteReader& reader, const std::vector<int>& points);  // [114 x k]

// Components of configurations by least squares over `points`, of which modes need not be orthonormal.
RowMatrix fitted_components(const ConfigurationBasis& basis, const std::vector<int>& points,
                            const RowMatrix& positions);

// The basis followed by as many more modes of what it leaves of `positions` as bring the largest error at
// `points` to max_error_mm or below, these as stored. Leading modes that are not needed are kept.
ConfigurationBasis extended_basis(const ConfigurationBasis& basis, const std::vector<int>& points,
                                  const RowMatrix& positions, double max_error_mm);

// What modes reach at some points. A mode that is seen there by less than a fiftieth of its square beyond
// what others reach is not independent of them: values of modes that nearly cancel each other, or hardly
// show, grow without end.
class ReachedDirections {
  public:
    explicit ReachedDirections(Eigen::Index coordinates) : directions_(coordinates, 0) {}
    bool leaves(const Eigen::VectorXd& mode) const;  // whether it is independent of those added
    void add(const Eigen::VectorXd& mode);

  private:
    Eigen::VectorXd beyond(const Eigen::VectorXd& mode) const;

    Eigen::MatrixXd directions_;  // orthonormal columns
};

// The first `count` modes of the basis without those that are not independent of the ones before at `points`.
std::vector<int> independent_modes(const ConfigurationBasis& basis, const std::vector<int>& points,
                                   int count);

// Few modes of the basis, independent at `points`, rising, that leave at most max_error_mm
// there, or as many as there are: what is left is filled by the mode that takes most of it, then those go
// again that can be spared, the last first.
std::vector<int> needed_modes(const ConfigurationBasis& basis, const std::vector<int>& points,
                              const RowMatrix& positions, double max_error_mm);

}  // namespace viaface

// A talker's stream model from recorded or performed motions: the basis by its largest error, then the
// statistics, at several bounds, by encoding the motions with what was learned from them before.
#pragma once

#include "viapoints/stream_model.hpp"

namespace viaface {

struct ModelOptions {
    std::vector<double> bounds_mm = {0.25, 0.5, 1, 2, 4};
    double basis_error_mm = 0.05;  // largest, of any configuration that was given
    double step_per_bound = 5;     // of each component
    int passes = 2;                // of encoding and learning
    // [n x 114], configurations that its basis is to hold besides; their mean tells nothing
    RowMatrix also = RowMatrix(0, kCoordinates);
    double also_error_mm = 0.2;
};

// The points are those that all motions have. The same for any number of threads; bounds are learned side by
// side. InputError for motions without a common point, or with gaps.
StreamModel learn_stream_model(const std::string& name, const std::vector<Motion>& motions,
                               const ModelOptions& options = {});

}  // namespace viaface

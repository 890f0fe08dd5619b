// A stream's statistics from via points that were searched before, at one bound.
#pragma once

#include "viapoints/stream_search.hpp"

namespace viaface {

// Weights by least squares, drawn a little towards those of all gaps together; probabilities as coding the
// segments in their order leaves them.
StreamStatistics learn_statistics(const std::vector<QuantisedSegment>& segments, int components,
                                  double bound_mm, double step_mm);

}  // namespace viaface

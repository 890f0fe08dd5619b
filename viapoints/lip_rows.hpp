// How far apart the lips of a configuration are, read off its components: of the inner lips, or of the lip
// markers or the border of a basis without them.
#pragma once

#include <optional>

#include "viapoints/basis.hpp"

namespace viaface {

struct LipRows {
    Eigen::RowVectorXd lower;  // [k], mm per component: height of the lower lip
    Eigen::RowVectorXd apart;  // likewise: height of the upper lip over the lower
};

std::optional<LipRows> lip_rows(const ConfigurationBasis& basis);  // none where the lips do not move

}  // namespace viaface

// The scan's colours in the face's own texture layout: each texel of skin and lips takes the colour of the
// nearest place of the scan. Where the scan has none (holes, what was completed, the lips' inside) the
// lender's painted skin goes on, its colours brought to the scan's by a gain per channel, with a soft
// passage. Relief and gloss stay the lender's. Light that fell on the person stays in the picture.
#pragma once

#include "synth/scans/adaptation_to_scan.hpp"
#include "synth/scans/borrowed_motion.hpp"

namespace viaface {

void paint_from_scan(const AdaptedHead& head, const GenericHead& lender, BorrowedTalker& talker);

}  // namespace viaface

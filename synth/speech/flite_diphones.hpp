// The diphones that the voice kal16 joins [Black00], made complete: its database holds 1,584 of the 41 x 41
// pairs of phones. Each of the others is spoken as the pair with a neighbour in place of one phone or of
// both: /hh/, /w/ and /y/ that lead to no vowel end as /th/, /uw/ and /iy/ do, and /ng/ after anything but a
// vowel begins as /n/ does. Labels and durations stay those of the phones themselves.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

struct cst_diphone_db_struct;

namespace viaface {

// Of "k-ng": "k-n". None for what the voice has itself.
std::optional<std::string> diphone_in_place_of(std::string_view first, std::string_view second);

// What kal16 has and what stands in for the rest, in the order that Flite searches. Alive until the program
// ends; shared by all threads.
const cst_diphone_db_struct& whole_diphones();

}  // namespace viaface

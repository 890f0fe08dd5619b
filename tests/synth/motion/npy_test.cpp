#include "synth/motion/npy.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.hpp"
#include "tests/synth/motion/npy_bytes.hpp"

namespace viaface {
namespace {

constexpr std::string_view kPlain = "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }\n";
const std::vector<double> kSix = {1, 2, 3, 4, 5, 6};

RowMatrix table() { return (RowMatrix(2, 3) << 1, 2, 3, 4, 5, 6).finished(); }

TEST(Npy, ReadsRowsFirstAndColumnsFirst) {
    EXPECT_EQ(parse_npy(npy_file(kPlain, kSix)), table());
    const auto turned =
        npy_file<double>("{'descr': '<f8', 'fortran_order': True, 'shape': (2, 3), }", {1, 4, 2, 5, 3, 6});
    EXPECT_EQ(parse_npy(turned), table());
}

TEST(Npy, ReadsSingleFloatsLongSizesAndLaterVersions) {
    const auto single =
        npy_file<float>("{'shape': (2L, 3L), 'fortran_order': False, 'descr': '<f4'}", {1, 2, 3, 4, 5, 6}, 2);
    EXPECT_EQ(parse_npy(single), table());
}

TEST(Npy, ReadsTheOtherByteOrder) {
    Bytes bytes = npy_file("{'descr': '>f8', 'fortran_order': False, 'shape': (2, 3), }", kSix);
    for (std::size_t i = 0; i < kSix.size(); ++i)
        std::reverse(bytes.end() - static_cast<std::ptrdiff_t>(8 * (i + 1)),
                     bytes.end() - static_cast<std::ptrdiff_t>(8 * i));
    EXPECT_EQ(parse_npy(bytes), table());
}

TEST(Npy, RefusesEveryCut) {
    const Bytes whole = npy_file(kPlain, kSix);
    for (std::size_t size = 0; size < whole.size(); ++size)
        EXPECT_THROW(parse_npy(std::span(whole).first(size)), InputError) << size;
}

TEST(Npy, RefusesWhatIsNoTableOfFloats) {
    for (const std::string_view header :
         {"{'descr': '<i8', 'fortran_order': False, 'shape': (2, 3), }",
          "{'descr': '<f8', 'fortran_order': Maybe, 'shape': (2, 3), }",
          "{'descr': '<f8', 'fortran_order': False, 'shape': (6,), }",
          "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 0), }",
          "{'descr': '<f8', 'fortran_order': False, 'shape': (2, -3), }",
          "{'descr': '<f8', 'fortran_order': False, 'shape': (4294967296, 4294967296), }",
          "{'descr': '<f8', 'fortran_order': False, 'shape': (1, 3), }",
          "{'descr': '<f8', 'fortran_order': False}", "{'descr': [('x', '<f8')], 'shape': (2, 3)}", ""}) {
        EXPECT_THROW(parse_npy(npy_file(header, kSix)), InputError) << header;
    }
}

}  // namespace
}  // namespace viaface

#include <gtest/gtest.h>

#include <filesystem>

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "tests/scratch_folder.hpp"

namespace viaface {
namespace {

std::span<const std::uint8_t> bytes_of(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

TEST(Bytes, Crc32IsZlibs) {
    EXPECT_EQ(crc32(bytes_of("123456789")), 0xcbf43926u);  // the check value of the CRC catalogue
    EXPECT_EQ(crc32({}), 0u);
}

TEST(Bytes, ReadingPastTheEndNamesTheOffset) {
    ByteWriter writer;
    writer.put<std::uint16_t>(0x1234);
    ByteReader reader(writer.bytes());
    EXPECT_EQ(reader.get<std::uint8_t>(), 0x34);
    try {
        reader.get<std::uint32_t>();
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("byte 1"), std::string::npos);
    }
}

TEST(InputError, ShowsLongAndUnprintableValuesShortened) {
    const InputError error("text", std::string(500, 'x') + "\n", "up to 100 characters");
    EXPECT_LT(std::string(error.what()).size(), 160u);
    EXPECT_EQ(InputError("a", std::string("\0\n", 2), "b").value(), "??");
}

TEST(WholeFile, IsAbsentUntilCommitted) {
    const test::ScratchFolder folder;
    const auto path = folder / "x.txt";
    { const WholeFile file(path); }
    EXPECT_TRUE(folder.is_empty());
    write_whole(path, std::string_view("one"));
    EXPECT_EQ(read_text(path, "x"), "one");
    EXPECT_THROW(WholeFile(folder / "missing" / "y"), InputError);
    EXPECT_THROW(read_text(folder / "absent", "x"), InputError);
}

}  // namespace
}  // namespace viaface

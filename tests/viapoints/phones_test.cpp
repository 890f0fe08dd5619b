#include "viapoints/phones.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"

namespace viaface {
namespace {

TEST(Phones, EveryNameOfTheTableReadsBackInEitherCase) {
    for (std::size_t i = 0; i < phone_table().size(); ++i) {
        std::string name(phone_table()[i].name);
        EXPECT_EQ(parse_phone(name).phone, i);
        for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        EXPECT_EQ(parse_phone(name).phone, i);
    }
}

TEST(Phones, StressIsReadOffVowels) {
    EXPECT_EQ(parse_phone("AA1").stress, 1);
    EXPECT_EQ(parse_phone("iy2").stress, 2);
    EXPECT_EQ(phone_info(parse_phone("AH0").phone).name, "ax");
    EXPECT_EQ(phone_info(parse_phone("ah1").phone).name, "ah");
    EXPECT_EQ(parse_phone("sp").phone, kPause);
    EXPECT_EQ(parse_phone("SIL").phone, kPause);
}

TEST(Phones, UnknownNamesAreRefusedWithWhatIsAllowed) {
    for (const char* bad : {"", "q", "aa3", "b1", "aa11", "p\xff", "0"}) {
        try {
            parse_phone(bad);
            ADD_FAILURE() << bad;
        } catch (const InputError& error) {
            EXPECT_EQ(error.field(), "phone");
            EXPECT_NE(error.allowed().find("iy"), std::string::npos);
        }
    }
}

}  // namespace
}  // namespace viaface

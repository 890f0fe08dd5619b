#include "synth/speech/requested_phones.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"

namespace viaface {
namespace {

std::string refusal(const std::string& text) {
    try {
        parse_phones(text);
    } catch (const InputError& error) {
        EXPECT_EQ(error.field(), "phones");
        return error.value() + " | " + error.allowed();
    }
    ADD_FAILURE() << "accepted: " << text.substr(0, 40);
    return "";
}

TEST(RequestedPhones, NamesStressAndDurationsAreRead) {
    const auto phones = parse_phones("  ax b:90\tAA1:220.5\n");
    ASSERT_EQ(phones.size(), 5u);
    EXPECT_EQ(phones[0].phone, kPause);
    EXPECT_EQ(phone_info(phones[1].phone).name, "ax");
    EXPECT_FALSE(phones[1].duration);
    EXPECT_EQ(phones[2].duration, 90);
    EXPECT_EQ(phone_info(phones[3].phone).name, "aa");
    EXPECT_EQ(phones[3].stress, 1);
    EXPECT_EQ(phones[3].duration, 220.5);
    EXPECT_EQ(phones[4].phone, kPause);
    EXPECT_FALSE(phones[4].duration);
}

TEST(RequestedPhones, PausesInARowAreOneAndThoseAtTheEndsAreKept) {
    const auto phones = parse_phones("sil:300 m sp:100 pau:200 m pau:400");
    ASSERT_EQ(phones.size(), 5u);
    EXPECT_EQ(phones[0].duration, 300);
    EXPECT_EQ(phones[2].duration, 300);
    EXPECT_EQ(phones[4].duration, 400);
}

TEST(RequestedPhones, RefusalsNameTheItemAndWhatIsAllowed) {
    EXPECT_NE(refusal("aa q:90").find("q:90 | pau aa"), std::string::npos);
    EXPECT_NE(refusal("b1").find("b1"), std::string::npos);
    for (const char* item :
         {"b:19.9", "b:2001", "b:nan", "b:-90", "b:", "b:90ms", "b:1e9", "b:0x40", "b:90:90", "b:inf"}) {
        const std::string said = refusal("aa " + std::string(item));
        EXPECT_NE(said.find(item), std::string::npos) << said;
        EXPECT_NE(said.find("20 to 2000 ms"), std::string::npos) << said;
    }
}

TEST(RequestedPhones, EmptyEndlessAndStrangeRequestsAreRefused) {
    for (const std::string& text :
         {std::string(), std::string(" \n"), std::string("pau pau:200"), std::string("-"),
          std::string("aa\0b", 4), std::string("\xff"), std::string(100000, 'a')}) {
        refusal(text);
    }
    std::string many, most, slow;
    for (std::size_t i = 0; i <= kMostPhones; ++i) (i < kMostPhones ? most : many) += "aa ";
    EXPECT_EQ(parse_phones(most).size(), kMostPhones + 2);
    refusal(most + many);
    for (int i = 0; i < 31; ++i) slow += "aa:2000 ";
    EXPECT_NE(refusal(slow).find("60000 ms"), std::string::npos);
}

}  // namespace
}  // namespace viaface

#include "server/accept.hpp"

#include <gtest/gtest.h>

#include <array>

namespace viaface {
namespace {

constexpr std::array<std::string_view, 2> kOffered = {"application/json", "application/vnd.viaface.via"};

std::string_view preferred(std::string_view accept) {
    return preferred_type(accept, kOffered).value_or("nothing");
}

TEST(Accept, TheHighestQualityIsPreferredAndTheFirstAmongEquals) {
    EXPECT_EQ(preferred(""), kOffered[0]);
    EXPECT_EQ(preferred("*/*"), kOffered[0]);
    EXPECT_EQ(preferred("application/*"), kOffered[0]);
    EXPECT_EQ(preferred("application/vnd.viaface.via"), kOffered[1]);
    EXPECT_EQ(preferred("application/vnd.viaface.via, application/json"), kOffered[0]);
    EXPECT_EQ(preferred("application/vnd.viaface.via, */*;q=0.1"), kOffered[1]);
    EXPECT_EQ(preferred("application/json;q=0.5 , application/vnd.viaface.via ; q=0.6"), kOffered[1]);
    EXPECT_EQ(preferred("Application/VND.viaface.via;Q=1,application/json;q=0.999"), kOffered[1]);
    EXPECT_EQ(preferred("text/html, application/json; charset=utf-8"), kOffered[0]);
}

TEST(Accept, TheMostSpecificRangeSpeaksForAType) {
    EXPECT_EQ(preferred("*/*;q=1, application/json;q=0.2"), kOffered[1]);
    EXPECT_EQ(preferred("application/*;q=0.3, */*;q=0.9, application/json;q=0.4"), kOffered[0]);
    EXPECT_EQ(preferred("application/*, application/json;q=0"), kOffered[1]);
}

TEST(Accept, NothingIsPreferredWhereNothingIsAcceptable) {
    EXPECT_EQ(preferred("text/html"), "nothing");
    EXPECT_EQ(preferred("application"), "nothing");
    EXPECT_EQ(preferred("*/*;q=0"), "nothing");
    EXPECT_EQ(preferred("applications/*, appl/*"), "nothing");
}

TEST(Accept, ARangeThatCannotBeReadNamesNothing) {
    for (const char* q : {"q=", "q=2", "q=-1", "q=nan", "q=1e0", "q=0.5x"})
        EXPECT_EQ(preferred(std::string("application/vnd.viaface.via;") + q + ", */*;q=0.1"), kOffered[0])
            << q;
    EXPECT_EQ(preferred(",;,=,;q=1"), "nothing");
}

}  // namespace
}  // namespace viaface

#include "server/json_fields.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "base/error.hpp"
#include "server/problem.hpp"

namespace viaface {
namespace {

using nlohmann::json;

std::string refused(const std::function<void()>& reading) {
    try {
        reading();
    } catch (const InputError& error) {
        EXPECT_EQ(problem(error).status, 422);
        return error.field();
    }
    return "";
}

TEST(JsonFields, ReadsEachTypeAndWhatIsAbsent) {
    const json body = {{"text", "a"}, {"rate", 1.5}, {"fps", 30}, {"seed", 7u}, {"view", {{"yaw", 2}}}};
    JsonFields fields(body, "");
    EXPECT_EQ(fields.text("text"), "a");
    EXPECT_EQ(fields.number("rate"), 1.5);
    EXPECT_EQ(fields.number("fps"), 30.0);
    EXPECT_EQ(fields.whole_number("seed"), 7u);
    EXPECT_EQ(fields.object("view"), body["view"]);
    EXPECT_EQ(fields.text("voice"), std::nullopt);
    EXPECT_EQ(refused([&] { fields.refuse_unknown(); }), "");
}

// JSON knows one kind of number.
TEST(JsonFields, AWholeNumberMayBeWrittenAsAFraction) {
    for (const auto& [text, whole] :
         {std::pair("7.0", 7u), std::pair("7e0", 7u), std::pair("0.0", 0u), std::pair("12e2", 1200u)}) {
        const json body = {{"seed", json::parse(text)}};
        EXPECT_EQ(JsonFields(body, "").whole_number("seed"), whole) << text;
    }
    for (const char* text : {"7.5", "-7.0", "1e300", "1.8446744073709552e19"}) {
        const json body = {{"seed", json::parse(text)}};
        EXPECT_EQ(refused([&] { JsonFields(body, "").whole_number("seed"); }), "seed") << text;
    }
}

TEST(JsonFields, WrongTypesAreRefusedByName) {
    const json values[] = {nullptr, true, -1, 0.5, "text", json::array(), json::object()};
    for (const json& value : values) {
        const json body = {{"field", value}};
        JsonFields fields(body, "view");
        EXPECT_EQ(refused([&] { fields.text("field"); }), value.is_string() ? "" : "view.field") << value;
        EXPECT_EQ(refused([&] { fields.number("field"); }), value.is_number() ? "" : "view.field") << value;
        EXPECT_EQ(refused([&] { fields.whole_number("field"); }), "view.field") << value;
        EXPECT_EQ(refused([&] { fields.object("field"); }), value.is_object() ? "" : "view.field") << value;
    }
}

TEST(JsonFields, UnknownNamesAndWhatIsNoObjectAreRefused) {
    const json body = {{"text", "a"}, {"colour", "red"}};
    JsonFields fields(body, "");
    fields.text("text");
    EXPECT_EQ(refused([&] { fields.refuse_unknown(); }), "colour");
    for (const json& value : {json(nullptr), json(3), json("text"), json::array()}) {
        EXPECT_EQ(refused([&] { JsonFields(value, ""); }), "body") << value;
    }
}

TEST(JsonFields, EveryTruncationAndByteOfABodyIsReadOrRefused) {
    const std::string whole =
        R"({"text": "\u00e9\ud83d\ude00", "view": {"yaw": 1e9}, "seed": 18446744073709551616})";
    for (std::size_t length = 0; length < whole.size(); ++length) {
        EXPECT_TRUE(json::parse(whole.substr(0, length), nullptr, false).is_discarded()) << length;
    }
    for (std::size_t at = 0; at < whole.size(); ++at) {
        for (int byte = 0; byte < 256; ++byte) {
            std::string damaged = whole;
            damaged[at] = static_cast<char>(byte);
            const json body = json::parse(damaged, nullptr, false);
            if (body.is_discarded()) continue;
            refused([&] {
                JsonFields fields(body, "");
                fields.text("text");
                fields.object("view");
                fields.whole_number("seed");
                fields.refuse_unknown();
            });
        }
    }
}

}  // namespace
}  // namespace viaface

#include "synth/speech/text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <random>

#include "base/error.hpp"
#include "synth/speech/plain_text.hpp"

namespace viaface {
namespace {

using List = std::vector<std::string>;

InputError refusal(const std::string& text) {
    try {
        sentences(text);
    } catch (const InputError& error) {
        EXPECT_EQ(error.field(), "text");
        EXPECT_FALSE(error.allowed().empty());
        return error;
    }
    ADD_FAILURE() << "accepted: " << text.substr(0, 60);
    return {"", "", ""};
}

std::size_t letters(const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c); }));
}

TEST(PlainText, AccentsQuotesAndDashesFold) {
    EXPECT_EQ(plain_text("café, cafe\u0301, naïve Ångström, Łódź, Nguyễn, œuvre, straße"),
              "cafe, cafe, naive Angstrom, Lodz, Nguyen, oeuvre, strasse");
    EXPECT_EQ(plain_text("“don’t” ‘a’"), "\"don't\" 'a'");
    EXPECT_EQ(plain_text("wait—what… 1914–1918"), "wait, what...  1914 to 1918");
    EXPECT_EQ(plain_text("20°"), "20 degrees ");
    EXPECT_EQ(plain_text("a\u00a0b\u200bc\r\nd"), "a bc\nd");
}

TEST(PlainText, IsAsciiForEveryCharacterItTakes) {
    int taken = 0;
    for (char32_t c = 0x80; c < 0x3000; ++c) {
        std::vector<char> bytes;
        if (c < 0x800) {
            bytes = {static_cast<char>(0xc0 | c >> 6), static_cast<char>(0x80 | (c & 0x3f))};
        } else {
            bytes = {static_cast<char>(0xe0 | c >> 12), static_cast<char>(0x80 | (c >> 6 & 0x3f)),
                     static_cast<char>(0x80 | (c & 0x3f))};
        }
        try {
            for (const char byte : plain_text({bytes.data(), bytes.size()})) {
                EXPECT_TRUE(byte == '\n' || (byte >= 0x20 && byte < 0x7f)) << std::hex << static_cast<int>(c);
            }
            ++taken;
        } catch (const InputError&) {
        }
    }
    EXPECT_GT(taken, 500);
}

TEST(Sentences, EndAtTheirMarksOnly) {
    EXPECT_EQ(sentences("Hello there. How are you? Fine!"), (List{"Hello there.", "How are you?", "Fine!"}));
    EXPECT_EQ(sentences("Mr. Smith met Dr. J. Jones at 3.14 p.m. on time."),
              List{"Mr. Smith met Dr. J. Jones at 3.14 p.m. on time."});
    EXPECT_EQ(sentences("Fruit, e.g. Apples. It was I. Good."),
              (List{"Fruit, e.g. Apples.", "It was I.", "Good."}));
    EXPECT_EQ(sentences("\"Stop!\" He ran (fast.) Gone"), (List{"\"Stop!\"", "He ran (fast.)", "Gone"}));
    EXPECT_EQ(sentences("Well... perhaps. No. 7 won. I said no. Yes."),
              (List{"Well... perhaps.", "No. 7 won.", "I said no.", "Yes."}));
    EXPECT_EQ(sentences("A title\n\nA line\nthat goes on"), (List{"A title", "A line that goes on"}));
}

TEST(Sentences, SilentOnesAreLeftOut) {
    EXPECT_EQ(sentences("Hello. ... !!! 🙂 Bye."), (List{"Hello.", "Bye."}));
    EXPECT_EQ(sentences("1 < 2 & 3"), List{"1  less than  2  and  3"});
}

TEST(Sentences, LongOnesAreCutAtClausesAndLoseNothing) {
    std::string text;
    for (int i = 0; i < 200; ++i) text += i % 9 == 8 ? "mountain, " : "mountain ";
    const List pieces = sentences(text);
    EXPECT_GT(pieces.size(), 4u);
    std::size_t sum = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        EXPECT_LE(pieces[i].size(), 2 * kLongestSentence);
        EXPECT_TRUE(i + 1 == pieces.size() || pieces[i].back() == ',');
        sum += letters(pieces[i]);
    }
    EXPECT_EQ(sum, letters(text));
}

TEST(Sentences, DigitsAreBounded) {
    std::string apart;
    for (int i = 0; i < 3000; ++i) apart += "7 ";
    for (const std::string& piece : sentences(apart)) EXPECT_LE(6 * letters(piece), kLongestSentence);
    EXPECT_NE(refusal(std::string(3000, '7')).allowed().find("100"), std::string::npos);
}

TEST(Sentences, TenMinutesOfTextFit) {
    std::string text;
    while (text.size() + 60 < kLongestText)
        text += "Once upon a time there was an old man and an old woman. ";
    EXPECT_GT(text.size(), 12000u);
    EXPECT_GT(sentences(text).size(), 200u);
    refusal(text + std::string(200, ' ') + "too much");
}

TEST(Sentences, RubbishIsRefusedAndNamed) {
    for (const std::string& text : {std::string(),
                                    std::string(" \n\t "),
                                    std::string("?!... -- ,"),
                                    std::string("🙂🙃 👍🏽"),
                                    std::string("<<<>>> + & @ #"),
                                    std::string("a\0b", 3),
                                    std::string("a\x07"),
                                    std::string("\x7f"),
                                    std::string("今日は"),
                                    std::string("Привет мир"),
                                    std::string("caf\xc3"),
                                    std::string("\xff\xfe"),
                                    std::string("\xc0\xaf"),
                                    std::string("\xed\xa0\x80"),
                                    std::string("\xf4\x90\x80\x80"),
                                    std::string("\xe0\x80\x80"),
                                    std::string("\x80"),
                                    std::string(100000, 'a'),
                                    std::string(101, 'a'),
                                    std::string("<speak><prosody rate='slow'>Hello</prosody></speak>"),
                                    std::string("say <break time=\"1s\"/> it"),
                                    std::string("<!-- a --> b")}) {
        refusal(text);
    }
    EXPECT_NE(refusal("caf\xc3").value().find("byte 3"), std::string::npos);
    EXPECT_EQ(refusal("hello 今").value(), "今");
    EXPECT_NE(refusal("<prosody>x").value().find("<prosody>"), std::string::npos);
}

// Whatever the bytes: sentences of printable ASCII within the bounds, or a refusal.
TEST(Sentences, AnyBytesGiveBoundedSentencesOrARefusal) {
    std::mt19937 random(7);
    const std::string alphabet = "aZ09 .,!?\n'\"()-<>&\xc3\xa9\xe2\x80\x94\x80\xf0";
    int taken = 0;
    for (int round = 0; round < 3000; ++round) {
        std::string text;
        const auto kinds = round % 2 ? 15 : alphabet.size();
        for (unsigned n = random() % 400; n > 0; --n) text += alphabet[random() % kinds];
        try {
            for (const std::string& piece : sentences(text)) {
                EXPECT_GT(letters(piece), 0u);
                EXPECT_LE(piece.size(), 2000u);
                for (const char c : piece) EXPECT_TRUE(c >= 0x20 && c < 0x7f);
            }
            ++taken;
        } catch (const InputError&) {
        }
    }
    EXPECT_GT(taken, 500);
}

}  // namespace
}  // namespace viaface

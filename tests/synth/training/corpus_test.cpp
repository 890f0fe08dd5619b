#include "synth/training/corpus.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "synth/learn/sentences.hpp"
#include "synth/speech/requested_phones.hpp"
#include "tests/scratch_folder.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;
const fs::path kRoot = VIAFACE_SOURCE_DIR;

int class_of(const RequestedPhone& phone) { return static_cast<int>(phone_info(phone.phone).viseme); }

TEST(Corpus, EveryPairOfPhonesOccurs) {
    std::set<std::pair<PhoneId, PhoneId>> pairs;
    for (const std::string& text : generated_strings()) {
        const auto phones = parse_phones(text);
        for (std::size_t i = 1; i < phones.size(); ++i) pairs.insert({phones[i - 1].phone, phones[i].phone});
    }
    EXPECT_EQ(pairs.size(), phone_table().size() * phone_table().size() - 1);  // all but two pauses
}

TEST(Corpus, EveryPhoneOccursBetweenEveryPairOfClasses) {
    std::set<std::array<int, 3>> triples;
    std::size_t phones_in_all = 0;
    for (const std::string& text : generated_strings()) {
        const auto phones = parse_phones(text);
        phones_in_all += phones.size();
        for (std::size_t i = 1; i + 1 < phones.size(); ++i) {
            triples.insert({class_of(phones[i - 1]), phones[i].phone, class_of(phones[i + 1])});
        }
    }
    const std::size_t classes = static_cast<std::size_t>(VisemeClass::kRoundedMid) + 1;
    EXPECT_EQ(triples.size(), (phone_table().size() - 1) * classes * classes);
    EXPECT_LT(phones_in_all, 2 * triples.size());
}

TEST(Corpus, StringsAreShortEnoughToBeSpoken) {
    for (const std::string& text : generated_strings()) EXPECT_LE(parse_phones(text).size(), 26u) << text;
}

TEST(Corpus, HoldsHundredsOfSentencesAndNoneOfTheHeldOut) {
    const auto corpus = read_sentences(kRoot / "talkers/momo/corpus.txt");
    const auto held_out = read_sentences(kRoot / "tests/synth/training/held_out.txt");
    EXPECT_GE(corpus.size(), 400u);
    EXPECT_EQ(held_out.size(), 50u);
    EXPECT_EQ(std::set<std::string>(corpus.begin(), corpus.end()).size(), corpus.size());
    for (const std::string& sentence : held_out) {
        EXPECT_EQ(std::count(corpus.begin(), corpus.end(), sentence), 0) << sentence;
    }
}

TEST(Corpus, WithoutSentencesIsRefused) {
    EXPECT_THROW(read_sentences(kRoot / "no such file"), InputError);
    const test::ScratchFolder folder;
    const fs::path comments = folder / "comments.txt";
    write_whole(comments, std::string_view("# nothing\n\n"));
    EXPECT_THROW(read_sentences(comments), InputError);
}

}  // namespace
}  // namespace viaface

#include "synth/learn/take_files.hpp"

#include "tests/synth/learn/folder.hpp"

namespace viaface {
namespace {

using testing::expect_refused;

class TakeFilesTest : public testing::InFolder {
  protected:
    void refused(const std::vector<std::string>& parts) const {
        expect_refused([&] { find_takes(folder_, "recordings"); }, parts);
    }
};

TEST_F(TakeFilesTest, FilesOfOneNameBelongTogether) {
    for (const char* name : {"b.CSV", "b.flac", "b.txt", "a.c3d", "a.wav", "a.TextGrid", "a.txt", "README.md",
                             "LICENSE", "notes.txt"})
        put(name, std::string_view(name));
    const auto takes = find_takes(folder_, "recordings");
    ASSERT_EQ(takes.size(), 2u);
    EXPECT_EQ(takes[0].name, "a");
    EXPECT_EQ(takes[0].motion.filename(), "a.c3d");
    EXPECT_EQ(takes[0].labels.filename(), "a.TextGrid");
    EXPECT_EQ(takes[1].sound.filename(), "b.flac");
    EXPECT_TRUE(takes[1].labels.empty());
}

TEST_F(TakeFilesTest, NothingToLearnFromIsRefused) {
    refused({"NAME.csv"});
    put("notes.txt", "words");
    refused({"NAME.csv"});
    expect_refused([&] { find_takes(folder_ / "none", "recordings"); }, {"none", "folder"});
}

TEST_F(TakeFilesTest, APartThatIsMissingIsNamed) {
    put("a.csv", "m");
    refused({"a: no sound"});
    put("a.wav", "s");
    refused({"a: no words"});
    put("a.txt", "w");
    EXPECT_EQ(find_takes(folder_, "recordings").size(), 1u);
    put("b.wav", "s");
    refused({"b: no motion"});
}

TEST_F(TakeFilesTest, TwoFilesForOnePartAreNamed) {
    for (const char* name : {"a.csv", "a.wav", "a.txt", "a.trc"}) put(name, std::string_view(name));
    refused({"a.csv", "a.trc"});
}

TEST_F(TakeFilesTest, TheSameMotionTwiceIsNamed) {
    for (const char* name : {"a.wav", "a.txt", "b.wav", "b.txt"}) put(name, std::string_view(name));
    put("a.csv", "same");
    put("b.csv", "same");
    refused({"b.csv", "motion of a"});
}

}  // namespace
}  // namespace viaface

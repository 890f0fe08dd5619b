#include "lipmodel/lip_file.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "mouths.hpp"

namespace viaface {
namespace {

LipModel small_model() {
    LipModel model = learn_lips(lip_body(test::resting_mouth()), test::speaking_mouth(60), {.modes = 2});
    model.provenance = "made up for a test";
    return model;
}

Bytes resealed(Bytes bytes) {
    const std::uint32_t crc = crc32(std::span(bytes).first(bytes.size() - 4));
    for (int i = 0; i < 4; ++i) bytes[bytes.size() - 4 + i] = static_cast<std::uint8_t>(crc >> (8 * i));
    return bytes;
}

TEST(LipFile, GivesBackWhatWasWritten) {
    const LipModel model = small_model();
    const Bytes bytes = write_lip_model(model);
    const LipModel read = read_lip_model(bytes);
    EXPECT_EQ(read.rest, model.rest);
    EXPECT_EQ(read.mean, model.mean);
    EXPECT_EQ(read.modes, model.modes);
    EXPECT_EQ(read.variance, model.variance);
    EXPECT_EQ(read.provenance, model.provenance);
    EXPECT_EQ(read.frames, 60);
    EXPECT_EQ(read.total_variance, model.total_variance);
    EXPECT_EQ(write_lip_model(read), bytes);
    EXPECT_EQ(bytes.size(), 8 + 16 + model.provenance.size() + 8 * (3 + 2 * 612 + 2 + 2 * 612) + 4);
}

TEST(LipFile, RefusesEveryTruncationAndLength) {
    const Bytes bytes = write_lip_model(small_model());
    for (std::size_t size = 0; size < bytes.size(); size += size < 64 ? 1 : 977)
        EXPECT_THROW(read_lip_model(std::span(bytes).first(size)), InputError);
    Bytes longer = bytes;
    longer.push_back(0);
    EXPECT_THROW(read_lip_model(longer), InputError);
}

TEST(LipFile, RefusesEveryFlippedByte) {
    const Bytes bytes = write_lip_model(small_model());
    for (std::size_t i = 0; i < bytes.size(); i += i < 64 ? 1 : 509) {
        Bytes flipped = bytes;
        flipped[i] ^= 0x55;
        EXPECT_THROW(read_lip_model(flipped), InputError) << i;
    }
}

TEST(LipFile, RefusesWhatIsNoModelUnderAGoodChecksum) {
    LipModel falling = small_model();
    std::swap(falling.variance[0], falling.variance[1]);
    EXPECT_THROW(read_lip_model(write_lip_model(falling)), InputError);
    LipModel skew = small_model();
    skew.modes.col(1) += 0.01 * skew.modes.col(0);
    EXPECT_THROW(read_lip_model(write_lip_model(skew)), InputError);
    LipModel nan = small_model();
    nan.mean[5] = NAN;
    EXPECT_THROW(read_lip_model(write_lip_model(nan)), InputError);
    LipModel lines = small_model();
    lines.provenance = "two\nlines";
    EXPECT_THROW(read_lip_model(write_lip_model(lines)), InputError);
    Bytes many = write_lip_model(small_model());
    many[15] = 0xff;  // some four billion modes
    EXPECT_THROW(read_lip_model(resealed(many)), InputError);
    EXPECT_NO_THROW(read_lip_model(resealed(write_lip_model(small_model()))));
}

}  // namespace
}  // namespace viaface

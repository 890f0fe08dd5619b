// Stills of the built-in talker against pictures that were looked at before they were committed. The measure
// is PSNR over the three colours; equal machines draw far closer than kAlike. VIAFACE_UPDATE_GOLDENS=1 writes
// the pictures anew: look at each before committing it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "base/whole_file.hpp"
#include "facemodel/png.hpp"
#include "synth/picture/portrait.hpp"
#include "synth/say/sheet.hpp"
#include "synth/talker/talker.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;

constexpr int kSide = 256;     // pixels
constexpr double kAlike = 35;  // dB
const fs::path kRoot = VIAFACE_SOURCE_DIR;

struct Still {
    const char* name;
    const char* phones;
    const char* at;  // the phone in whose middle the still is taken
    double yaw;      // degrees
};

std::string name_of(const testing::TestParamInfo<Still>& info) { return info.param.name; }

const Talker& momo() {
    static const Talker talker = load_talker(kRoot / "talkers/momo");
    return talker;
}

Texture drawn(const Still& still) {
    View view;
    view.width = view.height = kSide;
    view.yaw = still.yaw;
    Portrait portrait(momo().face, view);
    const FrameView frame =
        portrait.draw(momo().poser.posed(points_in_phone(momo().codex, still.phones, still.at)));
    Texture picture{kSide, kSide, 3, {}};
    for (int row = 0; row < kSide; ++row) {
        for (int column = 0; column < kSide; ++column) {
            const std::uint8_t* pixel = frame.top_row + row * frame.stride + 4 * column;
            picture.pixels.insert(picture.pixels.end(), pixel, pixel + 3);
        }
    }
    return picture;
}

struct Apart {
    double psnr = 0;                     // dB
    int worst = 0, row = 0, column = 0;  // the largest difference of a colour, 0 to 255, and its place
};

Apart compare(const Texture& a, const Texture& b) {
    Apart apart;
    double squares = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const int difference = std::abs(a.pixels[i] - b.pixels[i]);
        squares += difference * difference;
        if (difference <= apart.worst) continue;
        const int pixel = static_cast<int>(i) / a.channels;
        apart.worst = difference;
        apart.row = pixel / a.width;
        apart.column = pixel % a.width;
    }
    apart.psnr = 10 * std::log10(255.0 * 255.0 * static_cast<double>(a.pixels.size()) / squares);
    return apart;
}

class Golden : public testing::TestWithParam<Still> {};

TEST_P(Golden, LooksAsItDidWhenLookedAt) {
    const fs::path file = kRoot / "tests/goldens" / (std::string(GetParam().name) + ".png");
    const Texture now = drawn(GetParam());
    if (std::getenv("VIAFACE_UPDATE_GOLDENS") != nullptr) {
        write_whole(file, encode_png(now));
        GTEST_SKIP() << "wrote " << file << "; look at it";
    }
    const Texture golden = decode_png(read_bytes(file, "golden"));
    ASSERT_EQ(golden.pixels.size(), now.pixels.size());
    const Apart apart = compare(golden, now);
    std::printf("%s: PSNR %.1f dB\n", GetParam().name, apart.psnr);
    EXPECT_GE(apart.psnr, kAlike) << file.filename() << ": worst difference " << apart.worst
                                  << " of 255 at row " << apart.row << ", column " << apart.column;
}

TEST(GoldenStills, TheMeasureTellsOneStillFromAnother) {
    const Apart apart =
        compare(drawn({"a", "b:90 aa1:300 b:90", "aa", 0}), drawn({"m", "aa1:150 m:200 aa1:150", "m", 0}));
    EXPECT_LT(apart.psnr, kAlike);
    EXPECT_GT(apart.row, kSide / 2);  // the mouth is in the lower half
}

INSTANTIATE_TEST_SUITE_P(Stills, Golden,
                         testing::Values(Still{"neutral", "ax", "pau", 0},
                                         Still{"a", "b:90 aa1:300 b:90", "aa", 0},
                                         Still{"u", "d:90 uw1:300 d:90", "uw", 0},
                                         Still{"f", "aa1:150 f:200 aa1:150", "f", 0},
                                         Still{"m", "aa1:150 m:200 aa1:150", "m", 0},
                                         Still{"side", "d:90 eh1:300 d:90", "eh", 40}),
                         name_of);

}  // namespace
}  // namespace viaface

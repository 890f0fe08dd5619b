// The report on the takes of ../shared/data, where they are.
#include "synth/lips/lip_report.hpp"

#include <gtest/gtest.h>

#include <iostream>

namespace viaface {
namespace {

namespace fs = std::filesystem;
const fs::path kData = fs::path(VIAFACE_SOURCE_DIR) / "../shared/data";

TEST(LipReport, ModesOfOneTakeServeAnother) {
    const fs::path train = kData / "facegood/bs_value_1114_2_01.npy",
                   test = kData / "livelink_rom/alex_rom_3.csv";
    if (!fs::exists(train) || !fs::exists(test)) GTEST_SKIP() << "the takes are not here: " << kData;
    const Talker momo = load_talker(fs::path(VIAFACE_TALKERS_FOLDER) / "momo");
    const LipFrames learned = read_lip_frames({train}, momo), tried = read_lip_frames({test}, momo);
    LipFrames recited = recited_lip_frames(momo);
    recited.points = recited.points.leftCols(2000).eval();
    const LipReport report = report_lips(learned, tried, recited, {});
    std::cout << lip_report_text(report);
    EXPECT_GE(report.trained.variance.size(), 5u);
    EXPECT_GT(share_of(report.trained, kPaperModes), 0.95);
    for (const auto* errors : {&report.trained.by_modes, &report.tried}) {
        ASSERT_GE(errors->size(), 5u);
        EXPECT_LT(errors->back().frontal.mesh, errors->front().frontal.mesh);
        EXPECT_LT(errors->back().profile.mesh, errors->front().profile.mesh);
    }
    // The whole shape is told from the front to a part of how far it moves.
    EXPECT_LT(std::sqrt(report.trained.by_modes.back().frontal.mesh), 0.5 * report.moved_mm);
    EXPECT_GT(report.force_beside_energy_mm, 0);
}

}  // namespace
}  // namespace viaface

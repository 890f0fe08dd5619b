// The blend-shape head of ../shared/data, read once; tests that need it skip where it is not.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#include "synth/training/blend_head.hpp"

namespace viaface::test {

inline std::filesystem::path scans_folder() {
    return std::filesystem::path(VIAFACE_SOURCE_DIR) / "../shared/data/ict_facekit";
}

inline const BlendHead& blend_head() {
    static const BlendHead head(scans_folder());
    return head;
}

}  // namespace viaface::test

#define SKIP_WITHOUT_SCANS()                                             \
    if (!std::filesystem::exists(viaface::test::scans_folder())) {       \
        GTEST_SKIP() << "needs the scans in ../shared/data/ict_facekit"; \
    }

// The built-in talker's face made from the scans, once per test program.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#include "synth/pose/pose.hpp"
#include "synth/training/make_face.hpp"

namespace viaface {

inline std::filesystem::path scans_folder() {
    return std::filesystem::path(VIAFACE_SOURCE_DIR) / "../shared/data/ict_facekit";
}

struct TestTalker {
    BlendHead head{scans_folder()};
    HeadToFace source{head};
    Face face = make_face(source);
    PoseTraining training = pose_training(source, face);
    Poser poser{face, training};
};

inline const TestTalker& test_talker() {
    static const TestTalker talker;
    return talker;
}

inline const FacePart& part_of(const Face& face, const std::string& name) {
    for (const FacePart& part : face.parts) {
        if (part.name == name) return part;
    }
    throw std::runtime_error("no part " + name);
}

#define SKIP_WITHOUT_SCANS() \
    if (!std::filesystem::exists(scans_folder())) GTEST_SKIP() << "the scans are not here: " << scans_folder()

}  // namespace viaface

#include "synth/motion/facegood.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>

#include "base/error.hpp"

namespace viaface {
namespace {

using Eigen::Index;

// By column of a take.
constexpr std::array<std::string_view, kFacegoodCurves> kCurves = {"cheek_suck_l",
                                                                   "brow_lower_l",
                                                                   "tongue_Scale__X",
                                                                   "tongue_Scale_Y",
                                                                   "tongue_Scale__Y",
                                                                   "tongue_Scale_Z",
                                                                   "tongue_Scale__Z",
                                                                   "nose_out_l",
                                                                   "nose_out_r",
                                                                   "tongue_u",
                                                                   "tongue_u_u",
                                                                   "brow_raise_d",
                                                                   "cheek_suck_r",
                                                                   "mouth_stretch_u",
                                                                   "tongue_u_d",
                                                                   "tooth_d_d",
                                                                   "tongue_d",
                                                                   "tooth_r",
                                                                   "tooth_d_u",
                                                                   "cheek_UP",
                                                                   "eye_blink1_l",
                                                                   "eye_blink1_r",
                                                                   "eye_blink2_l",
                                                                   "eye_blink2_r",
                                                                   "eye_lidTight_l",
                                                                   "eye_lidTight_r",
                                                                   "eye_shutTight_l",
                                                                   "eye_shutTight_r",
                                                                   "brow_lower_r",
                                                                   "eye_upperLidRaise_l",
                                                                   "eye_upperLidRaise_r",
                                                                   "eye_downLidRaise_l",
                                                                   "eye_downLidRaise_r",
                                                                   "jaw_sideways_l",
                                                                   "jaw_sideways_r",
                                                                   "jaw_thrust_c",
                                                                   "mouth_chew_c",
                                                                   "mouth_chinRaise_d",
                                                                   "mouth_chinRaise_u",
                                                                   "brow_raise_c",
                                                                   "mouth_dimple_l",
                                                                   "mouth_dimple_r",
                                                                   "mouth_funnel_dl",
                                                                   "mouth_funnel_dr",
                                                                   "mouth_funnel_ul",
                                                                   "mouth_funnel_ur",
                                                                   "mouth_lipCornerDepressFix_l",
                                                                   "mouth_lipCornerDepressFix_r",
                                                                   "mouth_lipCornerDepress_l",
                                                                   "mouth_lipCornerDepress_r",
                                                                   "brow_raise_l",
                                                                   "mouth_lipCornerPullOpen_l",
                                                                   "mouth_lipCornerPullOpen_r",
                                                                   "mouth_lipCornerPull_l",
                                                                   "mouth_lipCornerPull_r",
                                                                   "mouth_lipStretchOpen_l",
                                                                   "mouth_lipStretchOpen_r",
                                                                   "mouth_lipStretch_l",
                                                                   "mouth_lipStretch_r",
                                                                   "mouth_lowerLipDepress_l",
                                                                   "mouth_lowerLipDepress_r",
                                                                   "brow_raise_r",
                                                                   "mouth_lowerLipProtrude_c",
                                                                   "mouth_oh_c",
                                                                   "mouth_oo_c",
                                                                   "mouth_pressFix_c",
                                                                   "mouth_press_l",
                                                                   "mouth_press_r",
                                                                   "mouth_pucker_l",
                                                                   "mouth_pucker_r",
                                                                   "mouth_screamFix_c",
                                                                   "mouth_sideways_l",
                                                                   "cheek_puff_l",
                                                                   "mouth_sideways_r",
                                                                   "mouth_stretch_c",
                                                                   "mouth_suck_dl",
                                                                   "mouth_suck_dr",
                                                                   "mouth_suck_ul",
                                                                   "mouth_suck_ur",
                                                                   "mouth_upperLipRaise_l",
                                                                   "mouth_upperLipRaise_r",
                                                                   "nose_wrinkle_l",
                                                                   "nose_wrinkle_r",
                                                                   "cheek_puff_r",
                                                                   "tooth_l",
                                                                   "eye_lookDown1_l",
                                                                   "eye_lookDown2_l",
                                                                   "eye_lookLeft_l",
                                                                   "eye_lookRight_l",
                                                                   "eye_lookUp_l",
                                                                   "eye_lookDown1_r",
                                                                   "eye_lookDown2_r",
                                                                   "eye_lookLeft_r",
                                                                   "eye_lookRight_r",
                                                                   "cheek_raise_l",
                                                                   "eye_lookUp_r",
                                                                   "tongue_Rot_1X",
                                                                   "tongue_Rot__1X",
                                                                   "tongue_Rot_2X",
                                                                   "tongue_Rot__2X",
                                                                   "tongue_Rot_3X",
                                                                   "tongue_Rot__3X",
                                                                   "tongue_Rot_1Y",
                                                                   "tongue_Rot__1Y",
                                                                   "tongue_Rot_2Y",
                                                                   "cheek_raise_r",
                                                                   "tongue_Rot__2Y",
                                                                   "tongue_Rot_3Y",
                                                                   "tongue_Rot__3Y",
                                                                   "tongue_Rot_1Z",
                                                                   "tongue_Rot__1Z",
                                                                   "tongue_Rot_2Z",
                                                                   "tongue_Rot__2Z",
                                                                   "tongue_Rot_3Z",
                                                                   "tongue_Rot__3Z",
                                                                   "tongue_Scale_X"};

struct Meaning {
    std::string_view shape;  // of ARKit
    std::array<std::string_view, 4> curves;
};
constexpr Meaning kMeanings[] = {
    {"eyeBlinkLeft", {"eye_blink2_l"}},
    {"eyeLookDownLeft", {"eye_lookDown2_l"}},
    {"eyeLookInLeft", {"eye_lookRight_l"}},
    {"eyeLookOutLeft", {"eye_lookLeft_l"}},
    {"eyeLookUpLeft", {"eye_lookUp_l"}},
    {"eyeSquintLeft", {"eye_shutTight_l"}},
    {"eyeWideLeft", {"eye_downLidRaise_l", "eye_upperLidRaise_l"}},
    {"eyeBlinkRight", {"eye_blink2_r"}},
    {"eyeLookDownRight", {"eye_lookDown2_r"}},
    {"eyeLookInRight", {"eye_lookRight_r"}},
    {"eyeLookOutRight", {"eye_lookLeft_r"}},
    {"eyeLookUpRight", {"eye_lookUp_r"}},
    {"eyeSquintRight", {"eye_shutTight_r"}},
    {"eyeWideRight", {"eye_downLidRaise_r", "eye_upperLidRaise_r"}},
    {"jawForward", {"jaw_thrust_c"}},
    {"jawLeft", {"jaw_sideways_l"}},
    {"jawRight", {"jaw_sideways_r"}},
    {"jawOpen", {"mouth_stretch_c"}},
    {"mouthClose", {"mouth_chew_c"}},
    {"mouthFunnel", {"mouth_funnel_dl", "mouth_funnel_dr", "mouth_funnel_ul", "mouth_funnel_ur"}},
    {"mouthPucker", {"mouth_pucker_l", "mouth_pucker_r"}},
    {"mouthLeft", {"mouth_sideways_l"}},
    {"mouthRight", {"mouth_sideways_r"}},
    {"mouthSmileLeft", {"mouth_lipCornerPull_l"}},
    {"mouthSmileRight", {"mouth_lipCornerPull_r"}},
    {"mouthFrownLeft", {"mouth_lipCornerDepress_l", "mouth_lipCornerDepressFix_l"}},
    {"mouthFrownRight", {"mouth_lipCornerDepress_r", "mouth_lipCornerDepressFix_r"}},
    {"mouthDimpleLeft", {"mouth_dimple_l"}},
    {"mouthDimpleRight", {"mouth_dimple_r"}},
    {"mouthStretchLeft", {"mouth_lipStretch_l"}},
    {"mouthStretchRight", {"mouth_lipStretch_r"}},
    {"mouthRollLower", {"mouth_suck_dl", "mouth_suck_dr"}},
    {"mouthRollUpper", {"mouth_suck_ul", "mouth_suck_ur"}},
    {"mouthShrugLower", {"mouth_chinRaise_d"}},
    {"mouthShrugUpper", {"mouth_chinRaise_u"}},
    {"mouthPressLeft", {"mouth_press_l"}},
    {"mouthPressRight", {"mouth_press_r"}},
    {"mouthLowerDownLeft", {"mouth_lowerLipDepress_l"}},
    {"mouthLowerDownRight", {"mouth_lowerLipDepress_r"}},
    {"mouthUpperUpLeft", {"mouth_upperLipRaise_l"}},
    {"mouthUpperUpRight", {"mouth_upperLipRaise_r"}},
    {"browDownLeft", {"brow_lower_l"}},
    {"browDownRight", {"brow_lower_r"}},
    {"browInnerUp", {"brow_raise_c"}},
    {"browOuterUpLeft", {"brow_raise_l"}},
    {"browOuterUpRight", {"brow_raise_r"}},
    {"cheekPuff", {"cheek_puff_l", "cheek_puff_r"}},
    {"cheekSquintLeft", {"cheek_UP"}},
    {"cheekSquintRight", {"cheek_UP"}},
    {"noseSneerLeft", {"nose_out_l"}},
    {"noseSneerRight", {"nose_out_r"}}};

Index column_of(std::string_view curve) { return std::ranges::find(kCurves, curve) - kCurves.begin(); }

void check(const RowMatrix& curves, const std::string& field) {
    if (curves.cols() != kFacegoodCurves) {
        throw InputError(field, std::to_string(curves.cols()) + " columns",
                         "116 columns, the curves of FACEGOOD's Audio2Face");
    }
    for (Index row = 0; row < curves.rows(); ++row) {
        for (Index column = 0; column < curves.cols(); ++column) {
            if (std::abs(curves(row, column)) <= BlendRecording::kLargestWeight) continue;
            throw InputError(field + " row " + std::to_string(row) + ", column " + std::to_string(column),
                             std::to_string(curves(row, column)), "a number from -10 to 10");
        }
    }
}

class Gathering {
  public:
    explicit Gathering(const RowMatrix& curves) : curves_(curves) {}

    void add(const Meaning& meaning) {
        Eigen::VectorXd largest = Eigen::VectorXd::Constant(curves_.rows(), -BlendRecording::kLargestWeight);
        for (const std::string_view curve : meaning.curves) {
            if (curve.empty()) continue;
            largest = largest.cwiseMax(curves_.col(column_of(curve)));
            meant_.insert(curve);
        }
        add(meaning.shape, largest);
    }

    void add_the_rest() {
        for (const std::string_view curve : kCurves) {
            if (!meant_.contains(curve)) add(curve, curves_.col(column_of(curve)));
        }
    }

    BlendRecording recording() const {
        BlendRecording recording;
        recording.names = names_;
        recording.weights.resize(curves_.rows(), static_cast<Index>(names_.size()));
        for (std::size_t i = 0; i < names_.size(); ++i)
            recording.weights.col(static_cast<Index>(i)) = weights_[i];
        for (Index row = 0; row < curves_.rows(); ++row)
            recording.time_s.push_back(static_cast<double>(row) / kFacegoodRate);
        return recording;
    }

  private:
    void add(std::string_view name, const Eigen::VectorXd& weights) {
        names_.emplace_back(name);
        weights_.push_back(weights);
    }

    const RowMatrix& curves_;
    std::vector<std::string> names_;
    std::vector<Eigen::VectorXd> weights_;
    std::set<std::string_view> meant_;
};

}  // namespace

BlendRecording facegood_recording(const RowMatrix& curves, const std::string& field) {
    check(curves, field);
    Gathering gathering(curves);
    for (const Meaning& meaning : kMeanings) gathering.add(meaning);
    gathering.add_the_rest();
    return gathering.recording();
}

}  // namespace viaface

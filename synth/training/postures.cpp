#include "synth/training/postures.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace viaface {
namespace {

// Openings in the remarks: between the inner lips at the middle, mm.
const std::vector<Posture> kReport = {
    {"a", {{"jawOpen", .40}, {"mouthLowerDown", .12}, {"mouthUpperUp", .08}, {"mouthStretch", .10}}},  // 15
    {"i",
     {{"jawOpen", .10},
      {"mouthStretch", .35},
      {"mouthSmile", .25},
      {"mouthLowerDown", .15},
      {"mouthUpperUp", .10}}},                                              // 6, 8 wider than at rest
    {"u", {{"jawOpen", .06}, {"mouthPucker", .75}, {"mouthFunnel", .15}}},  // 4, 8 narrower
    {"e",
     {{"jawOpen", .22},
      {"mouthStretch", .25},
      {"mouthSmile", .12},
      {"mouthLowerDown", .20},
      {"mouthUpperUp", .12}}},                                              // 10
    {"o", {{"jawOpen", .18}, {"mouthFunnel", .30}, {"mouthPucker", .45}}},  // 10
    {"mouth_open", {{"jawOpen", .75}, {"mouthLowerDown", .10}}},            // 26
    {"closed_relaxed", {{"mouthShrugLower", .08}, {"mouthPress", .08}}},    // 0
    {"closed_clenched",
     {{"mouthPress", .45},
      {"mouthShrugLower", .12},
      {"mouthDimple", .25},
      {"mouthStretch", .15},
      {"mouthFrown", .10}}},  // pressed 1.5 past contact
};

const std::vector<Posture> kSpeaking = {
    {"f", {{"jawOpen", .07}, {"mouthRollLower", .50}, {"mouthUpperUp", .30}, {"mouthStretch", .10}}},
    {"th", {{"jawOpen", .14}, {"mouthLowerDown", .25}, {"mouthUpperUp", .15}, {"mouthShrugUpper", .10}}},
    {"s",
     {{"jawOpen", .02},
      {"jawForward", .30},
      {"mouthStretch", .25},
      {"mouthLowerDown", .40},
      {"mouthUpperUp", .25},
      {"mouthDimple", .15}}},
    {"sh",
     {{"jawOpen", .03},
      {"jawForward", .15},
      {"mouthFunnel", .40},
      {"mouthPucker", .30},
      {"mouthShrugUpper", .15},
      {"mouthShrugLower", .15}}},
    {"ch", {{"jawOpen", .06}, {"mouthFunnel", .45}, {"mouthShrugUpper", .30}, {"mouthShrugLower", .40}}},
    {"r",
     {{"jawOpen", .08},
      {"mouthPucker", .50},
      {"mouthFunnel", .20},
      {"mouthShrugLower", .25},
      {"mouthRollLower", .10}}},
    {"l", {{"jawOpen", .22}, {"mouthDimple", .30}, {"mouthRollUpper", .15}, {"mouthSmile", .10}}},
    {"w", {{"jawOpen", .05}, {"mouthPucker", .95}, {"mouthFunnel", .10}, {"mouthShrugLower", .10}}},
    {"m_pressed",
     {{"mouthPress", .60}, {"mouthRollLower", .25}, {"mouthRollUpper", .35}, {"mouthShrugLower", .15}}},
    {"b_jaw_low", {{"jawOpen", .25}, {"mouthClose", .245}, {"mouthPress", .10}}},
    {"spread", {{"mouthSmile", .55}, {"mouthStretch", .20}, {"mouthUpperUp", .35}}},
    {"corners_down", {{"mouthFrown", .70}, {"mouthShrugLower", .40}}},
    {"cheeks_puffed", {{"cheekPuff", .35}, {"mouthPress", .30}}},
    {"mouth_left", {{"mouthLeft", .50}, {"jawOpen", .05}}},
    {"mouth_right", {{"mouthRight", .50}, {"jawOpen", .05}}},
};

std::vector<Posture> joined() {
    std::vector<Posture> all = kReport;
    all.insert(all.end(), kSpeaking.begin(), kSpeaking.end());
    return all;
}

std::vector<std::string> shapes_of(const std::vector<Posture>& postures) {
    std::set<std::string> names;
    for (const Posture& p : postures) {
        for (const auto& [name, weight] : p.weights) names.insert(name);
    }
    return {names.begin(), names.end()};
}

}  // namespace

const std::vector<Posture>& report_postures() { return kReport; }

const std::vector<Posture>& talker_postures() {
    static const std::vector<Posture> all = joined();
    return all;
}

const std::vector<std::string>& spanned_shapes() {
    static const std::vector<std::string> names = shapes_of(talker_postures());
    return names;
}

const Posture& posture(const std::string& name) {
    const auto& all = talker_postures();
    const auto found = std::ranges::find(all, name, &Posture::name);
    if (found == all.end()) throw std::invalid_argument("no posture is named " + name);
    return *found;
}

}  // namespace viaface

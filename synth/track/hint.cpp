#include "synth/track/hint.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.hpp"

namespace viaface {
namespace {

constexpr double kFarthest = 1e5;  // px
constexpr const char* kAllowed =
    R"({"eyes": [[u, v], [u, v]], "mouth": [u, v, width, height]} in px, the picture's left eye first)";

std::vector<double> numbers(const nlohmann::json& list, std::size_t count) {
    if (!list.is_array() || list.size() != count) throw InputError("--hint", list.dump(), kAllowed);
    std::vector<double> found;
    for (const auto& number : list) {
        if (!number.is_number() || !(std::abs(number.get<double>()) <= kFarthest))
            throw InputError("--hint", number.dump(), kAllowed);
        found.push_back(number.get<double>());
    }
    return found;
}

}  // namespace

Hint parse_hint(std::string_view json) {
    const auto parsed = nlohmann::json::parse(json, nullptr, false);
    if (!parsed.is_object() || !parsed.contains("eyes") || !parsed["eyes"].is_array() ||
        parsed["eyes"].size() != 2)
        throw InputError("--hint", "no eyes", kAllowed);
    const auto left = numbers(parsed["eyes"][0], 2), right = numbers(parsed["eyes"][1], 2);
    Hint hint{.face = {.left_eye = {left[0], left[1]}, .right_eye = {right[0], right[1]}, .eyes_seen = true}};
    if (!(hint.face.eye_distance() >= 4) || !(right[0] > left[0]))
        throw InputError("--hint", parsed["eyes"].dump(), kAllowed);
    if (parsed.contains("mouth")) {
        const auto mouth = numbers(parsed["mouth"], 4);
        if (!(mouth[2] > 0 && mouth[3] > 0)) throw InputError("--hint", parsed["mouth"].dump(), kAllowed);
        hint.mouth = MouthInPicture{.centre = {mouth[0], mouth[1]}, .width = mouth[2], .height = mouth[3]};
    }
    return hint;
}

}  // namespace viaface

#include "viapoints/phones.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "base/error.hpp"

namespace viaface {
namespace {

using enum VisemeClass;

constexpr std::array<PhoneInfo, 41> kTable = {{
    {"pau", "‖", "(pause)", false, VisemeClass::kPause},
    {"aa", "ɑ", "father", true, kOpen},
    {"ae", "æ", "bat", true, kOpen},
    {"ah", "ʌ", "but", true, kCentral},
    {"ao", "ɔ", "caught", true, kRoundedMid},
    {"aw", "aʊ", "out", true, kOpen},
    {"ax", "ə", "about", true, kCentral},
    {"ay", "aɪ", "bite", true, kOpen},
    {"b", "b", "bee", false, kBilabial},
    {"ch", "tʃ", "cheese", false, kPostalveolar},
    {"d", "d", "day", false, kAlveolar},
    {"dh", "ð", "then", false, kDental},
    {"eh", "ɛ", "bet", true, kFrontMid},
    {"er", "ɝ", "bird", true, kRhotic},
    {"ey", "eɪ", "bait", true, kFrontMid},
    {"f", "f", "fee", false, kLabiodental},
    {"g", "ɡ", "go", false, kVelar},
    {"hh", "h", "hay", false, kVelar},
    {"ih", "ɪ", "bit", true, kFrontClose},
    {"iy", "i", "beet", true, kFrontClose},
    {"jh", "dʒ", "joke", false, kPostalveolar},
    {"k", "k", "key", false, kVelar},
    {"l", "l", "lay", false, kLateral},
    {"m", "m", "may", false, kBilabial},
    {"n", "n", "no", false, kAlveolar},
    {"ng", "ŋ", "sing", false, kVelar},
    {"ow", "oʊ", "boat", true, kRoundedMid},
    {"oy", "ɔɪ", "boy", true, kRoundedMid},
    {"p", "p", "pea", false, kBilabial},
    {"r", "ɹ", "ray", false, kRhotic},
    {"s", "s", "see", false, kSibilant},
    {"sh", "ʃ", "she", false, kPostalveolar},
    {"t", "t", "tea", false, kAlveolar},
    {"th", "θ", "thin", false, kDental},
    {"uh", "ʊ", "book", true, kRoundedClose},
    {"uw", "u", "boot", true, kRoundedClose},
    {"v", "v", "vow", false, kLabiodental},
    {"w", "w", "we", false, kLabialGlide},
    {"y", "j", "yes", false, kPalatalGlide},
    {"z", "z", "zoo", false, kSibilant},
    {"zh", "ʒ", "azure", false, kPostalveolar},
}};

std::string lower(std::string_view name) {
    std::string result(name);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    return result;
}

std::string all_names() {
    std::string names;
    for (const PhoneInfo& info : kTable) names += (names.empty() ? "" : " ") + std::string(info.name);
    return names + ", vowels with a stress digit 0 to 2";
}

}  // namespace

std::span<const PhoneInfo> phone_table() { return kTable; }

StressedPhone parse_phone(std::string_view name) {
    std::string plain = lower(name);
    int stress = -1;
    if (!plain.empty() && plain.back() >= '0' && plain.back() <= '2') {
        stress = plain.back() - '0';
        plain.pop_back();
    }
    if (stress < 0 && (plain == "sp" || plain == "sil" || plain == "ssil" || plain == "h#")) plain = "pau";
    if (plain == "ah" && stress == 0) plain = "ax";
    const auto found =
        std::find_if(kTable.begin(), kTable.end(), [&](const auto& p) { return p.name == plain; });
    if (found == kTable.end() || (stress >= 0 && !found->vowel))
        throw InputError("phone", std::string(name), all_names());
    return {static_cast<PhoneId>(found - kTable.begin()), std::max(stress, 0)};
}

}  // namespace viaface

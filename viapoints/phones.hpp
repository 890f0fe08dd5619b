// The phones of English as ARPAbet writes them, with IPA, an example word and the class of phones that look
// alike. Names are read case-insensitively and with a stress digit ("AA1"); ah0 is ax; sp, sil, ssil and h#
// are pau.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace viaface {

// Phones that look alike to the eye, close enough to stand in for each other where a triphone is missing.
enum class VisemeClass : std::uint8_t {
    kPause,
    kBilabial,
    kLabiodental,
    kDental,
    kAlveolar,
    kLateral,
    kSibilant,
    kPostalveolar,
    kVelar,
    kRhotic,
    kLabialGlide,
    kPalatalGlide,
    kFrontClose,
    kFrontMid,
    kOpen,
    kCentral,
    kRoundedClose,
    kRoundedMid
};

using PhoneId = std::uint8_t;  // index into phone_table()

struct PhoneInfo {
    std::string_view name;     // "aa"
    std::string_view ipa;      // "ɑ"
    std::string_view example;  // "father"
    bool vowel;
    VisemeClass viseme;
};

std::span<const PhoneInfo> phone_table();  // pau first
inline const PhoneInfo& phone_info(PhoneId id) { return phone_table()[id]; }
inline constexpr PhoneId kPause = 0;

struct StressedPhone {
    PhoneId phone;
    int stress;  // 0 none, 1 primary, 2 secondary; 0 for consonants
};

// InputError("phone", name, ...) for names that the table lacks.
StressedPhone parse_phone(std::string_view name);

// A phone on the sample clock of its sound.
struct TimedPhone {
    PhoneId phone = kPause;
    int stress = 0;
    std::int64_t begin = 0, end = 0;  // samples, [begin, end)
};

// Gapless and in order: phones[i].end == phones[i + 1].begin. The sample clock is the only clock.
struct PhoneSequence {
    int sample_rate = 16000;  // Hz
    std::vector<TimedPhone> phones;

    double begin_s(std::size_t i) const { return static_cast<double>(phones[i].begin) / sample_rate; }
    double end_s(std::size_t i) const { return static_cast<double>(phones[i].end) / sample_rate; }
};

}  // namespace viaface

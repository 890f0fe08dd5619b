#include "synth/say/sheet.hpp"

#include <stdexcept>

#include "synth/picture/lettering.hpp"
#include "synth/picture/portrait.hpp"
#include "synth/say/recital.hpp"

namespace viaface {
namespace {

constexpr int kColumns = 7, kSide = 400, kBar = 40, kDot = 3;  // pixels, but for the columns
constexpr Rgb kPaper{236, 236, 232}, kInk{24, 24, 28};

struct Still {
    const char *label, *phones, *at;
    double yaw = 0;  // degrees
    double shut = 0;
};

constexpr Still kStills[] = {{"neutral", "ax", "pau"},
                             {"a", "b:90 aa1:300 b:90", "aa"},
                             {"e", "d:90 eh1:300 d:90", "eh"},
                             {"i", "d:90 iy1:300 d:90", "iy"},
                             {"o", "d:90 ao1:300 d:90", "ao"},
                             {"u", "d:90 uw1:300 d:90", "uw"},
                             {"m", "aa1:150 m:200 aa1:150", "m"},
                             {"f", "aa1:150 f:200 aa1:150", "f"},
                             {"th", "aa1:150 th:200 aa1:150", "th"},
                             {"w", "aa1:150 w:200 aa1:150", "w"},
                             {"s", "aa1:150 s:200 aa1:150", "s"},
                             {"profile", "ax", "pau", 90},
                             {"three-quarter", "ax", "pau", 40},
                             {"blink", "ax", "pau", 0, 1}};

void put(const FrameView& frame, Texture& sheet, int left, int top) {
    for (int row = 0; row < frame.height; ++row) {
        const std::uint8_t* from = frame.top_row + row * frame.stride;
        std::uint8_t* to = &sheet.pixels[(std::size_t(top + row) * sheet.width + left) * 3];
        for (int x = 0; x < frame.width; ++x, from += 4, to += 3) std::copy(from, from + 3, to);
    }
}

}  // namespace

Configuration points_in_phone(const Codex& codex, const std::string& phones, std::string_view phone) {
    SpeechRequest request;
    request.phones = phones;
    const Recital recital = recite(codex, Script(request).utterance(0));
    const PhoneSequence& said = recital.utterance.phones;
    for (std::size_t i = 0; i < said.phones.size(); ++i) {
        if (phone_info(said.phones[i].phone).name != phone) continue;
        const double middle_s = (said.begin_s(i) + said.end_s(i)) / 2;
        return recital.motion.at(said.phones[i].phone == kPause ? 0.0 : middle_s);
    }
    throw std::logic_error("the phone is not among those that are recited");
}

Texture contact_sheet(const Talker& talker) {
    const int count = static_cast<int>(std::size(kStills)), rows = (count + kColumns - 1) / kColumns;
    Texture sheet{kColumns * kSide, rows * (kSide + kBar), 3, {}};
    for (int pixel = 0; pixel < sheet.width * sheet.height; ++pixel)
        sheet.pixels.insert(sheet.pixels.end(), kPaper.begin(), kPaper.end());
    for (int i = 0; i < count; ++i) {
        const Still& still = kStills[i];
        const int left = i % kColumns * kSide, top = i / kColumns * (kSide + kBar);
        const Configuration points = points_in_phone(talker.codex, still.phones, still.at);
        Portrait portrait(talker.face, {.width = kSide, .height = kSide, .yaw = still.yaw});
        put(portrait.draw(talker.poser.posed(points, {still.shut, still.shut})), sheet, left, top);
        write_text(sheet, still.label, left + (kSide - text_width(still.label, kDot)) / 2,
                   top + kSide + (kBar - 7 * kDot) / 2, kDot, kInk);
    }
    return sheet;
}

}  // namespace viaface

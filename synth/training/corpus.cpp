#include "synth/training/corpus.hpp"

#include <array>
#include <tuple>
#include <utility>

#include "viapoints/phones.hpp"

namespace viaface {
namespace {

constexpr int kShortString = 16, kLongestString = 24;  // phones
constexpr int kClasses = static_cast<int>(VisemeClass::kRoundedMid) + 1;

int class_of(int phone) { return static_cast<int>(phone_info(static_cast<PhoneId>(phone)).viseme); }

// What has not been said yet: phones between classes, and pairs of phones.
class Unsaid {
  public:
    Unsaid()
        : phones_(static_cast<int>(phone_table().size())),
          between_(static_cast<std::size_t>(kClasses * phones_ * kClasses), true),
          pair_(static_cast<std::size_t>(phones_ * phones_), true),
          after_(static_cast<std::size_t>(kClasses * phones_), kClasses),
          promise_(static_cast<std::size_t>(kClasses), (phones_ - 1) * kClasses),
          left_((phones_ - 1) * kClasses * kClasses) {}

    int left() const { return left_; }  // phones between classes
    bool between(int before, int phone, int next) const { return between_[index(before, phone, next)]; }
    bool pair(int phone, int next) const { return pair_[static_cast<std::size_t>(phone * phones_ + next)]; }
    int after(int before, int phone) const {
        return after_[pair_index(before, phone)];
    }  // classes still to follow

    int promise(int before) const { return promise_[static_cast<std::size_t>(class_of(before))]; }

    void say(int before, int phone, int next) {
        pair_[static_cast<std::size_t>(phone * phones_ + next)] = false;
        if (!between(before, phone, next)) return;
        between_[index(before, phone, next)] = false;
        --after_[pair_index(before, phone)];
        --promise_[static_cast<std::size_t>(class_of(before))];
        --left_;
    }

  private:
    std::size_t pair_index(int before, int phone) const {
        return static_cast<std::size_t>(class_of(before) * phones_ + phone);
    }
    std::size_t index(int before, int phone, int next) const {
        return pair_index(before, phone) * kClasses + static_cast<std::size_t>(class_of(next));
    }

    int phones_;
    std::vector<bool> between_, pair_;
    std::vector<int> after_, promise_;  // by class before and phone, by class before
    int left_;
};

// The phone that says most after the two before it: something new now, else soon; among equals a new pair,
// then the phone said least so far, then the first of the table. The pause ends the string, not early unless
// nothing else may still follow.
int next_phone(const Unsaid& unsaid, int before, int phone, const std::vector<int>& said, bool may_end) {
    if (may_end && unsaid.between(before, phone, kPause)) return kPause;
    int best = 0;
    std::array<int, 5> best_worth{-1, 0, 0, 0, 0};
    for (int next = 1; next < static_cast<int>(said.size()); ++next) {
        const int now = unsaid.between(before, phone, next) ? kClasses : 0;
        const std::array<int, 5> worth{now + unsaid.after(phone, next), unsaid.pair(phone, next) ? 1 : 0,
                                       unsaid.promise(next), -said[static_cast<std::size_t>(next)], -next};
        if (worth > best_worth) std::tie(best, best_worth) = std::pair(next, worth);
    }
    return best;
}

// "ah0" would be "ax": those two keep the stress that is theirs, other vowels take turns.
std::string spelt(int phone, int said) {
    const PhoneInfo& info = phone_info(static_cast<PhoneId>(phone));
    const std::string name(info.name);
    if (!info.vowel || name == "ax") return name;
    return name + (name == "ah" || said % 2 == 0 ? "1" : "0");
}

std::string next_string(Unsaid& unsaid, std::vector<int>& said) {
    std::string text;
    int before = kPause, phone = next_phone(unsaid, kPause, kPause, said, false);
    for (int length = 1;; ++length) {
        text += (text.empty() ? "" : " ") + spelt(phone, said[static_cast<std::size_t>(phone)]++);
        const bool full = length == kLongestString;
        const bool may_end = length >= kShortString || unsaid.after(before, phone) == 1;
        const int next = full ? int{kPause} : next_phone(unsaid, before, phone, said, may_end);
        unsaid.say(before, phone, next);
        if (next == kPause) return text;
        before = std::exchange(phone, next);
    }
}

}  // namespace

std::vector<std::string> generated_strings() {
    Unsaid unsaid;
    std::vector<int> said(phone_table().size(), 0);
    std::vector<std::string> strings;
    while (unsaid.left() > 0) strings.push_back(next_string(unsaid, said));
    return strings;
}

}  // namespace viaface

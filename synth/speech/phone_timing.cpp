#include "synth/speech/phone_timing.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viaface {
namespace {

double worst_error(std::span<const double> durations, std::span<const RequestedPhone> phones) {
    double worst = 0;
    for (std::size_t i = 0; i < phones.size(); ++i) {
        if (phones[i].phone != kPause && phones[i].duration) {
            worst = std::max(worst, std::abs(durations[i] - *phones[i].duration));
        }
    }
    return worst;
}

}  // namespace

bool begins_word(std::span<const RequestedPhone> phones, std::size_t i) {
    return i == 0 || phones[i - 1].phone == kPause;
}

std::string spelt_word(std::span<const RequestedPhone> phones, std::size_t first) {
    std::string word;
    for (std::size_t i = first; i < phones.size() && phones[i].phone != kPause; ++i) {
        word += (word.empty() ? "" : "-") + std::string(phone_info(phones[i].phone).name);
    }
    return word;
}

bool begins_syllable(std::span<const RequestedPhone> phones, std::size_t i) {
    if (begins_word(phones, i)) return true;
    const auto pause =
        std::find_if(phones.begin() + i, phones.end(), [](const auto& p) { return p.phone == kPause; });
    const bool vowel_ahead =
        std::any_of(phones.begin() + i, pause, [](const auto& p) { return phone_info(p.phone).vowel; });
    return vowel_ahead && phone_info(phones[i - 1].phone).vowel;
}

std::vector<double> stretches_for(
    std::span<const RequestedPhone> phones,
    const std::function<std::vector<double>(std::span<const double> factors)>& durations_at) {
    constexpr int kMostRounds = 60;
    constexpr double kCloseEnough = 0.5;  // ms
    std::vector<double> factors(phones.size(), 1);
    for (int round = 0; round < kMostRounds; ++round) {
        const auto durations = durations_at(factors);
        if (worst_error(durations, phones) <= kCloseEnough) return factors;
        for (std::size_t i = 0; i < phones.size(); ++i) {
            if (phones[i].duration) factors[i] *= *phones[i].duration / durations[i];
        }
    }
    throw std::runtime_error("the durations of the phones were not met");
}

std::vector<double> ends_asked_for(std::span<const double> own_ends, std::span<const RequestedPhone> phones) {
    std::vector<double> ends;
    double own_end = 0, end = 0;
    for (std::size_t i = 0; i < phones.size(); ++i) {
        const double own = own_ends[i] - own_end;
        own_end += own;
        end += phones[i].duration && phones[i].phone != kPause ? *phones[i].duration / 1000 : own;
        ends.push_back(end);
    }
    return ends;
}

Utterance with_pauses_asked_for(Utterance said, std::span<const RequestedPhone> phones) {
    for (std::size_t i = 0; i < phones.size(); ++i) {
        if (phones[i].phone != kPause || !phones[i].duration) continue;
        const auto length = std::llround(*phones[i].duration * said.sound.sample_rate / 1000);
        said = with_pause_length(std::move(said), i, length);
    }
    return said;
}

}  // namespace viaface

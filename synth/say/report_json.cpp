#include "synth/say/report_json.hpp"

#include <algorithm>
#include <cstdio>

namespace viaface {
namespace {

using nlohmann::json;

constexpr int kOpeningRate = 100;  // Hz
constexpr const char* kLevelNames[] = {"exact", "class", "half"};

double rounded(double value, double step) { return std::round(value / step) * step; }
double micrometre(double mm) { return std::round(mm * 1000) / 1000; }

double lip_opening(const Configuration& c) {
    return (point_of(c, kInnerTop) - point_of(c, kInnerBottom)).y();
}

json via_points(const Recital& recital, double offset_s) {
    json points = json::array();
    for (std::size_t i = 0; i < recital.track.time_s.size(); ++i) {
        json numbers = json::array();
        for (const double mm : recital.track.points.row(static_cast<Eigen::Index>(i)))
            numbers.push_back(micrometre(mm));
        points.push_back({{"time_s", rounded(recital.track.time_s[i] + offset_s, 1e-6)},
                          {"points_mm", std::move(numbers)}});
    }
    return points;
}

void append(json& to, json&& from) {
    std::move(from.begin(), from.end(), std::back_inserter(to.get_ref<json::array_t&>()));
}

void append_opening(json& opening, const Recital& recital, std::int64_t first_sample, std::int64_t end_sample,
                    int rate) {
    std::vector<double> times;
    const auto steps = [&](std::int64_t sample) { return (sample * kOpeningRate + rate - 1) / rate; };
    for (std::int64_t n = steps(first_sample); n < steps(end_sample); ++n) {
        times.push_back(static_cast<double>(n) / kOpeningRate - static_cast<double>(first_sample) / rate);
    }
    const RowMatrix motion = recital.motion.at(times);
    for (Eigen::Index i = 0; i < motion.rows(); ++i)
        opening.push_back(micrometre(lip_opening(motion.row(i).transpose())));
}

std::string hexadecimal(std::uint64_t value) {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
    return text;
}

json shares_of(const std::array<int, 3>& phones_at_level) {
    const int all = phones_at_level[0] + phones_at_level[1] + phones_at_level[2];
    json shares;
    for (std::size_t level = 0; level < 3; ++level) {
        shares[kLevelNames[level]] = all == 0 ? 0.0 : static_cast<double>(phones_at_level[level]) / all;
    }
    return shares;
}

}  // namespace

void Timeline::add(const Recital& recital, std::int64_t first_sample) {
    const Utterance& said = recital.utterance;
    const int first_word = static_cast<int>(whole_.words.size());
    const std::size_t first_phone = whole_.phones.phones.size();
    whole_.phones.sample_rate = said.phones.sample_rate;
    for (Word word : said.words) {
        word.begin += first_sample;
        word.end += first_sample;
        whole_.words.push_back(std::move(word));
    }
    for (TimedPhone phone : said.phones.phones) {
        phone.begin += first_sample;
        phone.end += first_sample;
        whole_.phones.phones.push_back(phone);
    }
    for (const int word : said.word_of_phone)
        whole_.word_of_phone.push_back(word < 0 ? -1 : word + first_word);
    levels_.resize(whole_.phones.phones.size(), UnitLevel::kExact);
    for (std::size_t slot = 0; slot < recital.selection.units.size(); ++slot) {
        UnitLevel& level = levels_[first_phone + recital.selection.slots[slot].phone];
        level = std::max(level, recital.selection.units[slot].level);
    }
}

json Timeline::words() const {
    json words = json::array();
    const double rate = whole_.phones.sample_rate;
    for (const Word& word : whole_.words) {
        words.push_back({{"text", word.text},
                         {"begin_s", static_cast<double>(word.begin) / rate},
                         {"end_s", static_cast<double>(word.end) / rate}});
    }
    return words;
}

json Timeline::phones() const {
    json phones = json::array();
    for (std::size_t i = 0; i < whole_.phones.phones.size(); ++i) {
        const TimedPhone& phone = whole_.phones.phones[i];
        const PhoneInfo& info = phone_info(phone.phone);
        phones.push_back({{"phone", info.name},
                          {"ipa", info.ipa},
                          {"stress", phone.stress},
                          {"begin_s", whole_.phones.begin_s(i)},
                          {"end_s", whole_.phones.end_s(i)},
                          {"unit", kLevelNames[static_cast<std::size_t>(levels_[i])]}});
    }
    return phones;
}

json viapoints_json(const Script& script, const SpeechRequest& request, const Talker& talker,
                    const std::function<void()>& check_wanted) {
    Timeline timeline;
    json points = json::array(), opening = json::array();
    std::array<int, 3> levels{};
    std::int64_t samples = 0;
    int rate = 0;
    for (std::size_t sentence = 0; sentence < script.size(); ++sentence) {
        check_wanted();
        const Recital recital = recite(talker.codex, script.utterance(sentence));
        const std::int64_t first = samples;
        rate = recital.utterance.sound.sample_rate;
        samples += static_cast<std::int64_t>(recital.utterance.sound.samples.size());
        timeline.add(recital, first);
        append(points, via_points(recital, static_cast<double>(first) / rate));
        append_opening(opening, recital, first, samples, rate);
        for (std::size_t level = 0; level < levels.size(); ++level)
            levels[level] += recital.selection.phones_at_level[level];
    }
    json layout = json::array();
    for (int point = 0; point < kPoints; ++point) layout.push_back(point_name(point));
    return {{"talker", talker.name()},
            {"voice", request.voice},
            {"units", "mm and s, head frame: x to the talker's left, y up, z forward"},
            {"motion", talker.motion_provenance()},
            {"sample_rate", rate},
            {"duration_s", static_cast<double>(samples) / rate},
            {"words", timeline.words()},
            {"phones", timeline.phones()},
            {"layout", layout},
            {"via_points", points},
            {"lip_opening", {{"rate_hz", kOpeningRate}, {"mm", opening}}},
            {"unit_shares", shares_of(levels)}};
}

json report_json(const SayRequest& request, const std::string& talker, const Timeline& timeline,
                 const SayReport& report) {
    return {
        {"talker", talker},
        {"voice", request.speech.recorded ? "recorded" : request.speech.voice},
        {"sample_rate", report.sample_rate},
        {"samples", report.samples},
        {"duration_s", static_cast<double>(report.samples) / report.sample_rate},
        {"frames", report.frames},
        {"fps", static_cast<double>(request.fps.numerator) / request.fps.denominator},
        {"size", std::to_string(request.view.width) + "x" + std::to_string(request.view.height)},
        {"words", timeline.words()},
        {"phones", timeline.phones()},
        {"unit_shares", shares_of(report.phones_at_level)},
        {"drawn_minus_commanded_mm",
         {{"rms", micrometre(report.rms_mm)}, {"max", micrometre(report.farthest_mm)}}},
        {"hashes", {{"sound", hexadecimal(report.sound_hash)}, {"motion", hexadecimal(report.motion_hash)}}}};
}

}  // namespace viaface

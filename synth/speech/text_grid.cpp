#include "synth/speech/text_grid.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.hpp"

namespace viaface {
namespace {

// ---- writing ----

std::string number(double value) {
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
    return result + "\"";
}

void write_tier(std::string& out, const IntervalTier& tier, std::size_t index, const TextGrid& grid) {
    out += "    item [" + std::to_string(index) + "]:\n        class = \"IntervalTier\"\n";
    out += "        name = " + quoted(tier.name) + "\n";
    out += "        xmin = " + number(grid.begin) + "\n        xmax = " + number(grid.end) + "\n";
    out += "        intervals: size = " + std::to_string(tier.intervals.size()) + "\n";
    for (std::size_t i = 0; i < tier.intervals.size(); ++i) {
        const LabelledInterval& interval = tier.intervals[i];
        out += "        intervals [" + std::to_string(i + 1) + "]:\n";
        out += "            xmin = " + number(interval.begin) +
               "\n            xmax = " + number(interval.end) + "\n";
        out += "            text = " + quoted(interval.text) + "\n";
    }
}

// ---- reading ----

class TokenReader {
  public:
    explicit TokenReader(std::string_view text) : text_(text) {}

    std::string string(const char* what) {
        const std::string_view token = next(what);
        if (token.front() != '"') refuse(token, what);
        std::string result;
        for (std::size_t i = 1; i + 1 < token.size(); ++i) {
            result += token[i];
            if (token[i] == '"') ++i;
        }
        return result;
    }

    double number(const char* what) {
        const std::string_view token = next(what);
        double value = 0;
        const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
        if (error != std::errc() || end != token.data() + token.size() || !std::isfinite(value))
            refuse(token, what);
        return value;
    }

    double time(const char* what) {
        constexpr double kLongest = 1e6;  // s, so that samples fit their counter
        const double value = number(what);
        if (std::abs(value) > kLongest) refuse(viaface::number(value), what);
        return value;
    }

    std::size_t count(const char* what) {
        const double value = number(what);
        if (!(value >= 0 && value <= 1e7) || value != std::floor(value)) refuse(std::to_string(value), what);
        return static_cast<std::size_t>(value);
    }

    std::string_view flag(const char* what) {
        const std::string_view token = next(what);
        if (token.front() != '<') refuse(token, what);
        return token;
    }

    [[noreturn]] void refuse(std::string_view token, const char* what) const {
        const auto line =
            1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(begin_), '\n');
        throw InputError("labels", "line " + std::to_string(line) + ": " + std::string(token), what);
    }

  private:
    static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

    static bool counts(std::string_view token) {
        const char c = token.front();
        return c == '"' || c == '<' || c == '-' || c == '+' || (c >= '0' && c <= '9');
    }

    std::size_t end_of_string() const {
        std::size_t i = begin_ + 1;
        while (i < text_.size() && (text_[i] != '"' || (i + 1 < text_.size() && text_[i + 1] == '"'))) {
            i += text_[i] == '"' ? 2 : 1;
        }
        if (i >= text_.size()) refuse("a string without end", "strings in double quotes");
        return i + 1;
    }

    std::string_view next(const char* what) {
        while (true) {
            while (at_ < text_.size() && is_space(text_[at_])) ++at_;
            begin_ = at_;
            if (at_ == text_.size()) refuse("the end of the file", what);
            const bool quotes = text_[at_] == '"', comment = text_[at_] == '!';
            if (quotes) {
                at_ = end_of_string();
            } else {
                while (at_ < text_.size() && (comment ? text_[at_] != '\n' : !is_space(text_[at_]))) ++at_;
            }
            const std::string_view token = text_.substr(begin_, at_ - begin_);
            if (counts(token)) return token;
        }
    }

    std::string_view text_;
    std::size_t at_ = 0, begin_ = 0;
};

LabelledInterval read_interval(TokenReader& reader, double not_before) {
    LabelledInterval interval;
    interval.begin = reader.time("the beginning of an interval, s");
    interval.end = reader.time("the end of an interval, s");
    constexpr double kRounding = 1e-6;  // s, of other writers
    if (interval.begin < not_before - kRounding || interval.end < interval.begin) {
        reader.refuse(number(interval.begin) + " to " + number(interval.end), "intervals in order");
    }
    interval.text = reader.string("the label of an interval");
    return interval;
}

IntervalTier read_intervals(TokenReader& reader, std::string name, double begin) {
    IntervalTier tier{std::move(name), {}};
    const std::size_t count = reader.count("the number of intervals");
    for (std::size_t i = 0; i < count; ++i) {
        tier.intervals.push_back(read_interval(reader, i == 0 ? begin : tier.intervals.back().end));
    }
    return tier;
}

void read_over_points(TokenReader& reader) {
    const std::size_t count = reader.count("the number of points");
    for (std::size_t i = 0; i < count; ++i) {
        reader.time("the time of a point, s");
        reader.string("the label of a point");
    }
}

void read_tier(TokenReader& reader, TextGrid& grid) {
    const std::string kind = reader.string("the class of a tier");
    std::string name = reader.string("the name of a tier");
    const double begin = reader.time("the beginning of a tier, s");
    reader.time("the end of a tier, s");
    if (kind == "IntervalTier") {
        grid.tiers.push_back(read_intervals(reader, std::move(name), begin));
    } else if (kind == "TextTier") {
        read_over_points(reader);
    } else {
        reader.refuse(kind, "IntervalTier or TextTier");
    }
}

// ---- utterances ----

IntervalTier& tier_of(TextGrid& grid, const std::string& name) {
    const auto found =
        std::find_if(grid.tiers.begin(), grid.tiers.end(), [&](const auto& t) { return t.name == name; });
    return found != grid.tiers.end() ? *found : grid.tiers.emplace_back(IntervalTier{name, {}});
}

// Pauses at the seam of two utterances are one.
void append_interval(IntervalTier& tier, const LabelledInterval& interval, bool silent) {
    if (silent && !tier.intervals.empty() && tier.intervals.back().text == interval.text) {
        tier.intervals.back().end = interval.end;
    } else {
        tier.intervals.push_back(interval);
    }
}

std::string arpabet(const TimedPhone& phone) {
    const PhoneInfo& info = phone_info(phone.phone);
    if (phone.phone == kPause) return std::string(info.name);
    std::string name(info.name);
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::toupper(c); });
    return info.vowel ? name + std::to_string(phone.stress) : name;
}

void append_words(TextGrid& grid, const Utterance& utterance, std::int64_t first_sample) {
    const auto seconds = [&](std::int64_t n) {
        return double(first_sample + n) / utterance.sound.sample_rate;
    };
    IntervalTier& tier = tier_of(grid, "words");
    std::int64_t now = 0;
    for (const Word& word : utterance.words) {
        if (word.begin > now) append_interval(tier, {seconds(now), seconds(word.begin), ""}, true);
        append_interval(tier, {seconds(word.begin), seconds(word.end), word.text}, false);
        now = word.end;
    }
    const auto end = static_cast<std::int64_t>(utterance.sound.samples.size());
    if (end > now) append_interval(tier, {seconds(now), seconds(end), ""}, true);
}

void append_timed(PhoneSequence& sequence, const StressedPhone& phone, std::int64_t end) {
    const std::int64_t begin = sequence.phones.empty() ? 0 : sequence.phones.back().end;
    if (end > begin) sequence.phones.push_back({phone.phone, phone.stress, begin, end});
}

StressedPhone labelled_phone(const LabelledInterval& interval) {
    const std::size_t first = interval.text.find_first_not_of(" \t");
    if (first == std::string::npos) return {kPause, 0};
    try {
        return parse_phone(interval.text.substr(first, interval.text.find_last_not_of(" \t") + 1 - first));
    } catch (const InputError& error) {
        throw InputError("labels", "phone " + interval.text + " at " + number(interval.begin) + " s",
                         error.allowed());
    }
}

}  // namespace

std::string write_text_grid(const TextGrid& grid) {
    std::string out = "File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\n";
    out += "xmin = " + number(grid.begin) + "\nxmax = " + number(grid.end) + "\n";
    out += "tiers? <exists>\nsize = " + std::to_string(grid.tiers.size()) + "\nitem []:\n";
    for (std::size_t i = 0; i < grid.tiers.size(); ++i) write_tier(out, grid.tiers[i], i + 1, grid);
    return out;
}

TextGrid read_text_grid(std::string_view text) {
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    TokenReader reader(text);
    constexpr const char* kKind = "a TextGrid as UTF-8 text: \"ooTextFile\", then \"TextGrid\"";
    for (const char* expected : {"ooTextFile", "TextGrid"}) {
        const std::string kind = reader.string(kKind);
        if (kind != expected) reader.refuse(kind, kKind);
    }
    constexpr const char* kTiers = "<exists> or <absent>";
    TextGrid grid;
    grid.begin = reader.time("the beginning, s");
    grid.end = reader.time("the end, s");
    if (grid.end < grid.begin) reader.refuse(number(grid.end), "an end after the beginning");
    const std::string_view tiers = reader.flag(kTiers);
    if (tiers == "<absent>") return grid;
    if (tiers != "<exists>") reader.refuse(tiers, kTiers);
    const std::size_t count = reader.count("the number of tiers");
    for (std::size_t i = 0; i < count; ++i) read_tier(reader, grid);
    return grid;
}

void append_to(TextGrid& grid, const Utterance& utterance, std::int64_t first_sample) {
    const auto seconds = [&](std::int64_t n) {
        return double(first_sample + n) / utterance.sound.sample_rate;
    };
    append_words(grid, utterance, first_sample);
    IntervalTier& tier = tier_of(grid, "phones");
    for (const TimedPhone& phone : utterance.phones.phones) {
        append_interval(tier, {seconds(phone.begin), seconds(phone.end), arpabet(phone)},
                        phone.phone == kPause);
    }
    grid.end = tier.intervals.back().end;
}

PhoneSequence phones_of(const TextGrid& grid, int sample_rate) {
    const auto tier =
        std::find_if(grid.tiers.begin(), grid.tiers.end(), [](const auto& t) { return t.name == "phones"; });
    if (tier == grid.tiers.end())
        throw InputError("labels", "no such tier", "a tier of intervals named \"phones\"");
    const auto sample = [&](double time) { return std::llround((time - grid.begin) * sample_rate); };
    PhoneSequence sequence{sample_rate, {}};
    for (const LabelledInterval& interval : tier->intervals) {
        append_timed(sequence, {kPause, 0}, sample(interval.begin));
        append_timed(sequence, labelled_phone(interval), sample(interval.end));
    }
    append_timed(sequence, {kPause, 0}, sample(grid.end));
    return sequence;
}

}  // namespace viaface

#include "synth/speech/text.hpp"

#include <algorithm>
#include <array>

#include "base/error.hpp"
#include "synth/speech/plain_text.hpp"

namespace viaface {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_lower(char c) { return c >= 'a' && c <= 'z'; }
bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_spoken(char c) { return is_digit(c) || is_lower(c) || is_upper(c); }
bool has_speech(std::string_view text) { return std::any_of(text.begin(), text.end(), is_spoken); }

char lower(char c) { return is_upper(c) ? static_cast<char>(c - 'A' + 'a') : c; }

// The number of words that digits and signs expand to is many times that of letters.
std::size_t weight(char c) { return c == ' ' || is_lower(c) ? 1 : is_upper(c) ? 2 : 6; }

std::size_t weight(std::string_view text) {
    std::size_t sum = 0;
    for (const char c : text) sum += weight(c);
    return sum;
}

void refuse_markup(std::string_view text) {
    for (std::size_t at = 0; (at = text.find('<', at)) != std::string_view::npos; ++at) {
        const std::size_t close = text.find('>', at);
        if (close == std::string_view::npos) return;
        const char mark = text[at + 1];
        if (!is_lower(mark) && !is_upper(mark) && mark != '/' && mark != '!' && mark != '?') continue;
        const std::string_view tag = text.substr(at, std::min<std::size_t>(close - at + 1, 40));
        throw InputError("text", std::string(tag), "plain text without SSML or other markup");
    }
}

std::vector<std::string_view> tokens(std::string_view paragraph) {
    std::vector<std::string_view> found;
    for (std::size_t at = paragraph.find_first_not_of(" \n"); at != std::string_view::npos;) {
        const std::size_t end = std::min(paragraph.find_first_of(" \n", at), paragraph.size());
        const std::string_view token = paragraph.substr(at, end - at);
        if (token.size() > kLongestToken) {
            throw InputError("text", std::string(token.substr(0, 40)) + "...",
                             "words of at most 100 characters");
        }
        found.push_back(token);
        at = paragraph.find_first_not_of(" \n", end);
    }
    return found;
}

// The token without what opens before and closes after it.
std::string_view core(std::string_view token) {
    const std::size_t first = token.find_first_not_of("\"'(");
    if (first == std::string_view::npos) return {};
    return token.substr(first, token.find_last_not_of("\"')") + 1 - first);
}

bool is_abbreviation(std::string_view word) {
    static constexpr std::array<std::string_view, 32> kNeverLast = {
        "mr.",  "mrs.", "ms.",  "dr.",  "prof.", "rev.", "hon.", "gen.", "col.",    "capt.",  "lt.",
        "sgt.", "maj.", "gov.", "sen.", "rep.",  "st.",  "mt.",  "ft.",  "vs.",     "e.g.",   "i.e.",
        "cf.",  "no.",  "nos.", "fig.", "vol.",  "pp.",  "eds.", "ca.",  "approx.", "messrs."};
    std::string plain(word);
    std::transform(plain.begin(), plain.end(), plain.begin(), lower);
    if (plain == "no.") return word.front() == 'N';  // "No. 7", but "I said no."
    const bool initial = word.size() == 2 && is_upper(word[0]) && word[0] != 'I';
    return initial || std::find(kNeverLast.begin(), kNeverLast.end(), plain) != kNeverLast.end();
}

bool ends_sentence(std::string_view token, std::string_view next) {
    const std::string_view word = core(token);
    if (word.empty()) return false;
    if (word.back() == '!' || word.back() == '?') return true;
    if (word.back() != '.') return false;
    const std::string_view following = core(next);
    const bool goes_on = !following.empty() && is_lower(following.front());
    return !goes_on && !is_abbreviation(word);
}

// How good a place to cut is after this token: 0 none better than a space, 2 a clause's end.
int break_after(std::string_view token) {
    const std::string_view word = core(token);
    if (word.empty() || word.find_last_of(".!?;:") == word.size() - 1) return 2;
    return word.back() == ',' || word == "-" || word == "--" ? 1 : 0;
}

// Of the first tokens that fit, those up to the best place to cut, but at least a third of them in weight.
std::size_t piece_size(const std::vector<std::string_view>& words, std::size_t from) {
    std::size_t sum = 0, best = from + 1;
    int best_break = -1;
    for (std::size_t i = from; i < words.size(); ++i) {
        sum += weight(words[i]) + 1;
        if (sum > kLongestSentence && i > from) return best - from;
        const int found = sum > kLongestSentence / 3 ? break_after(words[i]) : -1;
        if (found >= best_break) {
            best = i + 1;
            best_break = found;
        }
    }
    return words.size() - from;
}

std::string_view sign_name(char sign) {
    switch (sign) {
        case '<':
            return " less than ";
        case '>':
            return " greater than ";
        case '=':
            return " equals ";
        case '+':
            return " plus ";
        case '&':
            return " and ";
        case '@':
            return " at ";
        case '#':
            return " number ";
        default:
            return {};
    }
}

std::string with_named_signs(std::string_view piece) {
    std::string named;
    for (const char c : piece) {
        const std::string_view name = sign_name(c);
        named += name.empty() ? std::string_view(&c, 1) : name;
    }
    return named;
}

void append_pieces(const std::vector<std::string_view>& words, std::vector<std::string>& pieces) {
    for (std::size_t at = 0; at < words.size();) {
        const std::size_t end = at + piece_size(words, at);
        std::string piece;
        for (; at < end; ++at) piece += (piece.empty() ? "" : " ") + std::string(words[at]);
        if (has_speech(piece)) pieces.push_back(with_named_signs(piece));
    }
}

void append_sentences(std::string_view paragraph, std::vector<std::string>& pieces) {
    const std::vector<std::string_view> words = tokens(paragraph);
    std::vector<std::string_view> sentence;
    for (std::size_t i = 0; i < words.size(); ++i) {
        sentence.push_back(words[i]);
        if (i + 1 < words.size() && !ends_sentence(words[i], words[i + 1])) continue;
        append_pieces(sentence, pieces);
        sentence.clear();
    }
}

}  // namespace

std::vector<std::string> sentences(std::string_view text) {
    if (text.size() > kLongestText) {
        throw InputError("text", std::to_string(text.size()) + " bytes", "at most 20000 bytes of UTF-8");
    }
    const std::string plain = plain_text(text);
    refuse_markup(plain);
    std::vector<std::string> pieces;
    for (std::size_t at = 0; at < plain.size();) {
        const std::size_t end = std::min(plain.find("\n\n", at), plain.size());
        append_sentences(std::string_view(plain).substr(at, end - at), pieces);
        at = end + 2;
    }
    if (pieces.empty()) throw InputError("text", std::string(text), "text with at least one word");
    return pieces;
}

}  // namespace viaface

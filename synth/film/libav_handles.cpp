#include "synth/film/libav_handles.hpp"

#include <array>

namespace viaface::libav {
namespace {

[[maybe_unused]] const bool kQuiet = (av_log_set_level(AV_LOG_QUIET), true);

}  // namespace

void Free::operator()(AVFormatContext* format) const {
    if (format->iformat) {
        avformat_close_input(&format);
    } else {
        avformat_free_context(format);
    }
}

void Free::operator()(AVIOContext* io) const {
    av_freep(&io->buffer);
    avio_context_free(&io);
}

int check(int code, const char* what) {
    if (code >= 0) return code;
    std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
    av_strerror(code, text.data(), text.size());
    throw std::runtime_error(std::string(what) + ": " + text.data());
}

void with_options(const Options& options, const char* what, const std::function<int(AVDictionary**)>& open) {
    struct Dictionary {
        AVDictionary* entries = nullptr;
        ~Dictionary() { av_dict_free(&entries); }
    } dictionary;
    for (const auto& [key, value] : options) av_dict_set(&dictionary.entries, key, value.c_str(), 0);
    check(open(&dictionary.entries), what);
    if (av_dict_count(dictionary.entries) > 0) {
        throw std::runtime_error(std::string(what) + ": an option is unknown");
    }
}

}  // namespace viaface::libav

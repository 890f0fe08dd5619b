#include "server/http_body.hpp"

#include <httplib.h>

#include "server/json_fields.hpp"
#include "server/problem.hpp"

namespace viaface {
namespace {

constexpr std::size_t kMostRead = 16 * kLargestBody;  // bytes: what is too large is read on to be answered

struct Body {
    std::string text;
    bool whole = false, too_large = false;
};

Body read_body(const httplib::Request& request, const httplib::ContentReader& reader) {
    Body body;
    std::size_t received = 0;
    const auto take = [&](const char* bytes, std::size_t count) {
        received += count;
        if (received <= kLargestBody) body.text.append(bytes, count);
        return received <= kMostRead;
    };
    const auto take_part = [](const httplib::MultipartFormData&) { return true; };
    body.whole = request.is_multipart_form_data() ? reader(take_part, take) : reader(take);
    const auto length = request.get_header_value<std::uint64_t>("Content-Length");
    body.too_large = received > kLargestBody || length > kLargestBody;
    return body;
}

std::string whole_body(const httplib::Request& request, const httplib::ContentReader& reader,
                       const char* wanted) {
    Body body = read_body(request, reader);
    if (body.too_large) {
        throw HttpError(413, "Content Too Large",
                        "a body holds at most " + std::to_string(kLargestBody) + " bytes");
    }
    if (const std::string type = body_type(request); type != wanted)
        throw HttpError(415, "Unsupported Media Type", "\"" + type + "\" is not " + wanted);
    if (!body.whole) throw NotJson("the body cannot be read to its end");
    return std::move(body.text);
}

}  // namespace

std::string body_type(const httplib::Request& request) {
    const std::string type = request.get_header_value("Content-Type");
    return type.substr(0, type.find(';'));
}

Bytes via_body(const httplib::Request& request, const httplib::ContentReader& reader) {
    const std::string text = whole_body(request, reader, kViaType);
    return Bytes(text.begin(), text.end());
}

nlohmann::json json_body(const httplib::Request& request, const httplib::ContentReader& reader) {
    return parse_json(whole_body(request, reader, "application/json"));
}

}  // namespace viaface

// The body of a request, bounded however it is sent: with a length, in chunks, or compressed.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

#include "base/bytes.hpp"

namespace httplib {
class ContentReader;
struct Request;
}  // namespace httplib

namespace viaface {

inline constexpr std::size_t kLargestBody = 128 * 1024;  // bytes, after decompression

// HttpError 413 when it is too large, 415 when it is not said to be JSON; NotJson when it is none.
nlohmann::json json_body(const httplib::Request& request, const httplib::ContentReader& reader);

// "application/json" of "application/json; charset=utf-8"; empty when nothing is said.
std::string body_type(const httplib::Request& request);
inline constexpr const char* kViaType = "application/vnd.viaface.via";
Bytes via_body(const httplib::Request& request,
               const httplib::ContentReader& reader);  // likewise, of that type

}  // namespace viaface

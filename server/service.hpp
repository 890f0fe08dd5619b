// The HTTP service. POST /v1/videos streams a video as it is made, POST /v1/viapoints answers the via points;
// GET /v1/talkers, /v1/voices, /healthz, /openapi.json and the page at /.
//
// A service that stops cuts the streams that it has begun.
//
// Threads: one per connection, at most running + waiting + kSpareThreads; talkers are loaded once and shared
// as const; the Admission bounds the jobs. A job runs in its connection's thread; its film encodes in one
// more.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "synth/film/film_spec.hpp"

namespace viaface {

inline constexpr const char* kJsonType = "application/json";
const char* stream_type(FilmFormat format);               // video/mp4 or video/matroska [RFC 9559]
std::string content_type_of(std::string_view page_file);  // by its ending

struct ServiceOptions {
    std::string host = "127.0.0.1";
    int port = 8080;                // 0: any free one
    int running = 1;                // jobs at a time
    int waiting = 16;               // jobs that may wait for their turn
    std::filesystem::path talkers;  // the folder of the built-in talkers
};

class Service {
  public:
    // Loads the default talker and binds the port; InputError("host" or "port", ...) when that cannot be.
    explicit Service(const ServiceOptions& options);
    ~Service();

    int port() const;
    void listen();  // until stop()
    void stop();    // from any thread

    std::vector<std::string> routes() const;  // "GET /healthz", ...

  private:
    class Routes;
    std::unique_ptr<Routes> routes_;
};

}  // namespace viaface

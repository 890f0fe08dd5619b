// The HTTP service. POST /v1/videos streams a video as it is made, POST /v1/viapoints answers the via points;
// GET /v1/talkers, /v1/voices, /healthz, /openapi.json and the page at /.
//
// Threads: one per connection, at most running + waiting + kSpareThreads; talkers are loaded once and shared
// as const; the Admission bounds the jobs. A job runs in its connection's thread; its film encodes in one
// more.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace viaface {

inline constexpr std::size_t kLargestBody = 128 * 1024;  // bytes
inline constexpr const char* kStreamType = "video/mp4; codecs=\"avc1.640020, mp4a.40.2\"";

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
    void stop();    // from any thread, also from a signal's

  private:
    class Routes;
    std::unique_ptr<Routes> routes_;
};

}  // namespace viaface

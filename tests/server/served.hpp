// A service on loopback, and what clients of it need.
#pragma once

#include <httplib.h>
#undef _res

#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <thread>

#include "server/service.hpp"

namespace viaface {

inline ServiceOptions loopback() {
    ServiceOptions options;
    options.port = 0;
    options.talkers = std::string(VIAFACE_SOURCE_DIR) + "/talkers";
    return options;
}

class Served {
  public:
    explicit Served(const ServiceOptions& options = loopback())
        : service_(options), listening_([this] { service_.listen(); }) {}
    ~Served() { stop(); }
    Served(const Served&) = delete;
    Served& operator=(const Served&) = delete;

    void stop() {
        if (!listening_.joinable()) return;
        service_.stop();
        listening_.join();
    }
    httplib::Client client() const {
        httplib::Client client("127.0.0.1", service_.port());
        client.set_read_timeout(120);
        return client;
    }
    int port() const { return service_.port(); }
    std::vector<std::string> routes() const { return service_.routes(); }
    nlohmann::json get(const std::string& path) const {
        return nlohmann::json::parse(client().Get(path)->body);
    }

  private:
    Service service_;
    std::thread listening_;
};

inline httplib::Result post(httplib::Client client, const std::string& path, const nlohmann::json& body) {
    return client.Post(path, body.dump(), "application/json");
}

inline std::span<const std::uint8_t> bytes_of(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

// Whether it does within half a minute.
inline bool becomes(const std::function<bool()>& condition) {
    for (int tenth = 0; tenth < 300; ++tenth) {
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return false;
}

}  // namespace viaface

#include "tests/web/web_driver.hpp"

#include <httplib.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <stdexcept>
#include <thread>

namespace viaface {
namespace {

using nlohmann::json;

constexpr const char* kDriver = "/usr/bin/chromedriver";
constexpr const char* kBrowser = "/usr/bin/chromium";

// Starts the driver on a port of its own choice, which it tells on stdout.
int start_driver(int& port, WebDriver::Pipe& told) {
    int out[2];
    if (pipe(out) != 0) throw std::runtime_error("pipe failed");
    const int process = fork();
    if (process == 0) {
        setpgid(0, 0);
        prctl(PR_SET_PDEATHSIG, SIGTERM);
        dup2(out[1], STDOUT_FILENO);
        execl(kDriver, kDriver, "--port=0", nullptr);
        _exit(127);
    }
    close(out[1]);
    told.reset(fdopen(out[0], "r"));
    char line[512];
    std::cmatch match;
    while (std::fgets(line, sizeof line, told.get()) != nullptr) {
        if (std::regex_search(line, match, std::regex(R"(successfully on port (\d+))"))) {
            port = std::stoi(match[1]);
            break;
        }
    }
    return process;
}

json wanted(const std::string& profile) {
    const json arguments = {"--headless=new",
                            "--no-sandbox",
                            "--disable-gpu",
                            "--disable-quic",
                            "--no-first-run",
                            "--mute-audio",
                            "--autoplay-policy=no-user-gesture-required",
                            "--disable-background-networking",
                            "--disable-component-update",
                            "--disable-sync",
                            "--window-size=1000,1100",
                            "--user-data-dir=" + profile};
    return {{"capabilities",
             {{"alwaysMatch", {{"goog:chromeOptions", {{"binary", kBrowser}, {"args", arguments}}}}}}}};
}

std::string base64_decoded(const std::string& text) {
    static const std::string kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned bits = 0;
    int count = 0;
    for (const char c : text) {
        const auto digit = kDigits.find(c);
        if (digit == std::string::npos) continue;
        bits = (bits << 6) | static_cast<unsigned>(digit);
        count += 6;
        if (count >= 8) bytes += static_cast<char>((bits >> (count -= 8)) & 0xff);
    }
    return bytes;
}

}  // namespace

bool WebDriver::installed() { return std::filesystem::exists(kDriver) && std::filesystem::exists(kBrowser); }

WebDriver::WebDriver() {
    char folder[] = "/tmp/viaface_browser_XXXXXX";
    profile_ = mkdtemp(folder);
    process_ = start_driver(port_, told_);
    session_ = call("POST", "/session", wanted(profile_)).at("sessionId");
}

WebDriver::~WebDriver() {
    try {
        if (!session_.empty()) call("DELETE", "");
    } catch (const std::exception&) {
        std::fputs("the browser did not end by itself\n", stderr);
    }
    kill(-process_, SIGTERM);
    waitpid(process_, nullptr, 0);
    std::error_code ignored;
    std::filesystem::remove_all(profile_, ignored);
}

json WebDriver::call(const std::string& method, const std::string& path, const json& body) {
    httplib::Client client("127.0.0.1", port_);
    client.set_read_timeout(120);
    const std::string target = session_.empty() ? path : "/session/" + session_ + path;
    const auto answer =
        method == "DELETE" ? client.Delete(target) : client.Post(target, body.dump(), "application/json");
    if (!answer) throw std::runtime_error("chromedriver does not answer");
    const json value = json::parse(answer->body).at("value");
    if (answer->status != 200) throw std::runtime_error(value.dump());
    return value;
}

void WebDriver::open(const std::string& url) { call("POST", "/url", {{"url", url}}); }

void WebDriver::click(const std::string& css) {
    const json element = call("POST", "/element", {{"using", "css selector"}, {"value", css}});
    call("POST", "/element/" + element.begin().value().get<std::string>() + "/click");
}

json WebDriver::run(const std::string& script) {
    return call("POST", "/execute/sync", {{"script", script}, {"args", json::array()}});
}

bool WebDriver::wait_until(const std::string& expression, int seconds) {
    for (int tenth = 0; tenth < 10 * seconds; ++tenth) {
        if (run("return Boolean(" + expression + ");").get<bool>()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return false;
}

void WebDriver::save_screenshot(const std::string& path) {
    httplib::Client client("127.0.0.1", port_);
    const auto answer = client.Get("/session/" + session_ + "/screenshot");
    const std::string bytes = base64_decoded(json::parse(answer->body).at("value"));
    std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace viaface

// A headless Chromium driven through its ChromeDriver, as the W3C WebDriver protocol has it.
#pragma once

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

namespace viaface {

class WebDriver {
  public:
    struct Close {
        void operator()(FILE* file) const { std::fclose(file); }
    };
    using Pipe = std::unique_ptr<FILE, Close>;

    static bool installed();  // chromium and chromedriver are on this machine

    WebDriver();   // starts both; std::runtime_error when that fails
    ~WebDriver();  // ends both
    WebDriver(const WebDriver&) = delete;
    WebDriver& operator=(const WebDriver&) = delete;

    void open(const std::string& url);
    void click(const std::string& css);                           // a real click in the middle of the element
    nlohmann::json run(const std::string& script);                // the body of a function; what it returns
    bool wait_until(const std::string& expression, int seconds);  // false when it did not become true in time
    void save_screenshot(const std::string& path);

  private:
    nlohmann::json call(const std::string& method, const std::string& path,
                        const nlohmann::json& body = nlohmann::json::object());

    int process_ = -1, port_ = 0;
    Pipe told_;  // stdout of the driver, which ends when nobody holds it
    std::string session_, profile_;
};

}  // namespace viaface

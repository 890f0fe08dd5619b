// The page in a real browser: a click on Speak, and a video that plays with sound while the labels move.

#include <gtest/gtest.h>
#include <httplib.h>

#include <cstdlib>
#include <thread>

#include "server/service.hpp"
#include "tests/web/web_driver.hpp"

namespace viaface {
namespace {

class Page : public testing::Test {
  protected:
    void SetUp() override {
        if (!WebDriver::installed()) GTEST_SKIP() << "chromium and chromium-driver are not installed";
        ServiceOptions options;
        options.port = 0;
        options.talkers = std::string(VIAFACE_SOURCE_DIR) + "/talkers";
        service_ = std::make_unique<Service>(options);
        listening_ = std::thread([this] { service_->listen(); });
        browser_ = std::make_unique<WebDriver>();
        browser_->open("http://127.0.0.1:" + std::to_string(service_->port()) + "/");
    }
    void TearDown() override {
        browser_.reset();
        if (!service_) return;
        service_->stop();
        listening_.join();
    }

    void click_speak(const std::string& first = "") {
        ASSERT_TRUE(browser_->wait_until("document.querySelectorAll('#voice option').length === 4", 20));
        browser_->run(first);
        browser_->click("#speak");
    }
    // Several minutes of speech, made slower than it is sent.
    void begin_a_long_talk() {
        click_speak(
            "document.querySelector('#text').value = "
            "'This goes on and on, sentence after sentence. '.repeat(40);");
        ASSERT_TRUE(browser_->wait_until("document.querySelector('#video').currentTime > 0.1", 60));
    }
    int running() const {
        httplib::Client client("127.0.0.1", service_->port());
        return nlohmann::json::parse(client.Get("/healthz")->body)["running"];
    }
    bool becomes_idle() const {
        for (int tenth = 0; tenth < 300 && running() != 0; ++tenth)
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        return running() == 0;
    }

    std::unique_ptr<Service> service_;
    std::thread listening_;
    std::unique_ptr<WebDriver> browser_;
};

TEST_F(Page, ATalkerComesWithTheVoiceOfTheirOwn) {
    WebDriver& browser = *browser_;
    ASSERT_TRUE(browser.wait_until("document.querySelectorAll('#talker option').length === 4", 20));
    EXPECT_EQ(browser.run("return document.querySelector('#voice').value;"), "rms");
    browser.run(
        "const talker = document.querySelector('#talker'); talker.value = 'amara';"
        "talker.dispatchEvent(new Event('change'));");
    EXPECT_EQ(browser.run("return document.querySelector('#voice').value;"), "slt");
}

TEST_F(Page, AClickSpeaksAndTheVideoPlaysWithSound) {
    WebDriver& browser = *browser_;
    click_speak();
    ASSERT_TRUE(browser.wait_until("document.querySelector('#video').currentTime > 0.5", 60))
        << browser.run("return document.querySelector('#message').textContent;");
    EXPECT_EQ(browser.run("return document.querySelector('#video').videoWidth;"), 512);
    EXPECT_GT(
        browser.run("return document.querySelector('#video').webkitAudioDecodedByteCount;").get<double>(),
        1000);
    EXPECT_GT(browser.run("return document.querySelector('#video').webkitDecodedFrameCount;").get<double>(),
              5);

    const std::string shown = browser.run("return document.querySelector('#now').textContent;");
    EXPECT_TRUE(browser.wait_until(
        "document.querySelector('#now').textContent !== " + nlohmann::json(shown).dump(), 10));
    EXPECT_TRUE(browser.wait_until("document.querySelector('#video').ended", 60));
    const char* kSpokenDuration =
        "return fetch('/v1/viapoints', {method: 'POST', headers: {'Content-Type': 'application/json'}, body: "
        "JSON.stringify({text: document.querySelector('#text').value})}).then(a => a.json()).then(t => "
        "t.duration_s);";
    EXPECT_NEAR(browser.run("return document.querySelector('#video').duration;").get<double>(),
                browser.run(kSpokenDuration).get<double>(), 1.5 / 30);
    if (const char* picture = std::getenv("VIAFACE_PAGE_PICTURE")) browser.save_screenshot(picture);
}

TEST_F(Page, PlaysBeforeTheStreamHasEnded) {
    WebDriver& browser = *browser_;
    begin_a_long_talk();
    const double early = browser.run("return document.querySelector('#video').currentTime;");
    EXPECT_TRUE(browser.wait_until(
        "document.querySelector('#video').currentTime > " + std::to_string(early + 0.3), 30));
    EXPECT_EQ(running(), 1);  // the service still makes the film that plays
    EXPECT_TRUE(browser.run("return document.querySelector('#stop').checkVisibility();").get<bool>());
}

TEST_F(Page, StopEndsTheWorkOfTheService) {
    WebDriver& browser = *browser_;
    begin_a_long_talk();
    browser.click("#stop");
    EXPECT_TRUE(browser.wait_until("document.querySelector('#video').paused", 10));
    EXPECT_TRUE(becomes_idle());
    EXPECT_EQ(browser.run("return document.querySelector('#message').textContent;"), "Stopped.");
}

TEST_F(Page, ANewRequestEndsTheOneBefore) {
    WebDriver& browser = *browser_;
    begin_a_long_talk();
    browser.run("document.querySelector('#text').value = 'Hello.';");
    browser.click("#speak");
    EXPECT_TRUE(browser.wait_until("document.querySelector('#video').ended", 60));
    EXPECT_LT(browser.run("return document.querySelector('#video').duration;").get<double>(), 3);
    EXPECT_TRUE(becomes_idle());
}

TEST_F(Page, SaysWhatIsWrongWithTheText) {
    WebDriver& browser = *browser_;
    click_speak("document.querySelector('#text').value = '?!';");
    EXPECT_TRUE(
        browser.wait_until("document.querySelector('#message.error')?.textContent.includes('text')", 20));
}

}  // namespace
}  // namespace viaface

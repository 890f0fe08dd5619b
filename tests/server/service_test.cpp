// The service over real sockets on loopback.
#include "server/service.hpp"

#include <gtest/gtest.h>
#include <httplib.h>

#include <chrono>
#include <filesystem>
#include <future>
#include <nlohmann/json.hpp>
#include <thread>

#include "synth/film/media_reader.hpp"

namespace viaface {
namespace {

using nlohmann::json;

ServiceOptions loopback() {
    ServiceOptions options;
    options.port = 0;
    options.talkers = std::string(VIAFACE_SOURCE_DIR) + "/talkers";
    return options;
}

class Served {
  public:
    explicit Served(const ServiceOptions& options = loopback())
        : service_(options), listening_([this] { service_.listen(); }) {}
    ~Served() {
        service_.stop();
        listening_.join();
    }
    httplib::Client client() const {
        httplib::Client client("127.0.0.1", service_.port());
        client.set_read_timeout(120);
        return client;
    }
    json get(const std::string& path) const { return json::parse(client().Get(path)->body); }

  private:
    Service service_;
    std::thread listening_;
};

httplib::Result post(httplib::Client client, const std::string& path, const json& body) {
    return client.Post(path, body.dump(), "application/json");
}

std::span<const std::uint8_t> bytes_of(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

const json kSmall = {{"text", "My mother bought a boat."}, {"size", "128x128"}, {"fps", 25}};

TEST(Service, StreamsAVideoThatDecodesAndMatchesItsViaPoints) {
    const Served served;
    const auto video = post(served.client(), "/v1/videos", kSmall);
    ASSERT_TRUE(video);
    ASSERT_EQ(video->status, 200) << video->body;
    EXPECT_EQ(video->get_header_value("Transfer-Encoding"), "chunked");
    EXPECT_EQ(video->get_header_value("Content-Type").rfind("video/mp4", 0), 0u);

    const auto points = post(served.client(), "/v1/viapoints", {{"text", kSmall["text"]}});
    ASSERT_EQ(points->status, 200) << points->body;
    const json track = json::parse(points->body);
    const double duration = track["duration_s"];
    EXPECT_EQ(track["layout"].size(), 38u);
    EXPECT_EQ(track["via_points"][0]["points_mm"].size(), 114u);

    FrameReader frames(bytes_of(video->body));
    EXPECT_EQ(frames.width(), 128);
    int count = 0;
    while (frames.next()) ++count;
    EXPECT_EQ(count, std::ceil(duration * 25 - 1e-9));
    const auto sound = read_sound(bytes_of(video->body), 16000);
    EXPECT_NEAR(static_cast<double>(sound.size()) / 16000, count / 25.0, 1.0 / 25);
}

TEST(Service, FourAtOnceGiveEqualBytes) {
    ServiceOptions options = loopback();
    options.running = 4;
    const Served served(options);
    std::vector<std::future<std::string>> answers;
    for (int i = 0; i < 4; ++i) {
        answers.push_back(std::async(std::launch::async,
                                     [&] { return post(served.client(), "/v1/videos", kSmall)->body; }));
    }
    const std::string first = answers[0].get();
    EXPECT_GT(first.size(), 10000u);
    for (std::size_t i = 1; i < answers.size(); ++i) EXPECT_TRUE(answers[i].get() == first) << i;
}

struct Refused {
    json body;
    int status;
    std::string field;
};

TEST(Service, RefusesRubbishAsProblemsThatNameTheField) {
    const Served served;
    const std::string long_word(100 * 1024, 'a');
    const Refused cases[] = {
        {{{"text", ""}}, 422, "text"},
        {{{"text", "?!"}}, 422, "text"},
        {{{"text", long_word}}, 422, "text"},
        {{{"text", 3}}, 422, "text"},
        {{{"text", "Hi."}, {"phones", "aa1"}}, 422, "phones"},
        {{{"phones", "aa1 zz"}}, 422, "phones"},
        {{{"text", "Hi."}, {"voice", "nobody"}}, 422, "voice"},
        {{{"text", "Hi."}, {"talker", "nobody"}}, 422, "talker"},
        {{{"text", "Hi."}, {"talker", "../momo"}}, 422, "talker"},
        {{{"text", "Hi."}, {"format", "gif"}}, 422, "format"},
        {{{"text", "Hi."}, {"size", "0x0"}}, 422, "size"},
        {{{"text", "Hi."}, {"size", "100000x100000"}}, 422, "size"},
        {{{"text", "Hi."}, {"size", 512}}, 422, "size"},
        {{{"text", "Hi."}, {"fps", 0}}, 422, "fps"},
        {{{"text", "Hi."}, {"fps", "30"}}, 422, "fps"},
        {{{"text", "Hi."}, {"view", {{"yaw", 1e9}}}}, 422, "yaw"},
        {{{"text", "Hi."}, {"view", {{"zoom", 2}}}}, 422, "view.zoom"},
        {{{"text", "Hi."}, {"rate", -1}}, 422, "rate"},
        {{{"text", "Hi."}, {"colour", "red"}}, 422, "colour"},
        {json::array(), 422, "body"},
    };
    for (const Refused& refused : cases) {
        const auto answer = post(served.client(), "/v1/videos", refused.body);
        ASSERT_TRUE(answer) << refused.field;
        EXPECT_EQ(answer->status, refused.status) << refused.field << answer->body;
        EXPECT_EQ(answer->get_header_value("Content-Type"), "application/problem+json");
        EXPECT_EQ(json::parse(answer->body).value("field", ""), refused.field) << answer->body;
    }
}

TEST(Service, RefusesWhatIsNotJsonTooLongOrElsewhere) {
    const Served served;
    auto client = served.client();
    EXPECT_EQ(client.Post("/v1/videos", "{\"text\": ", "application/json")->status, 400);
    EXPECT_EQ(client.Post("/v1/videos", "{\"text\": \"\xff\"}", "application/json")->status, 400);
    EXPECT_EQ(client.Post("/v1/videos", "text=hi", "application/x-www-form-urlencoded")->status, 415);
    EXPECT_EQ(client.Post("/v1/videos", std::string(kLargestBody + 1, ' '), "application/json")->status, 413);
    const auto missing = client.Get("/v1/nothing");
    EXPECT_EQ(missing->status, 404);
    EXPECT_EQ(missing->get_header_value("Content-Type"), "application/problem+json");
}

TEST(Service, DescribesItself) {
    const Served served;
    EXPECT_EQ(served.get("/healthz")["status"], "ok");
    const json api = served.get("/openapi.json");
    EXPECT_EQ(api["openapi"], "3.1.0");
    for (const auto& [path, methods] : api["paths"].items()) {
        if (!methods.contains("get")) continue;
        EXPECT_EQ(served.client().Get(path)->status, 200) << path;
    }
    EXPECT_EQ(served.get("/v1/voices")["voices"].size(), 4u);
    EXPECT_EQ(served.get("/v1/talkers")["talkers"][0]["name"], "momo");
    EXPECT_NE(served.client().Get("/")->body.find("<video"), std::string::npos);
}

json long_request() {
    std::string text;
    for (int i = 0; i < 40; ++i)
        text += "This goes on and on, sentence after sentence, for quite some time. ";
    return {{"text", text}, {"size", "128x128"}};
}

bool becomes(const std::function<bool()>& condition) {
    for (int tenth = 0; tenth < 300; ++tenth) {
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return false;
}

TEST(Service, AClientThatLeavesStopsItsWork) {
    const Served served;
    auto client = served.client();
    std::size_t received = 0;
    httplib::Request request;
    request.method = "POST";
    request.path = "/v1/videos";
    request.body = long_request().dump();
    request.set_header("Content-Type", "application/json");
    request.content_receiver = [&](const char*, std::size_t size, std::uint64_t, std::uint64_t) {
        return (received += size) < 20000;
    };
    const auto answer = client.send(request);
    EXPECT_FALSE(answer);
    client.stop();
    EXPECT_TRUE(becomes([&] { return served.get("/healthz")["running"] == 0; }));
}

TEST(Service, AFullQueueAnswers503WithRetryAfter) {
    ServiceOptions options = loopback();
    options.waiting = 0;
    const Served served(options);
    auto busy = served.client();
    std::thread job([&] { busy.Post("/v1/videos", long_request().dump(), "application/json"); });
    EXPECT_TRUE(becomes([&] { return served.get("/healthz")["running"] == 1; }));
    const auto refused = post(served.client(), "/v1/videos", kSmall);
    EXPECT_EQ(refused->status, 503);
    EXPECT_EQ(refused->get_header_value("Retry-After"), "5");
    busy.stop();
    job.join();
}

}  // namespace
}  // namespace viaface

// The service over real sockets on loopback.
#include "server/service.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <future>
#include <set>

#include "server/http_body.hpp"
#include "server/json_fields.hpp"
#include "synth/film/media_reader.hpp"
#include "synth/talker/stream_models.hpp"
#include "tests/server/served.hpp"
#include "viapoints/via_stream.hpp"

namespace viaface {
namespace {

using nlohmann::json;

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

TEST(Service, StreamsLosslessMatroskaToo) {
    const Served served;
    json asked = kSmall;
    asked["format"] = "mkv";
    const auto video = post(served.client(), "/v1/videos", asked);
    ASSERT_EQ(video->status, 200) << video->body;
    EXPECT_EQ(video->get_header_value("Content-Type"), "video/matroska");
    EXPECT_EQ(video->get_header_value("Transfer-Encoding"), "chunked");
    const auto lossy = post(served.client(), "/v1/videos", kSmall);
    FrameReader frames(bytes_of(video->body)), others(bytes_of(lossy->body));
    int count = 0;
    while (frames.next()) {
        EXPECT_TRUE(others.next()) << count;
        ++count;
    }
    EXPECT_FALSE(others.next());
    EXPECT_GT(count, 25);
    EXPECT_EQ(read_sound(bytes_of(video->body), 16000).size(), static_cast<std::size_t>(count) * 16000 / 25);
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
        {{{"text", "\xf0\x9f\x98\x80\xf0\x9f\x8e\x89"}}, 422, "text"},  // two emoji
        {{{"text", std::string("Hi\0there.", 9)}}, 422, "text"},
        {{{"text", long_word}}, 422, "text"},
        {{{"text", 3}}, 422, "text"},
        {{{"text", "Hi."}, {"phones", "aa1"}}, 422, "phones"},
        {{{"phones", "aa1 zz"}}, 422, "phones"},
        {{{"text", "Hi."}, {"voice", "nobody"}}, 422, "voice"},
        {{{"text", "Hi."}, {"talker", "nobody"}}, 422, "talker"},
        {{{"text", "Hi."}, {"talker", "../momo"}}, 422, "talker"},
        {{{"text", "Hi."}, {"format", "gif"}}, 422, "format"},
        {{{"text", "Hi."}, {"format", "png"}}, 422, "format"},
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

TEST(Service, AnswersViaPointsAsAStreamAndDrawsOne) {
    const Served served;
    auto client = served.client();
    const auto stream = client.Post("/v1/viapoints", {{"Accept", kViaType}},
                                    json{{"phones", "b:90 aa1:150"}}.dump(), "application/json");
    ASSERT_TRUE(stream);
    ASSERT_EQ(stream->status, 200) << stream->body;
    EXPECT_EQ(stream->get_header_value("Content-Type"), kViaType);
    const auto models = all_stream_models(loopback().talkers);
    std::vector<const StreamModel*> at_hand;
    for (const StreamModel& model : models) at_hand.push_back(&model);
    const DecodedStream decoded = decode_stream(bytes_of(stream->body), at_hand);
    EXPECT_TRUE(decoded.damage.empty()) << decoded.describe_damage();
    EXPECT_GE(decoded.phones.size(), 2u);
    const auto film = client.Post("/v1/videos", stream->body, kViaType);
    ASSERT_TRUE(film);
    EXPECT_EQ(film->status, 200) << film->body;
    EXPECT_EQ(film->get_header_value("Content-Type"), "video/mp4");
    EXPECT_EQ(film->body.substr(4, 4), "ftyp");
    EXPECT_EQ(FrameReader(bytes_of(film->body)).width(), 512);
    const auto small =
        client.Post("/v1/videos?size=64x48&fps=15&format=mkv&talker=momo", stream->body, kViaType);
    ASSERT_EQ(small->status, 200) << small->body;
    EXPECT_EQ(small->get_header_value("Content-Type"), "video/matroska");
    FrameReader frames(bytes_of(small->body));
    EXPECT_EQ(frames.width(), 64);
    int count = 0;
    while (frames.next()) ++count;
    EXPECT_NEAR(count, 15 * (decoded.end_s() - decoded.begin_s()), 1);
    for (const auto& [query, field] :
         {std::pair("talker=nobody", "talker"), std::pair("size=64", "size"), std::pair("size=0x0", "size"),
          std::pair("fps=fast", "fps"), std::pair("fps=1e9", "fps"), std::pair("fps=25&fps=30", "fps"),
          std::pair("format=gif", "format"), std::pair("seed=-1", "seed"), std::pair("yaw=3", "yaw")}) {
        const auto refused = client.Post(std::string("/v1/videos?") + query, stream->body, kViaType);
        EXPECT_EQ(refused->status, 422) << query << refused->body;
        EXPECT_EQ(json::parse(refused->body).value("field", ""), field) << query;
    }
    for (const std::string& rubbish : {std::string(), std::string("hello"), stream->body.substr(0, 20)}) {
        const auto refused = client.Post("/v1/videos", rubbish, kViaType);
        EXPECT_EQ(refused->status, 422) << refused->body;
        EXPECT_EQ(json::parse(refused->body).value("field", ""), "stream");
    }
}

TEST(Service, AnswersViaPointsInTheTypeThatAClientPrefers) {
    const Served served;
    const auto type_for = [&](const httplib::Headers& headers) {
        const auto answer =
            served.client().Post("/v1/viapoints", headers, R"({"phones": "aa1:100"})", "application/json");
        return std::to_string(answer->status) + " " + answer->get_header_value("Content-Type");
    };
    const std::string via = std::string("200 ") + kViaType, plain = "200 application/json";
    EXPECT_EQ(type_for({{"Accept", std::string(kViaType) + ", */*;q=0.1"}}), via);
    EXPECT_EQ(type_for({{"Accept", "application/json;q=0.5"}, {"Accept", kViaType}}), via);
    EXPECT_EQ(type_for({{"Accept", "text/html, */*;q=0.8"}}), plain);
    EXPECT_EQ(type_for({{"Accept", std::string("application/json, ") + kViaType + ";q=0.9"}}), plain);
    EXPECT_EQ(type_for({{"Accept", "text/html"}}), "406 application/problem+json");
}

TEST(Service, RefusesWhatIsNotJsonTooLongOrElsewhere) {
    const Served served;
    auto client = served.client();
    EXPECT_EQ(client.Post("/v1/videos", "{\"text\": ", "application/json")->status, 400);
    EXPECT_EQ(client.Post("/v1/videos", "{\"text\": \"\xff\"}", "application/json")->status, 400);
    EXPECT_EQ(client.Post("/v1/videos", R"({"text": "Hi.", "fps": NaN})", "application/json")->status, 400);
    EXPECT_EQ(client.Post("/v1/videos", R"({"text": "Hi.", "fps": 1e999})", "application/json")->status, 400);
    EXPECT_EQ(client.Post("/v1/videos", "text=hi", "application/x-www-form-urlencoded")->status, 415);
    EXPECT_EQ(client.Post("/v1/videos", std::string(kLargestBody + 1, ' '), "application/json")->status, 413);
    EXPECT_EQ(client.Post("/v1/videos", std::string(kDeepestJson + 1, '['), "application/json")->status, 400);
    EXPECT_EQ(client.Post("/v1/videos", std::string(100000, '['), "application/json")->status, 400);
    const auto missing = client.Get("/v1/nothing");
    EXPECT_EQ(missing->status, 404);
    EXPECT_EQ(missing->get_header_value("Content-Type"), "application/problem+json");
}

TEST(Service, RefusesWhatIsTooLargeHoweverItIsSent) {
    const Served served;
    const std::string spaces(10'000'000, ' ');
    auto compressed = served.client();
    compressed.set_compress(true);
    EXPECT_EQ(compressed.Post("/v1/videos", spaces, "application/json")->status, 413);
    const auto in_chunks = [&](std::size_t offset, httplib::DataSink& sink) {
        if (offset >= 2 * kLargestBody) sink.done();
        return offset >= 2 * kLargestBody || sink.write(spaces.data(), 10000);
    };
    const auto chunked = served.client().Post("/v1/viapoints", in_chunks, "application/json");
    ASSERT_TRUE(chunked);
    EXPECT_EQ(chunked->status, 413);
    EXPECT_EQ(json::parse(chunked->body)["status"], 413);
}

TEST(Service, TellsWhichMethodAPathIsServedTo) {
    const Served served;
    const auto answer = served.client().Delete("/v1/videos");
    EXPECT_EQ(answer->status, 405);
    EXPECT_EQ(answer->get_header_value("Allow"), "POST");
    EXPECT_EQ(json::parse(answer->body)["status"], 405);
    EXPECT_EQ(served.client().Get("/v1/viapoints")->get_header_value("Allow"), "POST");
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
    std::set<std::string> talkers;
    const json told = served.get("/v1/talkers");
    for (const json& talker : told["talkers"]) {
        talkers.insert(talker["name"]);
        EXPECT_NE(talker["summary"].get<std::string>().find("performed by a model"), std::string::npos);
    }
    EXPECT_EQ(talkers, (std::set<std::string>{"amara", "edwin", "momo", "sumi"}));
    EXPECT_NE(served.client().Get("/")->body.find("<video"), std::string::npos);
}

TEST(Service, TheTalkersOwnVoiceIsHeardWhereNoneIsNamed) {
    const Served served;
    const auto heard = [&](const json& body) -> std::string {
        return json::parse(post(served.client(), "/v1/viapoints", body)->body)["voice"];
    };
    EXPECT_EQ(heard({{"text", "Hi."}}), "rms");
    EXPECT_EQ(heard({{"text", "Hi."}, {"talker", "amara"}}), "slt");
    EXPECT_EQ(heard({{"text", "Hi."}, {"talker", "edwin"}}), "awb");
    EXPECT_EQ(heard({{"text", "Hi."}, {"talker", "amara"}, {"voice", "kal16"}}), "kal16");
}

json long_request() {
    std::string text;
    for (int i = 0; i < 40; ++i)
        text += "This goes on and on, sentence after sentence, for quite some time. ";
    return {{"text", text}, {"size", "128x128"}};
}

// Asks for a long film and leaves once some of it has come; with 0, once it waits for its turn.
class Leaving {
  public:
    Leaving(const Served& served, std::size_t most) : client_(served.client()) {
        request_.method = "POST";
        request_.path = "/v1/videos";
        request_.body = long_request().dump();
        request_.set_header("Content-Type", "application/json");
        request_.content_receiver = [this, most](const char*, std::size_t size, std::uint64_t,
                                                 std::uint64_t) { return (received_ += size) < most; };
        asking_ = std::thread([this] { answered_ = static_cast<bool>(client_.send(request_)); });
    }
    ~Leaving() { leave(); }
    void leave() {
        if (!asking_.joinable()) return;
        client_.stop();
        asking_.join();
    }
    std::size_t received() const { return received_; }

  private:
    httplib::Client client_;
    httplib::Request request_;
    std::atomic<std::size_t> received_ = 0;
    bool answered_ = false;
    std::thread asking_;
};

TEST(Service, AClientThatLeavesStopsItsWork) {
    const Served served;
    Leaving leaving(served, 20000);
    EXPECT_TRUE(becomes([&] { return leaving.received() >= 20000; }));
    leaving.leave();
    EXPECT_TRUE(becomes([&] { return served.get("/healthz")["running"] == 0; }));
}

// Minutes of speech, whose stream nobody waits for.
TEST(Service, AClientThatLeavesStopsTheWorkOnItsViaPoints) {
    const Served served;
    std::string text;
    while (text.size() < 15000) text += "This goes on and on, sentence after sentence, for quite some time. ";
    auto client = served.client();
    client.set_read_timeout(0, 300'000);  // us
    EXPECT_FALSE(client.Post("/v1/viapoints", {{"Accept", kViaType}}, json{{"text", text}}.dump(),
                             "application/json"));
    client.stop();
    EXPECT_TRUE(becomes([&] { return served.get("/healthz")["running"] == 0; }));
}

TEST(Service, AClientThatLeavesTheQueueFreesItsPlace) {
    const Served served;
    Leaving busy(served, SIZE_MAX);
    EXPECT_TRUE(becomes([&] { return served.get("/healthz")["running"] == 1; }));
    Leaving waiting(served, SIZE_MAX);
    EXPECT_TRUE(becomes([&] { return served.get("/healthz")["waiting"] == 1; }));
    waiting.leave();
    EXPECT_TRUE(becomes([&] { return served.get("/healthz")["waiting"] == 0; }));
    EXPECT_EQ(served.get("/healthz")["running"], 1);
}

TEST(Service, StopsBeforeItListensToo) {
    for (int i = 0; i < 3; ++i) Served().stop();
    Service never(loopback());
    never.stop();
    never.listen();  // returns
}

TEST(Service, StopsWithoutWaitingForItsFilms) {
    Served served;
    std::string film;
    std::thread job([&, client = served.client()]() mutable {
        const auto answer = client.Post("/v1/videos", long_request().dump(), "application/json");
        if (answer) film = "whole";
    });
    EXPECT_TRUE(becomes([&] { return served.get("/healthz")["running"] == 1; }));
    served.stop();
    job.join();
    EXPECT_EQ(film, "");  // cut
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

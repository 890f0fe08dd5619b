// A film to a client over a real connection: whole with its closing chunk, or cut without it.
#include "server/film_stream.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <thread>

namespace viaface {
namespace {

const FilmSpec kSpec{64, 64, {25, 1}, FilmFormat::kMp4, 16000};

void add_second(FilmWriter& film) {
    const std::vector<std::int16_t> sound(16000, 0);
    const Frame frame{64, 64, std::vector<std::uint8_t>(64 * 64 * 4, 90)};
    film.add_sound(sound);
    for (int n = 0; n < 25; ++n) film.add_frame(view(frame));
}

// Streams what is performed to whoever asks.
class Streaming {
  public:
    explicit Streaming(const std::function<void(FilmWriter&)>& perform) {
        server_.Get("/", [this, perform](const auto&, auto& response) {
            response.set_chunked_content_provider(
                "video/mp4", [this, perform](std::size_t, httplib::DataSink& client) {
                    return whole_ = stream_film(kSpec, client, stopping, perform);
                });
        });
        port_ = server_.bind_to_any_port("127.0.0.1");
        listening_ = std::thread([this] { server_.listen_after_bind(); });
    }
    ~Streaming() {
        server_.stop();
        listening_.join();
    }

    // All that comes until the connection is closed.
    std::string answer() const {
        const int connection = socket(AF_INET, SOCK_STREAM, 0);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(port_));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        EXPECT_EQ(connect(connection, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
        const std::string asked = "GET / HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n";
        EXPECT_EQ(send(connection, asked.data(), asked.size(), 0), static_cast<ssize_t>(asked.size()));
        std::string received;
        std::vector<char> piece(4096);
        for (ssize_t count = 0; (count = recv(connection, piece.data(), piece.size(), 0)) > 0;)
            received.append(piece.data(), static_cast<std::size_t>(count));
        close(connection);
        return received;
    }
    bool whole() const { return whole_; }

    std::atomic<bool> stopping = false;

  private:
    httplib::Server server_;
    int port_ = 0;
    std::thread listening_;
    std::atomic<bool> whole_ = false;
};

constexpr const char* kClosingChunk = "\r\n0\r\n\r\n";

TEST(FilmStream, AWholeFilmEndsWithTheClosingChunk) {
    const Streaming streaming([](FilmWriter& film) {
        add_second(film);
        film.finish();
    });
    const std::string answer = streaming.answer();
    EXPECT_TRUE(answer.ends_with(kClosingChunk));
    EXPECT_TRUE(streaming.whole());
}

TEST(FilmStream, AFilmThatFailsIsCutWithoutTheClosingChunk) {
    const Streaming streaming([](FilmWriter& film) {
        add_second(film);
        throw std::runtime_error("the performance failed");
    });
    const std::string answer = streaming.answer();
    EXPECT_EQ(answer.rfind("HTTP/1.1 200", 0), 0u);
    EXPECT_NE(answer.find("moof"), std::string::npos);  // it had begun
    EXPECT_FALSE(answer.ends_with(kClosingChunk));
    EXPECT_FALSE(streaming.whole());
}

TEST(FilmStream, AServiceThatStopsCutsItsStreams) {
    Streaming* running = nullptr;
    Streaming streaming([&](FilmWriter& film) {
        add_second(film);
        running->stopping = true;
        for (int second = 0; second < 1000; ++second) add_second(film);
        film.finish();
    });
    running = &streaming;
    EXPECT_FALSE(streaming.answer().ends_with(kClosingChunk));
    EXPECT_FALSE(streaming.whole());
}

}  // namespace
}  // namespace viaface

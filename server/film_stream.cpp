#include "server/film_stream.hpp"

#include <httplib.h>

#include "server/problem.hpp"

namespace viaface {

bool send_whole(httplib::DataSink& client, const std::atomic<bool>& stopping,
                const std::function<std::string(const std::function<void()>&)>& make) {
    try {
        const std::string made = make([&] {
            if (stopping || !client.is_writable()) throw ClientLeft();
        });
        if (!client.write(made.data(), made.size())) return false;
        client.done();
        return true;
    } catch (const ClientLeft&) {
        return false;
    } catch (const std::exception& error) {
        log_failure(error);
        return false;
    }
}

bool stream_film(const FilmSpec& spec, httplib::DataSink& client, const std::atomic<bool>& stopping,
                 const std::function<void(FilmWriter&)>& perform) {
    try {
        const auto film = open_film(spec, [&](std::span<const std::uint8_t> piece) {
            return !stopping && client.write(reinterpret_cast<const char*>(piece.data()), piece.size());
        });
        perform(*film);
        client.done();
        return true;
    } catch (const ClientLeft&) {
        return false;
    } catch (const std::exception& error) {
        log_failure(error);
        return false;
    }
}

}  // namespace viaface

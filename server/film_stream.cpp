#include "server/film_stream.hpp"

#include <httplib.h>

#include "server/problem.hpp"

namespace viaface {
namespace {

// False, which cuts the connection, when the work fails or nobody waits for it any more.
bool carried_out(const std::function<bool()>& work) {
    try {
        return work();
    } catch (const ClientLeft&) {
        return false;
    } catch (const std::exception& error) {
        log_failure(error);
        return false;
    }
}

}  // namespace

bool send_whole(httplib::DataSink& client, const std::atomic<bool>& stopping,
                const std::function<std::string(const std::function<void()>&)>& make) {
    return carried_out([&] {
        const std::string made = make([&] {
            if (stopping || !client.is_writable()) throw ClientLeft();
        });
        if (!client.write(made.data(), made.size())) return false;
        client.done();
        return true;
    });
}

bool stream_film(const FilmSpec& spec, httplib::DataSink& client, const std::atomic<bool>& stopping,
                 const std::function<void(FilmWriter&)>& perform) {
    return carried_out([&] {
        const auto film = open_film(spec, [&](std::span<const std::uint8_t> piece) {
            return !stopping && client.write(reinterpret_cast<const char*>(piece.data()), piece.size());
        });
        perform(*film);
        client.done();
        return true;
    });
}

}  // namespace viaface

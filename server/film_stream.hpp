// A film to a client of the service while it is made, and other answers that take work.
#pragma once

#include <atomic>
#include <functional>

#include "synth/film/film_writer.hpp"

namespace httplib {
class DataSink;
}

namespace viaface {

// Performs into a stream to the client. True when the film is whole and closed. False when the performance
// failed (which the log tells), the client left or `stopping` was set: the connection is then to be cut,
// without the closing chunk that would make a part look whole.
bool stream_film(const FilmSpec& spec, httplib::DataSink& client, const std::atomic<bool>& stopping,
                 const std::function<void(FilmWriter&)>& perform);

// Sends at once what `make` makes, which is to call its argument now and then: that throws when nobody waits
// any longer. True and false as above.
bool send_whole(httplib::DataSink& client, const std::atomic<bool>& stopping,
                const std::function<std::string(const std::function<void()>& check_wanted)>& make);

}  // namespace viaface

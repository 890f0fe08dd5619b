// Draws while it encodes: hands frames and sound through a bounded queue to a film writer in a thread of its
// own.
//
// Sharing: one caller's thread; the inner writer is touched by the inner thread alone until it has ended. A
// call copies what it is given and blocks while the queue is full. What the inner writer throws is thrown by
// the caller's next call, and by each call after it. Destruction before finish() drops what waits and joins
// the thread.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <variant>
#include <vector>

#include "synth/film/film_writer.hpp"

namespace viaface {

class OverlappedWriter : public FilmWriter {
  public:
    static constexpr std::size_t kQueue = 4;  // frames or pieces of sound that wait at most

    explicit OverlappedWriter(std::unique_ptr<FilmWriter> inner);
    ~OverlappedWriter() override;
    OverlappedWriter(const OverlappedWriter&) = delete;
    OverlappedWriter& operator=(const OverlappedWriter&) = delete;

    void add_frame(const FrameView& frame) override;
    void add_sound(std::span<const std::int16_t> samples) override;
    void finish() override;

  private:
    struct End {};
    using Item = std::variant<Frame, std::vector<std::int16_t>, End>;

    void push(Item item);
    void run();
    bool take(Item& item);
    void carry_out(const Item& item);

    std::unique_ptr<FilmWriter> inner_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Item> queue_;
    std::exception_ptr error_;
    bool abandoned_ = false, end_sent_ = false, ended_ = false;
    std::thread thread_;
};

}  // namespace viaface

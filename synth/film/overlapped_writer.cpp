#include "synth/film/overlapped_writer.hpp"

#include <cstring>

namespace viaface {
namespace {

Frame copy(const FrameView& from) {
    const std::size_t row = std::size_t{4} * static_cast<std::size_t>(from.width);
    Frame to{from.width, from.height, {}};
    to.rgba.resize(row * static_cast<std::size_t>(from.height));
    for (int y = 0; y < from.height; ++y) {
        std::memcpy(to.rgba.data() + row * static_cast<std::size_t>(y), from.top_row + from.stride * y, row);
    }
    return to;
}

}  // namespace

OverlappedWriter::OverlappedWriter(std::unique_ptr<FilmWriter> inner)
    : inner_(std::move(inner)), thread_([this] { run(); }) {}

OverlappedWriter::~OverlappedWriter() {
    {
        const std::lock_guard lock(mutex_);
        abandoned_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void OverlappedWriter::add_frame(const FrameView& frame) { push(copy(frame)); }

void OverlappedWriter::add_sound(std::span<const std::int16_t> samples) {
    push(std::vector<std::int16_t>(samples.begin(), samples.end()));
}

void OverlappedWriter::finish() {
    push(End{});
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return ended_; });
    if (error_) std::rethrow_exception(error_);
}

void OverlappedWriter::push(Item item) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return ended_ || queue_.size() < kQueue; });
    if (error_) std::rethrow_exception(error_);
    if (end_sent_) throw std::logic_error("the film is already finished");
    end_sent_ = std::holds_alternative<End>(item);
    queue_.push_back(std::move(item));
    changed_.notify_all();
}

void OverlappedWriter::run() {
    std::exception_ptr error;
    try {
        for (Item item; take(item);) carry_out(item);
    } catch (...) {
        error = std::current_exception();
    }
    inner_.reset();
    const std::lock_guard lock(mutex_);
    error_ = error;
    ended_ = true;
    changed_.notify_all();
}

bool OverlappedWriter::take(Item& item) {
    if (std::holds_alternative<End>(item)) return false;
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return abandoned_ || !queue_.empty(); });
    if (abandoned_) return false;
    item = std::move(queue_.front());
    queue_.pop_front();
    changed_.notify_all();
    return true;
}

void OverlappedWriter::carry_out(const Item& item) {
    if (const auto* frame = std::get_if<Frame>(&item)) {
        inner_->add_frame(view(*frame));
    } else if (const auto* samples = std::get_if<std::vector<std::int16_t>>(&item)) {
        inner_->add_sound(*samples);
    } else {
        inner_->finish();
    }
}

}  // namespace viaface

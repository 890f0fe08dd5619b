#include "synth/film/overlapped_writer.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <string>

namespace viaface {
namespace {

struct Log {
    std::string calls;
    bool destroyed = false;
};

// Writes down what it is asked; waits for a gate, and throws at a given frame, when told to.
class Recorder : public FilmWriter {
  public:
    explicit Recorder(Log& log, int throw_at = -1, std::shared_future<void> gate = {})
        : log_(log), throw_at_(throw_at), gate_(std::move(gate)) {}
    ~Recorder() override { log_.destroyed = true; }

    void add_frame(const FrameView& frame) override {
        if (gate_.valid()) gate_.wait();
        if (frame.top_row[0] == throw_at_) throw std::out_of_range("at that frame");
        log_.calls += "f" + std::to_string(frame.top_row[0]) + " ";
    }
    void add_sound(std::span<const std::int16_t> samples) override {
        log_.calls += "s" + std::to_string(samples.front()) + " ";
    }
    void finish() override { log_.calls += "end"; }

  private:
    Log& log_;
    int throw_at_;
    std::shared_future<void> gate_;
};

Frame numbered(std::uint8_t n) { return {1, 1, {n, 0, 0, 255}}; }

TEST(OverlappedWriter, HandsOnEverythingInOrder) {
    Log log;
    OverlappedWriter writer(std::make_unique<Recorder>(log));
    std::string expected;
    for (std::uint8_t n = 0; n < 100; ++n) {
        const std::vector<std::int16_t> sound{n};
        writer.add_sound(sound);
        writer.add_frame(view(numbered(n)));
        expected += "s" + std::to_string(n) + " f" + std::to_string(n) + " ";
    }
    writer.finish();
    EXPECT_EQ(log.calls, expected + "end");
    EXPECT_THROW(writer.add_frame(view(numbered(0))), std::logic_error);
    EXPECT_THROW(writer.finish(), std::logic_error);
}

TEST(OverlappedWriter, HoldsNoMoreThanItsQueue) {
    Log log;
    std::promise<void> gate;
    OverlappedWriter writer(std::make_unique<Recorder>(log, -1, gate.get_future().share()));
    std::atomic<std::size_t> taken = 0;
    std::thread caller([&] {
        for (std::uint8_t n = 0; n < 50; ++n, ++taken) writer.add_frame(view(numbered(n)));
    });
    while (taken < OverlappedWriter::kQueue) std::this_thread::yield();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_LE(taken, OverlappedWriter::kQueue + 1);  // and the one inside the inner writer
    gate.set_value();
    caller.join();
    EXPECT_EQ(taken, 50u);
}

TEST(OverlappedWriter, ThrowsWhatTheInnerWriterThrewOnEveryLaterCall) {
    Log log;
    OverlappedWriter writer(std::make_unique<Recorder>(log, 2));
    const auto add_all = [&] {
        for (std::uint8_t n = 0; n < 200; ++n) writer.add_frame(view(numbered(n)));
    };
    EXPECT_THROW(add_all(), std::out_of_range);
    EXPECT_TRUE(log.destroyed);  // what it held is given back at once
    EXPECT_THROW(writer.add_frame(view(numbered(0))), std::out_of_range);
    EXPECT_THROW(writer.finish(), std::out_of_range);
    EXPECT_EQ(log.calls, "f0 f1 ");
}

TEST(OverlappedWriter, ThrowsAtFinishWhatWasStillInTheQueue) {
    Log log;
    OverlappedWriter writer(std::make_unique<Recorder>(log, 1));
    writer.add_frame(view(numbered(0)));
    writer.add_frame(view(numbered(1)));
    EXPECT_THROW(writer.finish(), std::out_of_range);
}

TEST(OverlappedWriter, AbandonedDropsWhatWaitsAndNeverFinishes) {
    Log log;
    {
        OverlappedWriter writer(std::make_unique<Recorder>(log));
        for (std::uint8_t n = 0; n < 10; ++n) writer.add_frame(view(numbered(n)));
    }
    EXPECT_TRUE(log.destroyed);
    EXPECT_EQ(log.calls.find("end"), std::string::npos);
}

TEST(OverlappedWriter, ReadsRowsStoredBottomFirst) {
    Log log;
    OverlappedWriter writer(std::make_unique<Recorder>(log));
    const std::vector<std::uint8_t> rows{7, 0, 0, 255, 9, 0, 0, 255};
    writer.add_frame(bottom_up_view(1, 2, rows.data()));
    writer.finish();
    EXPECT_EQ(log.calls, "f9 end");
}

}  // namespace
}  // namespace viaface

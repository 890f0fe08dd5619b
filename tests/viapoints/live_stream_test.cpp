// Streams that share a talker's model: within the bound whatever the motion, and live with a bounded delay.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <queue>

#include "tests/viapoints/smooth_motion.hpp"
#include "viapoints/measured.hpp"
#include "viapoints/stream_train.hpp"
#include "viapoints/via_stream_live.hpp"

namespace viaface {
namespace {

constexpr int kHeldPoints = 3;

const StreamModel& model() {
    static const StreamModel learned =
        learn_stream_model("somebody", {smooth_motion(1, 4, 30, kHeldPoints, 4)}, {.bounds_mm = {0.5, 2}});
    return learned;
}

double largest_error_mm(const RowMatrix& drawn, const Motion& motion) {
    const auto points = measured_points(motion.positions, "motion");
    const RowMatrix off = coordinates_of(drawn - motion.positions, points);
    return off.allFinite() ? longest_triple(off) : INFINITY;
}

TEST(SharedStream, HoldsAnyBoundOfAnyMotionAtEverySample) {
    const StreamModel* const models[] = {&model()};
    Dice dice(7);
    for (std::uint64_t seed = 20; seed < 23; ++seed) {
        const double rate = 25 + 75 * dice.uniform(), seconds = 0.5 + 2 * dice.uniform();
        const Motion motion = smooth_motion(seed, seconds, rate, kHeldPoints, 2 + static_cast<int>(seed % 5));
        const StreamOptions options{0.3 * std::pow(10, dice.uniform()), 0.4 + 2 * dice.uniform(), 1};
        const EncodedStream encoded = encode_stream(motion, &model(), options);
        const DecodedStream decoded = decode_stream(encoded.bytes, models);
        EXPECT_TRUE(decoded.damage.empty()) << decoded.describe_damage();
        EXPECT_LE(largest_error_mm(decoded.positions(motion.time_s), motion), options.max_error_mm) << seed;
        EXPECT_EQ(encode_stream(motion, &model(), options).bytes, encoded.bytes) << seed;
    }
}

// Rows go in one after the other, packets travel for a while, rows come out: none later than the look-ahead
// and the way after it went in, by the motion's own clock.
TEST(LiveStream, ComesOutWithinLookAheadAndDelay) {
    constexpr double kRate = 50, kDelay = 0.2;
    const LiveOptions options{.max_error_mm = 1, .look_ahead_s = 0.5};
    const Motion motion = smooth_motion(1, 4, kRate, kHeldPoints, 4);
    LiveStreamEncoder encoder(model(), 0, motion.at(0), options);
    LiveStreamDecoder decoder({&model()}, kRate);
    std::queue<std::pair<double, Bytes>> wire;
    Motion out{{}, RowMatrix(0, kCoordinates)};
    double latest = 0, sum = 0;
    const auto receive = [&](double now, const Motion& rows) {
        for (std::size_t i = 0; i < rows.size(); ++i) {
            latest = std::max(latest, now - rows.time_s[i]);
            sum += now - rows.time_s[i];
            out.time_s.push_back(rows.time_s[i]);
        }
        out.positions.conservativeResize(static_cast<Eigen::Index>(out.size()), kCoordinates);
        out.positions.bottomRows(rows.positions.rows()) = rows.positions;
    };
    wire.push({kDelay, encoder.head()});
    for (std::size_t i = 0; i < motion.size(); ++i) {
        const double now = motion.time_s[i];
        if (Bytes packet = encoder.push(now, motion.at(i)); !packet.empty())
            wire.push({now + kDelay, packet});
        for (; !wire.empty() && wire.front().first <= now; wire.pop())
            receive(wire.front().first, decoder.feed(wire.front().second));
    }
    wire.push({motion.time_s.back() + kDelay, encoder.finish()});
    for (; !wire.empty(); wire.pop()) receive(wire.front().first, decoder.feed(wire.front().second));
    receive(motion.time_s.back() + kDelay, decoder.finish());
    std::printf("latency of a row: mean %.3f s, at most %.3f s, of look-ahead %.1f s and delay %.1f s\n",
                sum / static_cast<double>(out.size()), latest, options.look_ahead_s, kDelay);
    EXPECT_TRUE(decoder.decoded()->damage.empty()) << decoder.decoded()->describe_damage();
    EXPECT_TRUE(decoder.decoded()->head.talker == "somebody");
    ASSERT_EQ(out.size(), motion.size());
    EXPECT_LE(largest_error_mm(out.positions, motion), options.max_error_mm);
    EXPECT_LE(latest, options.look_ahead_s + kDelay + 1 / kRate + 1e-9);
}

// Two points lie where none of the talker's modes takes them.
TEST(LiveStream, TellsFewPointsOfAnotherPerson) {
    const StreamModel talker =
        learn_stream_model("somebody", {smooth_motion(1, 4, 30, 8, 4)}, {.bounds_mm = {0.5, 2}});
    ASSERT_LT(talker.basis.size(), 6);
    Motion motion = smooth_motion(5, 2, 50, 2, 3);
    motion.positions.leftCols(6).rowwise() += Eigen::RowVectorXd::LinSpaced(6, -20, 15);
    const LiveOptions options{.max_error_mm = 1, .look_ahead_s = 0.5};
    LiveStreamEncoder encoder(talker, 0, motion.at(0), options);
    LiveStreamDecoder decoder({&talker}, 50);
    decoder.feed(encoder.head());
    for (std::size_t i = 0; i < motion.size(); ++i)
        decoder.feed(encoder.push(motion.time_s[i], motion.at(i)));
    decoder.feed(encoder.finish());
    decoder.finish();
    const DecodedStream& decoded = *decoder.decoded();
    EXPECT_LE(largest_error_mm(decoded.positions(motion.time_s), motion), options.max_error_mm);
}

}  // namespace
}  // namespace viaface

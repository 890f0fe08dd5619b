#include "viapoints/via_stream.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "tests/viapoints/smooth_motion.hpp"
#include "viapoints/measured.hpp"
#include "viapoints/spline.hpp"
#include "viapoints/stream_segment.hpp"
#include "viapoints/stream_spline.hpp"

namespace viaface {
namespace {

DecodedStream decoded(std::span<const std::uint8_t> bytes) { return decode_stream(bytes, {}); }

double largest_error_mm(const DecodedStream& stream, const Motion& motion) {
    const auto points = measured_points(motion.positions, "motion");
    const RowMatrix off = coordinates_of(stream.positions(motion.time_s) - motion.positions, points);
    return off.allFinite() ? longest_triple(off) : std::numeric_limits<double>::infinity();
}

TEST(StreamSpline, WeightsArePositiveAndSumToOne) {
    const std::vector<int> via = {0, 1, 2, 9, 10, 40, 41, 60};
    std::vector<double> at;
    for (int i = 0; i <= 600; ++i) at.push_back(0.1 * i);
    const RowMatrix weights = control_weights(via, at);
    EXPECT_GE(weights.minCoeff(), -1e-15);
    EXPECT_LT((weights.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-12);
}

// The stream's spline is the minimum-jerk spline, at rest at its ends, through its own via points.
TEST(StreamSpline, IsTheMinimumJerkSplineThroughItsViaPoints) {
    const std::vector<int> via = {0, 3, 4, 9, 12, 20, 23, 30};
    Dice dice(3);
    const RowMatrix control = RowMatrix::NullaryExpr(8, 2, [&] { return dice.normal(); });
    const std::vector<double> times(via.begin(), via.end());
    const MinimumJerkSpline spline({times, control_weights(via, times) * control}, SplineEnd::at_rest(),
                                   SplineEnd::at_rest());
    std::vector<double> at;
    for (int i = 0; i <= 300; ++i) at.push_back(0.1 * i);
    EXPECT_LT((spline.at(at) - control_weights(via, at) * control).cwiseAbs().maxCoeff(), 1e-9);
}

struct Case {
    std::uint64_t seed;
    double seconds, rate_hz;
    int points;
    double bound_mm, sync_s;
};

class WithinItsBound : public testing::TestWithParam<Case> {};

TEST_P(WithinItsBound, AtEverySample) {
    const Case c = GetParam();
    const Motion motion = smooth_motion(c.seed, c.seconds, c.rate_hz, c.points);
    const EncodedStream encoded = encode_stream(motion, nullptr, {c.bound_mm, c.sync_s, 1});
    const DecodedStream stream = decoded(encoded.bytes);
    EXPECT_TRUE(stream.damage.empty()) << stream.describe_damage();
    EXPECT_LE(largest_error_mm(stream, motion), c.bound_mm);
    EXPECT_DOUBLE_EQ(encoded.account.max_error_mm, largest_error_mm(stream, motion));
    for (const DecodedSegment& segment : stream.segments)
        EXPECT_LE(segment.end_s - segment.begin_s, c.sync_s + 1e-9);
    EXPECT_EQ(encoded.bytes, encode_stream(motion, nullptr, {c.bound_mm, c.sync_s, 1}).bytes);
}

INSTANTIATE_TEST_SUITE_P(Streams, WithinItsBound,
                         testing::Values(Case{1, 5, 30, 4, 1, 10}, Case{2, 4, 100, 6, 0.5, 2},
                                         Case{3, 3, 60, 3, 3, 1}, Case{4, 3, 200, 2, 0.1, 0.5},
                                         Case{5, 0.05, 30, 2, 1, 10}, Case{6, 6, 25, 38, 2, 3}));

// Where two segments meet they share a place, and where both rest no point moves there.
TEST(ViaStream, SegmentsJoin) {
    const Motion motion = smooth_motion(8, 6, 50, 3);
    const DecodedStream stream = decoded(encode_stream(motion, nullptr, {8, 1.5, 1}).bytes);
    ASSERT_GE(stream.segments.size(), 4u);
    int at_rest = 0;
    for (std::size_t i = 0; i + 1 < stream.segments.size(); ++i) {
        const ViaPointTrack a = stream.track(i), b = stream.track(i + 1);
        EXPECT_DOUBLE_EQ(a.time_s.back(), b.time_s.front());
        EXPECT_LT((a.points.bottomRows(1) - b.points.topRows(1)).cwiseAbs().maxCoeff(), 1e-9);
        if (moves_last(stream.segments[i].via.tick) || moves_first(stream.segments[i + 1].via.tick)) continue;
        ++at_rest;
        // from rest a place goes by the third power of time: a thousandth of what a millisecond moves in 0.1
        // ms
        const double t = a.time_s.back();
        const RowMatrix near = stream.positions({t - 1e-3, t - 1e-4, t, t + 1e-4, t + 1e-3}).leftCols(9);
        const auto moved = [&](int from, int to) {
            return (near.row(to) - near.row(from)).cwiseAbs().maxCoeff();
        };
        EXPECT_LT(moved(2, 3), 0.0015 * moved(2, 4) + 1e-9);
        EXPECT_LT(moved(1, 2), 0.0015 * moved(0, 2) + 1e-9);
    }
    EXPECT_GT(at_rest, 0);
}

TEST(ViaStream, DecodesFromEachSyncPointAsFromTheBeginning) {
    const Motion motion = smooth_motion(9, 6, 50, 3);
    const Bytes bytes = encode_stream(motion, nullptr, {1, 1.5, 1}).bytes;
    const DecodedStream whole = decoded(bytes);
    for (const DecodedSegment& from : whole.segments) {
        Bytes later(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(whole.head_bytes));
        later.insert(later.end(), bytes.begin() + static_cast<std::ptrdiff_t>(from.offset), bytes.end());
        const DecodedStream stream = decoded(later);
        std::vector<double> times;
        for (const double t : motion.time_s)
            if (t > from.begin_s) times.push_back(t);
        EXPECT_EQ(stream.positions(times).leftCols(9), whole.positions(times).leftCols(9)) << from.begin_s;
    }
}

// What is left of a stream whose bytes were changed from byte `at` on: every segment outside of it, as it
// was.
void expect_contained(const DecodedStream& stream, const DecodedStream& whole, std::size_t from,
                      std::size_t to) {
    std::size_t kept = 0;
    for (const DecodedSegment& segment : whole.segments) {
        if (from < segment.offset + segment.size && to > segment.offset) continue;
        ASSERT_LT(kept, stream.segments.size());
        EXPECT_EQ(stream.segments[kept].first_tick, segment.first_tick);
        EXPECT_EQ(stream.segments[kept].via.values, segment.via.values);
        ++kept;
    }
    EXPECT_EQ(kept, stream.segments.size());
}

TEST(ViaStream, EverySingleFlippedBitIsNamedAndContained) {
    const Motion motion = smooth_motion(10, 4, 30, 2);
    const Bytes bytes = encode_stream(motion, nullptr, {2, 1, 1}, {{3, 0.1, 0.2}, {4, 1.5, 1.75}}).bytes;
    const DecodedStream whole = decoded(bytes);
    ASSERT_GE(whole.segments.size(), 4u);
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
        Bytes flipped = bytes;
        const std::size_t at = bit / 8;
        flipped[at] ^= static_cast<std::uint8_t>(1u << (bit % 8));
        if (at < whole.head_bytes) {
            EXPECT_THROW(decoded(flipped), std::runtime_error) << bit;
            continue;
        }
        const DecodedStream stream = decoded(flipped);
        ASSERT_FALSE(stream.damage.empty()) << bit;
        EXPECT_LE(stream.damage.front().offset, at) << bit;
        EXPECT_GT(stream.damage.front().offset + stream.damage.front().size, at) << bit;
        EXPECT_LE(stream.damage.front().from_s, stream.damage.front().to_s);
        expect_contained(stream, whole, at, at + 1);
    }
}

TEST(ViaStream, ACutAtAnyByteIsNamedAndContained) {
    const Motion motion = smooth_motion(11, 4, 30, 2);
    const Bytes bytes = encode_stream(motion, nullptr, {2, 1, 1}).bytes;
    const DecodedStream whole = decoded(bytes);
    for (std::size_t left = 0; left < bytes.size(); ++left) {
        const std::span<const std::uint8_t> cut(bytes.data(), left);
        if (left < whole.head_bytes) {
            EXPECT_THROW(decoded(cut), std::runtime_error) << left;
            continue;
        }
        const DecodedStream stream = decoded(cut);
        ASSERT_FALSE(stream.damage.empty()) << left;
        expect_contained(stream, whole, left, bytes.size());
    }
}

TEST(ViaStream, ASegmentThatIsMissingIsNamedWithItsTime) {
    const Motion motion = smooth_motion(12, 4, 30, 2);
    Bytes bytes = encode_stream(motion, nullptr, {2, 1, 1}).bytes;
    const DecodedStream whole = decoded(bytes);
    const DecodedSegment& lost = whole.segments.at(1);
    bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(lost.offset),
                bytes.begin() + static_cast<std::ptrdiff_t>(lost.offset + lost.size));
    const DecodedStream stream = decoded(bytes);
    ASSERT_EQ(stream.damage.size(), 1u);
    EXPECT_EQ(stream.damage[0].segment, 1u);
    EXPECT_DOUBLE_EQ(stream.damage[0].from_s, lost.begin_s);
    EXPECT_DOUBLE_EQ(stream.damage[0].to_s, lost.end_s);
    const double middle = (lost.begin_s + lost.end_s) / 2;
    EXPECT_TRUE(std::isnan(stream.positions({middle})(0, 0)));
}

TEST(ViaStream, PhonesArriveWithinAMillisecond) {
    const Motion motion = smooth_motion(13, 4, 30, 2);
    const std::vector<StreamPhone> phones = {{0, 0, 0.25}, {7, 0.25, 0.3111}, {9, 1.2, 1.5}, {0, 3.9, 4.2}};
    const DecodedStream stream = decoded(encode_stream(motion, nullptr, {2, 1, 1}, phones).bytes);
    ASSERT_EQ(stream.phones.size(), phones.size());
    for (std::size_t i = 0; i < phones.size(); ++i) {
        EXPECT_EQ(stream.phones[i].phone, phones[i].phone);
        EXPECT_NEAR(stream.phones[i].begin_s, phones[i].begin_s, 0.001);
        EXPECT_NEAR(stream.phones[i].end_s, phones[i].end_s, 0.0015);
    }
}

// Nothing in it is searched or computed in floating point, so its bytes are the same everywhere.
TEST(ViaStream, BytesAreThoseOfTheFormat) {
    StreamTools tools;
    tools.head.points = {2, 8};
    tools.basis = {Configuration::Constant(std::nan("")), Eigen::MatrixXd::Zero(kCoordinates, 2)};
    for (const int p : tools.head.points) tools.basis.mean.segment<3>(3 * p) << 1, -2, 0.5;
    tools.basis.modes(3 * 8 + 1, 0) = 1;
    tools.basis.modes(3 * 2, 1) = -1;
    tools.statistics = plain_statistics(2);
    Bytes bytes = write_stream_head(tools);
    const SegmentVia segment{{{0, 5, 11, 40}, {{0, 0}, {3, -1}, {-20, 2}, {0, 0}}}, 1};
    const Bytes packet = write_packet(PacketType::kSegment, 300, segment_content(tools, segment));
    bytes.insert(bytes.end(), packet.begin(), packet.end());
    const Bytes end = write_packet(PacketType::kEnd, 340, {});
    bytes.insert(bytes.end(), end.begin(), end.end());
    std::string hex;
    for (const std::uint8_t byte : bytes) {
        constexpr const char* kDigits = "0123456789abcdef";
        hex += {kDigits[byte >> 4], kDigits[byte & 15]};
    }
    EXPECT_EQ(hex,
              "895649410d0a1a0a020002009d6641f24845414412000000040104010000001e2c010000803f0000a0405d4488444d"
              "45414e1d00000004010000000000803f000000c00000003f0000803f000000c00000003f3c83071c4d4f4445190000"
              "00020000000000000000ff7f00000180000000000000000000006b1bba8de10fac0200716ed689856e051b9ecd4143"
              "3ced59eaa6c3ef00d40245ef02a4");
    const DecodedStream stream = decoded(bytes);
    ASSERT_EQ(stream.segments.size(), 1u);
    EXPECT_EQ(stream.segments[0].via.tick, segment.via.tick);
    EXPECT_EQ(stream.segments[0].via.values, segment.via.values);
    EXPECT_DOUBLE_EQ(stream.segments[0].begin_s, 10);
    EXPECT_NEAR(stream.positions({10.0})(0, 3 * 8 + 1), -2, 1e-12);
}

TEST(ViaStream, RefusesWhatItCannotHold) {
    Motion motion = smooth_motion(14, 1, 30, 2);
    EXPECT_THROW(encode_stream(motion, nullptr, {0, 10, 1}), InputError);
    EXPECT_THROW(encode_stream(motion, nullptr, {std::nan(""), 10, 1}), InputError);
    EXPECT_THROW(encode_stream(motion, nullptr, {1, 0.01, 1}), InputError);
    Motion gap = motion;
    gap.positions(4, 1) = std::nan("");
    EXPECT_THROW(encode_stream(gap, nullptr), InputError);
    Motion backwards = motion;
    backwards.time_s[5] = backwards.time_s[4];
    EXPECT_THROW(encode_stream(backwards, nullptr), InputError);
    Motion one = motion;
    one.time_s.resize(1);
    one.positions.conservativeResize(1, kCoordinates);
    EXPECT_THROW(encode_stream(one, nullptr), InputError);
    // noise of 5 mm at 1000 samples per second has no spline of 240 via points per second within 0.1 mm
    Motion noise = smooth_motion(15, 0.1, 1000, 2);
    Dice dice(1);
    for (double& value : noise.positions.leftCols(6).reshaped()) value += 5 * dice.normal();
    EXPECT_THROW(encode_stream(noise, nullptr, {0.1, 10, 0}), InputError);
}

}  // namespace
}  // namespace viaface

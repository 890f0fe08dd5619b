#include "viapoints/codex_file.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "base/error.hpp"
#include "tests/viapoints/recited.hpp"
#include "viapoints/via_chunks.hpp"

namespace viaface {
namespace {

// Nothing in it is computed, so its bytes are the same everywhere.
Codex plain_codex() {
    ConfigurationBasis basis{Configuration::Zero(), Eigen::MatrixXd::Identity(kCoordinates, 2)};
    RowMatrix two(2, 2), one(1, 2);
    two << 0, 0, 1.5, -0.25;
    one << -3, 8;
    const Recitation recitation = {{kPause, 0, true, 0.25, {0, 0.5}, two, 0},
                                   {recited::id("p"), 0, true, 0.08, {0.5}, one, 0},
                                   {recited::id("aa"), 1, true, 0.11, {0.25, 0.75}, two, 1},
                                   {recited::id("t"), 0, false, 0.01, {}, RowMatrix(0, 2), 0},
                                   {kPause, 0, true, 0.3, {0.999}, RowMatrix::Zero(1, 2), 0}};
    return make_codex(basis, Eigen::VectorXd::Zero(2), {recitation}, "a test");
}

void expect_same(const Codex& a, const Codex& b) {
    EXPECT_EQ(a.basis.mean, b.basis.mean);
    EXPECT_EQ(a.basis.modes, b.basis.modes);
    EXPECT_EQ(a.rest, b.rest);
    EXPECT_EQ(a.provenance, b.provenance);
    EXPECT_EQ(a.scatter_mm, b.scatter_mm);
    EXPECT_EQ(a.motions.size(), b.motions.size());
    EXPECT_EQ(a.begins, b.begins);
    EXPECT_EQ(a.ends, b.ends);
    ASSERT_EQ(a.units.size(), b.units.size());
    ASSERT_EQ(a.recitations.size(), b.recitations.size());
    for (std::size_t r = 0; r < a.recitations.size(); ++r) {
        ASSERT_EQ(a.recitations[r].size(), b.recitations[r].size());
        for (std::size_t p = 0; p < a.recitations[r].size(); ++p) {
            const RecitedPhone &x = a.recitations[r][p], &y = b.recitations[r][p];
            EXPECT_EQ(std::tie(x.phone, x.stress, x.usable, x.duration_s, x.via, x.nucleus),
                      std::tie(y.phone, y.stress, y.usable, y.duration_s, y.via, y.nucleus));
            EXPECT_EQ(x.points, y.points);
        }
    }
}

std::string refusal(const Bytes& bytes) {
    try {
        read_codex(bytes);
    } catch (const std::runtime_error& error) {
        return describe(error);
    }
    return {};
}

// The file with one chunk's content changed; its checksum fits.
Bytes with_content(const Bytes& bytes, std::string_view type, auto change) {
    ViaChunkWriter writer(ViaKind::kCodex);
    for (const ViaChunk& chunk : read_chunks(bytes, ViaKind::kCodex)) {
        Bytes content(chunk.content.begin(), chunk.content.end());
        if (chunk.type == type) change(content);
        writer.add(chunk.type, content);
    }
    return writer.finish();
}

TEST(CodexFile, RoundingStaysWithinItsBoundsAndThenNothingChanges) {
    const Codex codex = recited::codex_of(20);
    const Bytes bytes = write_codex(codex);
    const Codex again = read_codex(bytes);
    EXPECT_EQ(write_codex(again), bytes);
    expect_same(read_codex(write_codex(again)), again);
    double farthest = 0;
    for (std::size_t r = 0; r < codex.recitations.size(); ++r) {
        for (std::size_t p = 0; p < codex.recitations[r].size(); ++p) {
            const RecitedPhone &was = codex.recitations[r][p], &is = again.recitations[r][p];
            EXPECT_NEAR(was.duration_s, is.duration_s, 0.5001e-4);
            for (std::size_t i = 0; i < was.via.size(); ++i) EXPECT_NEAR(was.via[i], is.via[i], 1.0001e-3);
            const Eigen::MatrixXd off = codex.basis.modes * (was.points - is.points).transpose();
            for (Eigen::Index i = 0; i < off.cols(); ++i) {
                for (int point = 0; point < kPoints; ++point)
                    farthest = std::max(farthest, off.col(i).segment<3>(3 * point).norm());
            }
        }
    }
    EXPECT_LT(farthest, 0.02);
    EXPECT_GT(farthest, 0.004);  // steps are not finer than the bound asks
}

TEST(CodexFile, AScatterIsKeptAndOneOutOfBoundsRefused) {
    Codex codex = plain_codex();
    codex = make_codex(codex.basis, codex.rest, codex.recitations, "a test", 0.25);
    const Bytes bytes = write_codex(codex);
    expect_same(read_codex(write_codex(read_codex(bytes))), read_codex(bytes));
    EXPECT_EQ(read_codex(bytes).scatter_mm, 0.25);
    EXPECT_EQ(read_codex(bytes).motions.size(), 1u);
    for (const double wrong : {-1.0, 1001.0, std::nan("")}) {
        const Bytes changed = with_content(
            bytes, "scat", [&](Bytes& content) { std::memcpy(content.data(), &wrong, sizeof wrong); });
        EXPECT_NE(refusal(changed).find("scatter"), std::string::npos) << wrong;
    }
    EXPECT_NE(refusal(with_content(bytes, "scat", [](Bytes& content) { content.pop_back(); })), "");
}

TEST(CodexFile, TenComponentsTakeSixBytesAPhoneAndUnderNineteenAViaPoint) {
    const Codex codex = recited::codex_of(40);
    std::size_t phones = 0, vias = 0;
    for (const Recitation& recitation : codex.recitations) {
        phones += recitation.size();
        for (const RecitedPhone& phone : recitation) vias += phone.via.size();
    }
    const auto chunks = read_chunks(write_codex(codex), ViaKind::kCodex);
    const std::size_t tables = 10 * 9 + 12 + 4 * codex.recitations.size();
    const double per_via =
        static_cast<double>(chunks[3].content.size() - tables - 6 * phones) / static_cast<double>(vias);
    EXPECT_EQ(per_via, std::floor(per_via));
    EXPECT_LT(per_via, 19);
}

TEST(CodexFile, ItsFirstBytesAndItsWholeAreLocked) {
    const Bytes bytes = write_codex(plain_codex());
    const Bytes header = {0x89, 'V', 'I', 'A', 0x0d, 0x0a, 0x1a, 0x0a, 1, 0, 1, 0};
    EXPECT_EQ(Bytes(bytes.begin(), bytes.begin() + 12), header);
    std::uint32_t checksum = 0;
    std::memcpy(&checksum, bytes.data() + 12, 4);
    EXPECT_EQ(checksum, crc32(header));
    const std::vector<ViaChunk> chunks = read_chunks(bytes, ViaKind::kCodex);
    std::string types;
    for (const ViaChunk& chunk : chunks)
        types += std::string(chunk.type) + " " + std::to_string(chunk.content.size()) + " ";
    EXPECT_EQ(types, "LAYO 519 PHON 109 BASE 2754 RECI 88 prov 6 ");
    EXPECT_EQ(Bytes(bytes.end() - 12, bytes.end() - 4), (Bytes{'E', 'N', 'D', 'S', 0, 0, 0, 0}));
    EXPECT_EQ(fnv1a(bytes), 14908863016210149897u) << "the format changed: a new version is due";
    // The first via points by hand: identity modes, so both steps are 0.038; time 0, then 500 with 1.5 and
    // -0.25 as 39 and -7.
    const auto reci = chunks[3].content;
    EXPECT_EQ(reci[16], 9);
    EXPECT_EQ(reci[17], 10);
    const Bytes pause = {0, 4, 0xc4, 0x09, 2, 0, 0, 0, 0, 0};
    EXPECT_TRUE(std::equal(pause.begin(), pause.end(), reci.begin() + 34));
    const std::uint32_t second = 500u | 79u << 10 | (static_cast<std::uint32_t>(-13) & 0x3ffu) << 19;
    std::uint32_t stored = 0;
    std::memcpy(&stored, reci.data() + 34 + 6 + 4, 4);
    EXPECT_EQ(stored, second);
}

TEST(CodexFile, EveryFlippedBitIsFound) {
    Bytes bytes = write_codex(plain_codex());
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        for (int bit = 0; bit < 8; ++bit) {
            bytes[i] ^= static_cast<std::uint8_t>(1 << bit);
            EXPECT_NE(refusal(bytes), "") << "byte " << i << " bit " << bit;
            bytes[i] ^= static_cast<std::uint8_t>(1 << bit);
        }
    }
    EXPECT_EQ(refusal(bytes), "");
}

TEST(CodexFile, EveryTruncationAndEveryByteTooManyIsFound) {
    Bytes bytes = write_codex(plain_codex());
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        EXPECT_NE(refusal(Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size))), "")
            << size;
    }
    bytes.push_back(0);
    EXPECT_NE(refusal(bytes).find("after the end"), std::string::npos);
}

TEST(CodexFile, HugeCountsAreRefusedBeforeAnythingIsAllocated) {
    const Bytes good = write_codex(plain_codex());
    for (const std::size_t field :
         {0, 4, 8, 12}) {  // recitations, phones, via points, phones of the first recitation
        for (const std::uint32_t value : {0xffffffffu, 0x7fffffffu, 1000000u}) {
            const Bytes bad = with_content(
                good, "RECI", [&](Bytes& content) { std::memcpy(content.data() + 18 + field, &value, 4); });
            EXPECT_NE(refusal(bad).find("chunk RECI, content from byte"), std::string::npos) << field;
        }
    }
    const Bytes many = with_content(good, "BASE", [](Bytes& content) { content[0] = content[1] = 0xff; });
    EXPECT_NE(refusal(many).find("65535 components"), std::string::npos);
    Bytes long_chunk = good;
    std::memset(long_chunk.data() + 20, 0xff, 4);
    EXPECT_NE(refusal(long_chunk).find("chunk LAYO at byte 16: a content of 4294967295 bytes"),
              std::string::npos);
}

TEST(CodexFile, WrongContentsAreNamed) {
    const Bytes good = write_codex(plain_codex());
    const auto said = [&](std::string_view type, auto change) {
        return refusal(with_content(good, type, change));
    };
    EXPECT_NE(said("LAYO", [](Bytes& c) { c[3] = 'L'; }).find("point 0 is \"Lip_top\", known is lip_top"),
              std::string::npos);
    EXPECT_NE(said("PHON", [](Bytes& c) { c[2] = 'q'; }).find("phone \"qau\" is not known"),
              std::string::npos);
    EXPECT_NE(said("PHON",
                   [](Bytes& c) {
                       c.insert(c.begin() + 5, {3, 'p', 'a', 'u'});
                   })
                  .find("stands twice"),
              std::string::npos);
    EXPECT_NE(said("BASE", [](Bytes& c) { c.pop_back(); }).find("cut short"), std::string::npos);
    EXPECT_NE(said("BASE", [](Bytes& c) { c.push_back(0); }).find("bytes left over"), std::string::npos);
    EXPECT_NE(said("BASE", [](Bytes& c) { std::memset(c.data() + 2 + 8 * kCoordinates, 0, 8); })
                  .find("not orthonormal"),
              std::string::npos);
    EXPECT_NE(said("BASE", [](Bytes& c) { std::memset(c.data() + 2, 0xff, 8); }).find("mean of the basis"),
              std::string::npos);
    EXPECT_NE(said("RECI", [](Bytes& c) { std::memset(c.data(), 0, 8); }).find("a step outside"),
              std::string::npos);
    EXPECT_NE(said("RECI", [](Bytes& c) { std::memset(c.data(), 0xff, 8); }).find("a step outside"),
              std::string::npos);
    EXPECT_NE(said("RECI", [](Bytes& c) { c[16] = 25; }).find("2 to 24 bits"), std::string::npos);
    EXPECT_NE(said("RECI", [](Bytes& c) { c[34] = 200; }).find("phone 200 of 41"), std::string::npos);
    EXPECT_NE(said("RECI", [](Bytes& c) { c[35] = 3; }).find("flags 3"), std::string::npos);
    EXPECT_NE(said("RECI", [](Bytes& c) { c[36] = c[37] = 0; }).find("has no length"), std::string::npos);
    EXPECT_NE(said("RECI", [](Bytes& c) { c[39] = 2; }).find("nucleus"), std::string::npos);
    EXPECT_NE(said("RECI", [](Bytes& c) { c[44] = c[45] = 0; }).find("do not rise"), std::string::npos);
    EXPECT_NE(said("RECI", [](Bytes& c) { c[47] |= 0x80; }).find("not filled up with 0"), std::string::npos);
}

TEST(CodexFile, UnknownChunksAreSkippedWhenOptionalAndRefusedWhenRequired) {
    const Bytes good = write_codex(plain_codex());
    const auto with_more = [&](std::string_view type) {
        ViaChunkWriter writer(ViaKind::kCodex);
        for (const ViaChunk& chunk : read_chunks(good, ViaKind::kCodex))
            writer.add(chunk.type, chunk.content);
        writer.add(type, Bytes{1, 2, 3});
        return writer.finish();
    };
    expect_same(read_codex(with_more("note")), read_codex(good));
    EXPECT_NE(refusal(with_more("NOTE")).find("chunk NOTE"), std::string::npos);
    EXPECT_NE(refusal(with_more("BASE")).find("stands twice"), std::string::npos);
    EXPECT_NE(refusal(with_more("n0te")).find("no chunk type"), std::string::npos);
    for (const std::string_view missing : {"LAYO", "PHON", "BASE", "RECI"}) {
        ViaChunkWriter writer(ViaKind::kCodex);
        for (const ViaChunk& chunk : read_chunks(good, ViaKind::kCodex)) {
            if (chunk.type != missing) writer.add(chunk.type, chunk.content);
        }
        EXPECT_NE(refusal(writer.finish()).find("chunk " + std::string(missing) + " is missing"),
                  std::string::npos);
    }
}

TEST(CodexFile, AnotherVersionOrKindIsRefused) {
    Bytes bytes = write_codex(plain_codex());
    const auto with_header = [&](std::size_t at, std::uint8_t value) {
        Bytes changed = bytes;
        changed[at] = value;
        const std::uint32_t checksum = crc32(std::span(changed).first(12));
        std::memcpy(changed.data() + 12, &checksum, 4);
        return refusal(changed);
    };
    EXPECT_NE(with_header(8, 2).find("version 2, known is 1"), std::string::npos);
    EXPECT_NE(with_header(10, 2).find("kind 2, wanted 1"), std::string::npos);
}

TEST(CodexFile, WhatTheFormatCannotHoldIsRefused) {
    Codex codex = plain_codex();
    codex.recitations[0][1].duration_s = 7;
    EXPECT_THROW(write_codex(codex), std::invalid_argument);
    codex = plain_codex();
    codex.recitations[0][1].points(0, 0) = 1001;
    EXPECT_THROW(write_codex(codex), std::invalid_argument);
    codex = plain_codex();
    codex.recitations[0][2].via = {0.5, 0.5001};
    EXPECT_THROW(write_codex(codex), std::invalid_argument);
}

TEST(CodexFile, StepsLeaveNoPointFartherOffThanTheBound) {
    const ConfigurationBasis basis = recited::lip_basis();
    const Eigen::VectorXd steps = quantisation_steps(basis);
    double worst = 0;
    for (int point = 0; point < kPoints; ++point) {
        double sum = 0;
        for (Eigen::Index j = 0; j < steps.size(); ++j)
            sum += basis.modes.col(j).segment<3>(3 * point).norm() * steps[j] / 2;
        worst = std::max(worst, sum);
    }
    EXPECT_NEAR(worst, 0.019, 1e-9);
}

}  // namespace
}  // namespace viaface

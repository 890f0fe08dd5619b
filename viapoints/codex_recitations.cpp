#include <algorithm>
#include <cmath>

#include "viapoints/bit_packing.hpp"
#include "viapoints/codex_chunks.hpp"
#include "viapoints/codex_file.hpp"

namespace viaface {
namespace codex_chunks {
namespace {

constexpr double kFarthestComponent = 1000;  // mm
constexpr int kFewestBits = 2, kMostBits = 24, kTimeBits = 10;
constexpr int kTimeSteps = 1000;          // of a phone
constexpr double kDurationSteps = 10000;  // of a second
constexpr std::size_t kPhoneBytes = 6;

// How via points are rounded and packed.
struct Packing {
    Eigen::VectorXd step;   // [k], mm
    std::vector<int> bits;  // [k]

    std::size_t record_bytes() const {
        int sum = kTimeBits;
        for (const int b : bits) sum += b;
        return static_cast<std::size_t>(sum + 7) / 8;
    }
};

int bits_for(double largest) {
    int bits = kFewestBits;
    while (largest > static_cast<double>((1 << (bits - 1)) - 1)) ++bits;
    return bits;
}

Packing packing_of(const Codex& codex) {
    Packing packing{quantisation_steps(codex.basis), {}};
    Eigen::VectorXd largest = Eigen::VectorXd::Zero(packing.step.size());
    for (const Recitation& recitation : codex.recitations) {
        for (const RecitedPhone& phone : recitation) {
            if (phone.points.rows() == 0) continue;
            largest = largest.cwiseMax(phone.points.cwiseAbs().colwise().maxCoeff().transpose());
        }
    }
    fits(largest.maxCoeff() <= kFarthestComponent, "a component over 1000 mm");
    for (Eigen::Index j = 0; j < largest.size(); ++j)
        packing.bits.push_back(bits_for(std::round(largest[j] / packing.step[j])));
    return packing;
}

void put_via(ByteWriter& writer, const Packing& packing, std::int32_t time, const Eigen::RowVectorXd& point) {
    BitPacker packer;
    packer.put(time, kTimeBits);
    for (Eigen::Index j = 0; j < point.size(); ++j) {
        packer.put(static_cast<std::int32_t>(std::lround(point[j] / packing.step[j])),
                   packing.bits[static_cast<std::size_t>(j)]);
    }
    writer.put_bytes(packer.bytes());
}

void put_phone(ByteWriter& writer, const Packing& packing, const RecitedPhone& phone) {
    const long duration = std::lround(std::min(phone.duration_s, 10.0) * kDurationSteps);
    fits(duration >= 1 && duration <= 65535, "a phone shorter than 0.1 ms or longer than 6.5 s");
    fits(phone.via.size() <= 255, "a phone with over 255 via points");
    writer.put(static_cast<std::uint8_t>(phone.phone));
    writer.put(static_cast<std::uint8_t>(phone.stress | (phone.usable ? 4 : 0)));
    writer.put(static_cast<std::uint16_t>(duration));
    writer.put(static_cast<std::uint8_t>(phone.via.size()));
    writer.put(static_cast<std::uint8_t>(phone.nucleus));
    std::int32_t before = -1;
    for (std::size_t i = 0; i < phone.via.size(); ++i) {
        const auto time =
            static_cast<std::int32_t>(std::min<long>(std::lround(phone.via[i] * kTimeSteps), kTimeSteps - 1));
        fits(time > before, "via points closer than 1/1000 of their phone");
        put_via(writer, packing, time, phone.points.row(static_cast<Eigen::Index>(i)));
        before = time;
    }
}

Packing take_packing(ByteReader& reader, Eigen::Index k) {
    Packing packing{Eigen::VectorXd(k), {}};
    for (double& step : packing.step) {
        step = reader.get<double>();
        demand(step > 0 && step <= 1, "a step outside 0 to 1 mm", reader);
    }
    for (Eigen::Index j = 0; j < k; ++j) {
        packing.bits.push_back(reader.get<std::uint8_t>());
        demand(packing.bits.back() >= kFewestBits && packing.bits.back() <= kMostBits,
               "a component outside 2 to 24 bits", reader);
    }
    return packing;
}

double take_via(ByteReader& reader, const Packing& packing, RowMatrix::RowXpr point) {
    BitUnpacker unpacker(reader.take(packing.record_bytes()));
    const auto time = unpacker.take(kTimeBits);
    demand(time < kTimeSteps, "a via time over 999", reader);
    for (Eigen::Index j = 0; j < point.size(); ++j) {
        point[j] = unpacker.take_signed(packing.bits[static_cast<std::size_t>(j)]) * packing.step[j];
        demand(std::abs(point[j]) <= kFarthestComponent, "a component over 1000 mm", reader);
    }
    demand(unpacker.rest_is_zero(), "a via point not filled up with 0", reader);
    return static_cast<double>(time) / kTimeSteps;
}

RecitedPhone take_phone(ByteReader& reader, const Packing& packing, const std::vector<PhoneId>& ids) {
    const auto index = reader.get<std::uint8_t>(), flags = reader.get<std::uint8_t>();
    demand(index < ids.size(), "phone " + std::to_string(index) + " of " + std::to_string(ids.size()),
           reader);
    demand((flags & 3) < 3 && flags < 8, "flags " + std::to_string(flags), reader);
    RecitedPhone phone{ids[index], flags & 3, (flags & 4) != 0};
    phone.duration_s = reader.get<std::uint16_t>() / kDurationSteps;
    phone.via.resize(reader.get<std::uint8_t>());
    phone.nucleus = reader.get<std::uint8_t>();
    phone.points.resize(std::ssize(phone.via), packing.step.size());
    for (std::size_t i = 0; i < phone.via.size(); ++i) {
        phone.via[i] = take_via(reader, packing, phone.points.row(static_cast<Eigen::Index>(i)));
    }
    return phone;
}

}  // namespace

Bytes put_recitations(const Codex& codex) {
    const Packing packing = packing_of(codex);
    ByteWriter writer;
    for (const double step : packing.step) writer.put(step);
    for (const int bits : packing.bits) writer.put(static_cast<std::uint8_t>(bits));
    std::uint32_t phones = 0, vias = 0;
    for (const Recitation& recitation : codex.recitations) {
        phones += static_cast<std::uint32_t>(recitation.size());
        for (const RecitedPhone& phone : recitation) vias += static_cast<std::uint32_t>(phone.via.size());
    }
    writer.put(static_cast<std::uint32_t>(codex.recitations.size()));
    writer.put(phones);
    writer.put(vias);
    for (const Recitation& recitation : codex.recitations) {
        writer.put(static_cast<std::uint32_t>(recitation.size()));
        for (const RecitedPhone& phone : recitation) put_phone(writer, packing, phone);
    }
    return writer.bytes();
}

std::vector<Recitation> take_recitations(ByteReader& reader, Eigen::Index k,
                                         const std::vector<PhoneId>& ids) {
    const Packing packing = take_packing(reader, k);
    const std::uint64_t count = reader.get<std::uint32_t>(), phones = reader.get<std::uint32_t>(),
                        vias = reader.get<std::uint32_t>();
    demand(count * 4 + phones * kPhoneBytes + vias * packing.record_bytes() == reader.left(),
           std::to_string(count) + " recitations, " + std::to_string(phones) + " phones and " +
               std::to_string(vias) + " via points do not fill the content",
           reader);
    std::vector<Recitation> recitations(count);
    std::uint64_t phones_left = phones;
    for (Recitation& recitation : recitations) {
        const auto length = reader.get<std::uint32_t>();
        demand(length <= phones_left, "more phones than announced", reader);
        phones_left -= length;
        recitation.reserve(length);
        for (std::uint32_t p = 0; p < length; ++p) recitation.push_back(take_phone(reader, packing, ids));
    }
    demand(phones_left == 0, "fewer phones than announced", reader);
    return recitations;
}

}  // namespace codex_chunks

Eigen::VectorXd quantisation_steps(const ConfigurationBasis& basis) {
    constexpr double kRounding = 0.019;                  // mm
    Eigen::MatrixXd reach(kPoints, basis.modes.cols());  // m_pj
    for (int p = 0; p < kPoints; ++p) reach.row(p) = basis.modes.middleRows<3>(3 * p).colwise().norm();
    const Eigen::VectorXd step = reach.colwise().maxCoeff().cwiseInverse().transpose();
    return step * (kRounding / (reach * step / 2).maxCoeff());
}

}  // namespace viaface

#include "synth/pose/training.hpp"

#include <bit>
#include <cmath>
#include <string>

#include "base/error.hpp"

namespace viaface {
namespace {

constexpr std::string_view kMagic = "VIAE";
constexpr std::uint32_t kVersion = 1, kMostModes = 1000, kMostPostures = 1000;
static_assert(std::endian::native == std::endian::little);

void put(ByteWriter& writer, const Eigen::MatrixXd& matrix) {
    for (Eigen::Index i = 0; i < matrix.size(); ++i) writer.put(matrix.data()[i]);
}

Eigen::MatrixXd get(ByteReader& reader, Eigen::Index rows, Eigen::Index columns) {
    Eigen::MatrixXd matrix(rows, columns);
    for (Eigen::Index i = 0; i < matrix.size(); ++i) {
        matrix.data()[i] = reader.get<double>();
        if (!std::isfinite(matrix.data()[i])) throw std::runtime_error("a number that is not finite");
    }
    return matrix;
}

PoseTraining read_checked(std::span<const std::uint8_t> bytes) {
    ByteReader reader(bytes);
    const auto magic = reader.take(kMagic.size());
    if (std::string_view(reinterpret_cast<const char*>(magic.data()), magic.size()) != kMagic) {
        throw std::runtime_error("another magic number");
    }
    if (reader.get<std::uint32_t>() != kVersion) throw std::runtime_error("another version");
    const auto modes = reader.get<std::uint32_t>(), postures = reader.get<std::uint32_t>();
    if (modes == 0 || modes > kMostModes || postures == 0 || postures > kMostPostures) {
        throw std::runtime_error("no or too many modes or postures");
    }
    const std::size_t numbers =
        kCoordinates + std::size_t{postures} * (kCoordinates + modes + PoseTraining::kContourNumbers);
    if (reader.left() != 8 * numbers + 4) throw std::runtime_error("another length");
    PoseTraining training;
    training.rest = get(reader, kCoordinates, 1);
    training.configurations = get(reader, kCoordinates, postures);
    training.coefficients = get(reader, modes, postures);
    training.contours = get(reader, PoseTraining::kContourNumbers, postures);
    if (reader.get<std::uint32_t>() != crc32(bytes.first(bytes.size() - 4)))
        throw std::runtime_error("a wrong checksum");
    return training;
}

}  // namespace

Bytes write_training(const PoseTraining& training) {
    ByteWriter writer;
    writer.put_text(kMagic);
    writer.put(kVersion);
    writer.put(static_cast<std::uint32_t>(training.coefficients.rows()));
    writer.put(static_cast<std::uint32_t>(training.configurations.cols()));
    put(writer, training.rest);
    put(writer, training.configurations);
    put(writer, training.coefficients);
    put(writer, training.contours);
    writer.put(crc32(writer.bytes()));
    return writer.bytes();
}

PoseTraining read_training(std::span<const std::uint8_t> bytes) {
    try {
        return read_checked(bytes);
    } catch (const std::runtime_error& error) {
        throw InputError("talker", std::string("estimators.bin: ") + error.what(),
                         "a file written by talker make");
    }
}

}  // namespace viaface

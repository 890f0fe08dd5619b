#include "lipmodel/lip_file.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace viaface {
namespace {

constexpr std::string_view kMagic = "VIALIPS\n";
constexpr std::uint32_t kFormat = 1, kMostModes = LipMesh::kMarkedCoordinates, kMostText = 4096;
constexpr double kFarthest = 1e4;  // mm

void put_numbers(ByteWriter& to, const Eigen::Ref<const Eigen::VectorXd>& numbers) {
    for (const double number : numbers) to.put(number);
}

class Reader {
  public:
    Reader(std::span<const std::uint8_t> bytes, const std::string& field) : from_(bytes), field_(field) {}

    LipModel model() {
        check(std::ranges::equal(from_.take(kMagic.size()), kMagic), "other bytes", "a lip model (VIALIPS)");
        check(from_.get<std::uint32_t>() == kFormat, "another format", "format 1");
        const auto modes = from_.get<std::uint32_t>();
        check(modes >= 1 && modes <= kMostModes, std::to_string(modes) + " modes", "1 to 48 modes");
        LipModel model;
        const auto frames = from_.get<std::uint32_t>();
        check(frames >= 1 && frames <= 1u << 30, std::to_string(frames) + " frames", "1 to 2^30 frames");
        model.frames = static_cast<int>(frames);
        model.provenance = text();
        model.noise_mm = number(0, kFarthest);
        model.left_over = number(0, kFarthest * kFarthest);
        model.total_variance = number(0, kFarthest * kFarthest * LipMesh::kFreedoms);
        model.rest = as_lip_nodes(numbers(LipMesh::kFreedoms, kFarthest));
        model.mean = numbers(LipMesh::kFreedoms, kFarthest);
        model.variance = numbers(modes, kFarthest * kFarthest * LipMesh::kFreedoms);
        model.modes.resize(LipMesh::kFreedoms, modes);
        for (Eigen::Index i = 0; i < modes; ++i) model.modes.col(i) = numbers(LipMesh::kFreedoms, 1.001);
        check_modes(model);
        return model;
    }

    std::size_t offset() const { return from_.offset(); }

  private:
    void check(bool good, const std::string& met, const std::string& allowed) const {
        if (!good) throw InputError(field_, met, allowed);
    }

    double number(double least, double most) {
        const auto read = from_.get<double>();
        check(read >= least && read <= most, std::to_string(read), "a number of a lip model");
        return read;
    }

    Eigen::VectorXd numbers(Eigen::Index size, double most) {
        Eigen::VectorXd read(size);
        for (double& entry : read) entry = number(-most, most);
        return read;
    }

    std::string text() {
        const auto size = from_.get<std::uint32_t>();
        check(size <= kMostText, std::to_string(size) + " bytes of provenance", "at most 4096");
        const auto bytes = from_.take(size);
        check(std::ranges::none_of(bytes, [](std::uint8_t b) { return b < 0x20 || b == 0x7f; }),
              "control characters in the provenance", "one line of text");
        return {bytes.begin(), bytes.end()};
    }

    void check_modes(const LipModel& model) const {
        const Eigen::VectorXd& v = model.variance;
        check(v.minCoeff() > 0 && std::ranges::is_sorted(v, std::greater<>()), "variances",
              "positive variances that do not rise");
        check(v.sum() <= model.total_variance * (1 + 1e-9), "variances above their total", "a part of it");
        const Eigen::MatrixXd product = model.modes.transpose() * model.modes;
        const double off = (product - Eigen::MatrixXd::Identity(v.size(), v.size())).cwiseAbs().maxCoeff();
        check(off < 1e-6, "modes that are not orthonormal", "orthonormal modes");
    }

    ByteReader from_;
    const std::string& field_;
};

}  // namespace

Bytes write_lip_model(const LipModel& model) {
    ByteWriter to;
    to.put_text(kMagic);
    to.put(kFormat);
    to.put(static_cast<std::uint32_t>(model.modes.cols()));
    to.put(static_cast<std::uint32_t>(model.frames));
    to.put(static_cast<std::uint32_t>(model.provenance.size()));
    to.put_text(model.provenance);
    for (const double number : {model.noise_mm, model.left_over, model.total_variance}) to.put(number);
    put_numbers(to, as_column(model.rest));
    put_numbers(to, model.mean);
    put_numbers(to, model.variance);
    for (Eigen::Index i = 0; i < model.modes.cols(); ++i) put_numbers(to, model.modes.col(i));
    to.put(crc32(to.bytes()));
    return to.bytes();
}

LipModel read_lip_model(std::span<const std::uint8_t> bytes, const std::string& field) {
    LipModel model;
    std::size_t read = 0;
    try {
        Reader reader(bytes, field);
        model = reader.model();
        read = reader.offset();
    } catch (const InputError&) {
        throw;
    } catch (const std::runtime_error&) {  // of ByteReader: the bytes end too soon
        throw InputError(field, std::to_string(bytes.size()) + " bytes", "a whole lip model");
    }
    if (bytes.size() != read + sizeof(std::uint32_t))
        throw InputError(field, std::to_string(bytes.size()) + " bytes", std::to_string(read + 4) + " bytes");
    if (ByteReader(bytes.subspan(read)).get<std::uint32_t>() != crc32(bytes.first(read)))
        throw InputError(field, "a checksum that does not fit", "a lip model as it was written");
    return model;
}

}  // namespace viaface

#include "synth/lips/learned_lips.hpp"

#include <array>
#include <cstdio>

#include "base/error.hpp"
#include "base/whole_file.hpp"

namespace viaface {
namespace {

constexpr std::size_t kLargestModel = 1u << 20;  // bytes
constexpr std::size_t kLongestProvenance = 1000;

std::string named(const std::vector<std::filesystem::path>& sources) {
    std::string text = "learned from";
    for (const auto& source : sources) text += " " + source.filename().string();
    std::erase_if(text, [](unsigned char c) { return c < 0x20 || c == 0x7f; });
    return text.substr(0, kLongestProvenance);
}

}  // namespace

LipModel learn_from(const LipFrames& frames, const LipTraining& training,
                    const std::vector<std::filesystem::path>& sources) {
    try {
        LipModel model = learn_lips(lip_body(resting_lips(frames)), frames.points, training);
        model.provenance = named(sources);
        return model;
    } catch (const std::runtime_error& error) {
        throw InputError("motion", error.what(), "the 16 points of a mouth that moves");
    }
}

LipModel learn_on(const LipModel& model, const LipFrames& frames, const LipTraining& training,
                  const std::vector<std::filesystem::path>& sources) {
    const Eigen::MatrixXd before = frames_like(model);
    LipFrames all{Eigen::MatrixXd(before.rows(), before.cols() + frames.points.cols())};
    all.points << before, frames.points;
    all.rest = marked_of(as_column(model.rest));
    LipModel made = learn_from(all, training, sources);
    made.provenance = (model.provenance + "; then " + made.provenance).substr(0, kLongestProvenance);
    return made;
}

std::string model_text(const LipModel& model) {
    std::array<char, 160> line{};
    std::snprintf(line.data(), line.size(), "%d frames, %d modes with %.2f%% of the variance\n", model.frames,
                  static_cast<int>(model.modes.cols()), 100 * model.variance.sum() / model.total_variance);
    std::string text = line.data();
    for (Eigen::Index i = 0; i < model.variance.size(); ++i) {
        std::snprintf(line.data(), line.size(), "%3d %12.3f mm^2 %6.2f%%\n", static_cast<int>(i + 1),
                      model.variance[i], 100 * model.variance[i] / model.total_variance);
        text += line.data();
    }
    return text;
}

LipModel load_lip_model(const std::filesystem::path& path) {
    return read_lip_model(read_bytes(path, "lips", kLargestModel));
}

}  // namespace viaface

#include "synth/motion/retarget.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "viapoints/cells.hpp"

namespace viaface {
namespace {

using Eigen::Index;

constexpr std::string_view kLeft = "left", kRight = "right";

// "MouthSmileLeft" and "mouthSmile_L" as "mouthsmileleft".
std::string plain_name(std::string_view name) {
    const std::string lower = in_lower_case(name);
    const std::string stem = lower.substr(0, lower.size() - std::min<std::size_t>(2, lower.size()));
    if (lower.ends_with("_l")) return stem + std::string(kLeft);
    if (lower.ends_with("_r")) return stem + std::string(kRight);
    return lower;
}

const NamedShape* find_shape(const Face& face, const std::string& plain) {
    const auto found = std::ranges::find_if(
        face.shapes, [&](const NamedShape& shape) { return plain_name(shape.name) == plain; });
    return found == face.shapes.end() ? nullptr : &*found;
}

// The talker's shapes that a recorded one moves: its own, or those of both sides.
std::vector<const NamedShape*> shapes_for(const Face& face, const std::string& name) {
    const std::string plain = plain_name(name);
    if (const NamedShape* whole = find_shape(face, plain)) return {whole};
    const NamedShape* left = find_shape(face, plain + std::string(kLeft));
    const NamedShape* right = find_shape(face, plain + std::string(kRight));
    if (left == nullptr || right == nullptr) return {};
    return {left, right};
}

// The weights of a shape, NaN as the recording has them; empty when it was not recorded.
Eigen::VectorXd weights_of(const BlendRecording& recording, std::string_view plain) {
    for (std::size_t i = 0; i < recording.names.size(); ++i) {
        if (plain_name(recording.names[i]) == plain) return recording.weights.col(static_cast<Index>(i));
    }
    return {};
}

double largest_of(const Eigen::VectorXd& weights) {
    double largest = 0;
    for (const double weight : weights)
        largest = std::max(largest, std::isnan(weight) ? 0 : std::abs(weight));
    return largest;
}

// mouthClose limited by jawOpen.
Eigen::VectorXd closing(const Eigen::VectorXd& weights, const Eigen::VectorXd& jaw_open) {
    if (jaw_open.size() == 0) return Eigen::VectorXd::Zero(weights.size());
    Eigen::VectorXd limited = weights;
    for (Index i = 0; i < limited.size(); ++i) {
        if (limited[i] > jaw_open[i]) limited[i] = std::max(0.0, jaw_open[i]);
    }
    return limited;
}

void add_blinks(const BlendRecording& recording, Motion& motion) {
    for (const auto& [plain, name] :
         {std::pair{"eyeblinkleft", "eyeBlink_L"}, {"eyeblinkright", "eyeBlink_R"}}) {
        const Eigen::VectorXd weights = weights_of(recording, plain);
        if (weights.size() != 0) motion.extra.push_back({name, {weights.begin(), weights.end()}});
    }
}

}  // namespace

Retargeted retarget(const Face& face, const Poser& poser, const BlendRecording& recording) {
    if (recording.weights.cols() != static_cast<Index>(recording.names.size()) ||
        recording.weights.rows() != static_cast<Index>(recording.time_s.size())) {
        throw std::invalid_argument("a recording's names, times and weights differ in number");
    }
    const Configuration rest = poser.drawn_points(face.rest);
    Retargeted result;
    result.motion = {recording.time_s, rest.transpose().replicate(recording.weights.rows(), 1),
                     recording.extra};
    const Eigen::VectorXd jaw_open = weights_of(recording, "jawopen");
    for (std::size_t i = 0; i < recording.names.size(); ++i) {
        Eigen::VectorXd weights = recording.weights.col(static_cast<Index>(i));
        const auto shapes = shapes_for(face, recording.names[i]);
        const double largest = largest_of(weights);
        if (shapes.empty() && largest > 0) result.lacking.push_back({recording.names[i], largest});
        if (plain_name(recording.names[i]) == "mouthclose") weights = closing(weights, jaw_open);
        for (const NamedShape* shape : shapes) {
            const Configuration moved = poser.drawn_points(face.rest + shape->delta) - rest;
            result.motion.positions += weights * moved.transpose();
        }
    }
    std::ranges::stable_sort(result.lacking, std::greater<>(), &LackingShape::largest);
    add_blinks(recording, result.motion);
    return result;
}

}  // namespace viaface

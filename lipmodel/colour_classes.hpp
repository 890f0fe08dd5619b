// How well a colour fits lips, skin and the opening between the lips: mixtures of Gaussians in RGB, three for
// the lips and two for the skin, by expectation maximisation (OpenCV's). [Basu98, section 5.1] Departures:
// the paper has one for the skin, too few for a face half in shadow;
// the paper has no class for the opening; ours has two components, where there are samples of it. And the
// paper sums logarithms of densities, which grows by covering fewer pixels; ours are relative to the class
// that fits the pixel best, so that a pixel that fits counts nothing, and neither does one that fits no class
// (in shadow, say), whatever covers it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace viaface {

using Rgb = std::array<std::uint8_t, 3>;

// 8-bit RGB, rows one after the other from the top; borrowed.
struct Picture {
    int width = 0, height = 0;
    std::span<const std::uint8_t> rgb;  // [height x width x 3]

    Rgb at(int x, int y) const {
        const std::size_t i = 3 * (static_cast<std::size_t>(y) * width + x);
        return {rgb[i], rgb[i + 1], rgb[i + 2]};
    }
};

struct ColourGaussian {
    double weight = 1;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();            // RGB, 0 to 255
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  // positive definite
};

// Immutable.
class ColourMixture {
  public:
    // std::invalid_argument without components, or for a covariance that is none.
    explicit ColourMixture(std::vector<ColourGaussian> components);

    double density(const Rgb& colour) const;  // per unit volume of the colour cube (255^3 in all)
    const std::vector<ColourGaussian>& components() const { return components_; }

  private:
    struct Kernel {
        double height;
        Eigen::Matrix3d whitening;
    };
    std::vector<ColourGaussian> components_;
    std::vector<Kernel> kernels_;
};

// The same samples give the same mixture: it starts from the samples in the order of brightness, cut into
// equal parts. A variance of 2 is added to every channel. std::invalid_argument for fewer than ten samples a
// component.
ColourMixture learn_mixture(std::span<const Rgb> samples, int components);

inline constexpr int kLipComponents = 3, kSkinComponents = 2, kOpeningComponents = 2;
inline constexpr std::size_t kLeastSamples = 10;  // a component

struct ColourClasses {
    ColourMixture lips, skin;
    std::optional<ColourMixture> opening = {};
};

// Without a class for the opening where its samples are too few: a closed mouth shows none.
ColourClasses learn_classes(std::span<const Rgb> lips, std::span<const Rgb> skin,
                            std::span<const Rgb> opening = {});

struct ClassFit {
    double lips = 0, skin = 0, opening = 0;  // in (0, 1], the largest is 1
};
ClassFit fit_of(const ColourClasses& classes, const Rgb& colour);

}  // namespace viaface

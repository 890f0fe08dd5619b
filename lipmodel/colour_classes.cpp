#include "lipmodel/colour_classes.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/ml.hpp>
#include <stdexcept>

namespace viaface {
namespace {

constexpr double kNoiseVariance = 2;  // of a channel: rounding and a quiet camera
constexpr int kMostIterations = 50;
constexpr double kLeastGain = 1e-4;  // of the log likelihood: under 1/4 for 200 samples, which tell no more
constexpr double kCubeVolume = 256.0 * 256 * 256;

int brightness(const Rgb& c) { return c[0] + c[1] + c[2]; }

cv::Mat as_matrix(std::span<const Rgb> samples) {
    cv::Mat matrix(static_cast<int>(samples.size()), 3, CV_64F);
    for (int i = 0; i < matrix.rows; ++i) {
        for (int c = 0; c < 3; ++c) matrix.at<double>(i, c) = samples[i][c];
    }
    return matrix;
}

// One-hot: which part of the samples, sorted by brightness, each one belongs to. [samples x components]
cv::Mat first_guess(int samples, int components) {
    cv::Mat belongs = cv::Mat::zeros(samples, components, CV_64F);
    for (int i = 0; i < samples; ++i) belongs.at<double>(i, i * components / samples) = 1;
    return belongs;
}

ColourGaussian component_of(const cv::ml::EM& em, int i, const std::vector<cv::Mat>& covariances) {
    ColourGaussian made;
    made.weight = em.getWeights().at<double>(i);
    for (int r = 0; r < 3; ++r) {
        made.mean[r] = em.getMeans().at<double>(i, r);
        for (int c = 0; c < 3; ++c) made.covariance(r, c) = covariances[i].at<double>(r, c);
    }
    made.covariance.diagonal().array() += kNoiseVariance;
    return made;
}

}  // namespace

ColourMixture::ColourMixture(std::vector<ColourGaussian> components) : components_(std::move(components)) {
    if (components_.empty()) throw std::invalid_argument("ColourMixture: no components");
    for (const ColourGaussian& g : components_) {
        const Eigen::LLT<Eigen::Matrix3d> root(g.covariance);
        if (root.info() != Eigen::Success || !(g.weight >= 0))
            throw std::invalid_argument("ColourMixture: a covariance that is not positive definite");
        const double volume = std::pow(2 * std::numbers::pi, 1.5) * root.matrixL().determinant();
        kernels_.push_back({g.weight / volume, root.matrixL().solve(Eigen::Matrix3d::Identity())});
    }
}

double ColourMixture::density(const Rgb& colour) const {
    const Eigen::Vector3d place(colour[0], colour[1], colour[2]);
    double sum = 0;
    for (std::size_t i = 0; i < kernels_.size(); ++i) {
        const double far = (kernels_[i].whitening * (place - components_[i].mean)).squaredNorm();
        sum += kernels_[i].height * std::exp(-0.5 * far);
    }
    return sum;
}

ColourMixture learn_mixture(std::span<const Rgb> samples, int components) {
    if (components < 1 || samples.size() < kLeastSamples * components)
        throw std::invalid_argument("learn_mixture: too few samples");
    std::vector<Rgb> sorted(samples.begin(), samples.end());
    std::ranges::stable_sort(sorted, {}, brightness);
    const auto em = cv::ml::EM::create();
    em->setClustersNumber(components);
    em->setCovarianceMatrixType(cv::ml::EM::COV_MAT_GENERIC);
    em->setTermCriteria({cv::TermCriteria::COUNT + cv::TermCriteria::EPS, kMostIterations, kLeastGain});
    // From the M step on, for the E step would begin with random clusters.
    em->trainM(as_matrix(sorted), first_guess(static_cast<int>(sorted.size()), components));
    std::vector<cv::Mat> covariances;
    em->getCovs(covariances);
    std::vector<ColourGaussian> found;
    for (int i = 0; i < components; ++i) found.push_back(component_of(*em, i, covariances));
    return ColourMixture(std::move(found));
}

ColourClasses learn_classes(std::span<const Rgb> lips, std::span<const Rgb> skin,
                            std::span<const Rgb> opening) {
    ColourClasses classes{learn_mixture(lips, kLipComponents), learn_mixture(skin, kSkinComponents)};
    if (opening.size() >= kLeastSamples * kOpeningComponents)
        classes.opening = learn_mixture(opening, kOpeningComponents);
    return classes;
}

ClassFit fit_of(const ColourClasses& classes, const Rgb& colour) {
    constexpr double kAnything = 1 / kCubeVolume;  // any class may show any colour, now and then
    const double lips = kAnything + classes.lips.density(colour);
    const double skin = kAnything + classes.skin.density(colour);
    const double opening = kAnything + (classes.opening ? classes.opening->density(colour) : 0);
    const double best = std::max({lips, skin, opening});
    return {lips / best, skin / best, opening / best};
}

}  // namespace viaface

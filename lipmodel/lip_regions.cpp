#include "lipmodel/lip_regions.hpp"

#include <cmath>

#include "lipmodel/coloured_faces.hpp"

namespace viaface {
namespace {

void add_pixel(const Picture& picture, const Eigen::RowVector2d& place, std::vector<Rgb>& samples) {
    const long x = std::lround(place.x()), y = std::lround(place.y());
    if (x < 0 || y < 0 || x >= picture.width || y >= picture.height) return;
    samples.push_back(picture.at(static_cast<int>(x), static_cast<int>(y)));
}

}  // namespace

RegionSamples sample_regions(const Pinhole& camera, const LipPose& pose, const Nodes& lips,
                             const Picture& picture, double least_area) {
    const Pixels pixels = project(camera, pose, lips).pixels;
    RegionSamples samples;
    for (const ColouredFace& face : coloured_faces()) {
        if (!(visible_area(pixels, face.corners) >= least_area)) continue;
        auto& of_class = face.colour == ColourClass::kLips   ? samples.lips
                         : face.colour == ColourClass::kSkin ? samples.skin
                                                             : samples.opening;
        const Eigen::RowVector2d middle =
            (pixels.row(face.corners[0]) + pixels.row(face.corners[1]) + pixels.row(face.corners[2])) / 3;
        add_pixel(picture, middle, of_class);
        for (const int corner : face.corners)
            add_pixel(picture, 0.5 * (middle + pixels.row(corner)), of_class);
    }
    return samples;
}

}  // namespace viaface

// Where a face and its eyes are in a picture: the boosted cascades that Debian's opencv-data brings
// [ViolaJones01]. The paper places its model by hand.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "lipmodel/class_maps.hpp"

namespace viaface {

// Left and right as in the picture: the talker's right eye is on the left.
struct FaceInPicture {
    Eigen::Vector2d left_eye, right_eye;  // px
    bool eyes_seen = false;               // else where eyes are in most faces of this size
    int faces = 1;                        // met, this one among them

    double eye_distance() const { return (right_eye - left_eye).norm(); }  // px
    Eigen::Vector2d middle() const { return 0.5 * (left_eye + right_eye); }
    Eigen::Vector2d along() const { return (right_eye - left_eye).normalized(); }  // from eye to eye
    Eigen::Vector2d down() const { return {-along().y(), along().x()}; }           // towards the chin
};

// $VIAFACE_CASCADES, else where the package opencv-data puts them.
std::filesystem::path cascades_folder();

// One thread at a time. OpenCV itself is held to one thread, so that a picture always gives the same.
class FaceFinder {
  public:
    explicit FaceFinder(const std::filesystem::path& cascades = cascades_folder());  // std::runtime_error
    ~FaceFinder();

    // Among several the largest; with `before`, the one that is most like it in place and size.
    std::optional<FaceInPicture> find(const Picture& picture,
                                      const std::optional<FaceInPicture>& before = std::nullopt);

  private:
    struct Cascades;
    std::unique_ptr<Cascades> cascades_;
};

}  // namespace viaface

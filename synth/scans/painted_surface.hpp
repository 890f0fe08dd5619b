// A scanned surface with its colours, and an orthographic picture of it seen along -z.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "facemodel/face.hpp"
#include "facemodel/scan_mesh.hpp"

namespace viaface {

struct PaintedSurface {
    ScanMesh mesh;
    Texture picture;  // 3 channels; empty where the scan has no colour map

    bool painted() const { return !picture.pixels.empty() || !mesh.colours.empty(); }
    // sRGB, 0 to 255, at shares of a triangle's corners; mid grey where there is no colour.
    Eigen::Vector3f colour(int triangle, const Eigen::Vector3d& shares) const;
};

Eigen::Vector3f bilinear(const Texture& picture, double u, double v);  // v up; repeats beyond the edges

struct ViewWindow {
    double left = 0, top = 0;  // of the picture's upper left corner, the surface's unit
    double per_unit = 1;       // pixels
    int width = 0, height = 0;

    Eigen::Vector2d place(double column, double row) const {
        return {left + (column + 0.5) / per_unit, top - (row + 0.5) / per_unit};
    }
    Eigen::Vector2d pixel(double x, double y) const {
        return {(x - left) * per_unit - 0.5, (top - y) * per_unit - 0.5};
    }
};

struct SurfaceView {
    ViewWindow window;
    std::vector<float> depth;              // [height x width], z; NaN where nothing is seen
    std::vector<Eigen::Vector3f> colours;  // [height x width], sRGB 0 to 255
    std::vector<float> facing;  // [height x width], cosine between normal and the way to the viewer

    std::size_t at(int column, int row) const {
        return static_cast<std::size_t>(row) * window.width + column;
    }
    // Bilinear between pixels; NaN outside and beside nothing.
    float depth_at(double x, double y) const;
};

SurfaceView look(std::span<const PaintedSurface* const> surfaces, const ViewWindow& window);

// Correlation of brightness where both show something, -1 to 1.
double likeness(const SurfaceView& a, const SurfaceView& b);

// A window that shows all nodes, its longer side of so many pixels.
ViewWindow window_round(const Nodes& nodes, int side);

}  // namespace viaface

#include "synth/scans/painted_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace viaface {
namespace {

using Eigen::Vector2d, Eigen::Vector3d, Eigen::Vector3f;

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

void draw(SurfaceView& view, const PaintedSurface& surface, int triangle) {
    const Triangle& t = surface.mesh.triangles[triangle];
    Vector3d corner[3];
    Vector2d at[3];
    for (int k = 0; k < 3; ++k) {
        corner[k] = surface.mesh.nodes.row(t[k]);
        at[k] = view.window.pixel(corner[k].x(), corner[k].y());
    }
    const auto cross = [](const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); };
    const double area = cross(at[1] - at[0], at[2] - at[0]);
    if (std::abs(area) < 1e-12) return;
    const Vector3d normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
    const auto [left, right] = std::minmax({at[0].x(), at[1].x(), at[2].x()});
    const auto [top, bottom] = std::minmax({at[0].y(), at[1].y(), at[2].y()});
    for (int y = std::max(0, int(std::ceil(top))); y <= std::min(view.window.height - 1, int(bottom)); ++y) {
        for (int x = std::max(0, int(std::ceil(left))); x <= std::min(view.window.width - 1, int(right));
             ++x) {
            const Vector2d here(x, y);
            Vector3d shares;
            for (int k = 0; k < 3; ++k)
                shares[k] = cross(at[(k + 2) % 3] - at[(k + 1) % 3], here - at[(k + 1) % 3]) / area;
            if (shares.minCoeff() < -1e-9) continue;
            const auto z = static_cast<float>(shares[0] * corner[0].z() + shares[1] * corner[1].z() +
                                              shares[2] * corner[2].z());
            const std::size_t pixel = view.at(x, y);
            if (view.depth[pixel] >= z) continue;
            view.depth[pixel] = z;
            view.colours[pixel] = surface.colour(triangle, shares);
            view.facing[pixel] = static_cast<float>(normal.z());
        }
    }
}

}  // namespace

Vector3f bilinear(const Texture& picture, double u, double v) {
    const double x = (u - std::floor(u)) * picture.width - 0.5,
                 y = (1 - (v - std::floor(v))) * picture.height - 0.5;
    const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
    Vector3f sum = Vector3f::Zero();
    for (int dy = 0; dy < 2; ++dy) {
        for (int dx = 0; dx < 2; ++dx) {
            const int column = std::clamp(left + dx, 0, picture.width - 1),
                      row = std::clamp(top + dy, 0, picture.height - 1);
            const auto share =
                static_cast<float>((dx ? x - left : 1 - (x - left)) * (dy ? y - top : 1 - (y - top)));
            const std::uint8_t* pixel =
                &picture.pixels[(static_cast<std::size_t>(row) * picture.width + column) * picture.channels];
            sum += share * Vector3f(pixel[0], pixel[1], pixel[2]);
        }
    }
    return sum;
}

Vector3f PaintedSurface::colour(int triangle, const Vector3d& shares) const {
    if (!picture.pixels.empty() && !mesh.uv_triangles.empty()) {
        Vector2d uv = Vector2d::Zero();
        for (int k = 0; k < 3; ++k)
            uv += shares[k] * mesh.uvs.row(mesh.uv_triangles[triangle][k]).transpose();
        return bilinear(picture, uv.x(), uv.y());
    }
    Vector3f sum = Vector3f::Constant(mesh.colours.empty() ? 128 : 0);
    for (int k = 0; k < 3 && !mesh.colours.empty(); ++k) {
        const auto& c = mesh.colours[mesh.triangles[triangle][k]];
        sum += static_cast<float>(shares[k]) * Vector3f(c[0], c[1], c[2]);
    }
    return sum;
}

float SurfaceView::depth_at(double x, double y) const {
    const Vector2d pixel = window.pixel(x, y);
    const int left = static_cast<int>(std::floor(pixel.x())), top = static_cast<int>(std::floor(pixel.y()));
    if (left < 0 || top < 0 || left + 1 >= window.width || top + 1 >= window.height) return kNothing;
    const auto fx = static_cast<float>(pixel.x() - left), fy = static_cast<float>(pixel.y() - top);
    const auto mix = [](float a, float b, float share) { return a + (b - a) * share; };
    return mix(mix(depth[at(left, top)], depth[at(left + 1, top)], fx),
               mix(depth[at(left, top + 1)], depth[at(left + 1, top + 1)], fx), fy);
}

SurfaceView look(std::span<const PaintedSurface* const> surfaces, const ViewWindow& window) {
    SurfaceView view;
    view.window = window;
    const std::size_t pixels = static_cast<std::size_t>(window.width) * window.height;
    view.depth.assign(pixels, -std::numeric_limits<float>::infinity());
    view.colours.assign(pixels, Vector3f::Zero());
    view.facing.assign(pixels, 0);
    for (const PaintedSurface* surface : surfaces) {
        for (int t = 0; t < static_cast<int>(surface->mesh.triangles.size()); ++t) draw(view, *surface, t);
    }
    for (float& z : view.depth) z = std::isinf(z) ? kNothing : z;
    return view;
}

double likeness(const SurfaceView& a, const SurfaceView& b) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    Eigen::Matrix2d products = Eigen::Matrix2d::Zero();
    double count = 0;
    for (std::size_t i = 0; i < a.depth.size(); ++i) {
        if (std::isnan(a.depth[i]) || std::isnan(b.depth[i])) continue;
        const Vector2d pair(a.colours[i].sum(), b.colours[i].sum());
        sum += pair;
        products += pair * pair.transpose();
        count += 1;
    }
    if (count == 0) return 0;
    const Eigen::Matrix2d spread = products / count - sum * sum.transpose() / (count * count);
    return spread(0, 1) / std::sqrt(std::max(spread(0, 0) * spread(1, 1), 1e-9));
}

ViewWindow window_round(const Nodes& nodes, int side) {
    const Eigen::RowVector3d low = nodes.colwise().minCoeff(), high = nodes.colwise().maxCoeff();
    const double longer = std::max((high - low).head<2>().maxCoeff(), 1e-9);
    ViewWindow window;
    window.per_unit = 0.9 * side / longer;
    window.width = window.height = side;
    window.left = (low.x() + high.x()) / 2 - side / window.per_unit / 2;
    window.top = (low.y() + high.y()) / 2 + side / window.per_unit / 2;
    return window;
}

}  // namespace viaface

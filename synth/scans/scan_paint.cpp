#include "synth/scans/scan_paint.hpp"

#include <algorithm>
#include <cmath>

#include "synth/training/bake_texels.hpp"
#include "synth/training/collar.hpp"

namespace viaface {
namespace {

using Eigen::Vector3d, Eigen::Vector3f;

constexpr int kSpread = 24;  // texels
constexpr int kSoftRounds = 6;

// 1 where the scan's colour is taken, falling to 0 over some triangles towards where there is none. [nodes]
Eigen::VectorXd colour_share(const AdaptedHead& head, const GenericHead& lender) {
    const Face& face = lender.face;
    Eigen::VectorXd share = Eigen::VectorXd::Zero(face.rest.rows());
    for (Eigen::Index i = 0; i < share.size(); ++i)
        share[i] = head.covered[static_cast<std::size_t>(i)] ? 1 : 0;
    for (int round = 0; round < kSoftRounds; ++round) {
        Eigen::VectorXd sum = Eigen::VectorXd::Zero(share.size()), count = sum;
        for (const Triangle& t : lender.surface) {
            for (const int a : t) {
                for (const int b : t) sum[a] += share[b];
                count[a] += 3;
            }
        }
        for (Eigen::Index i = 0; i < share.size(); ++i) {
            if (count[i] > 0) share[i] = std::min(share[i], sum[i] / count[i]);
        }
    }
    for (Eigen::Index i = 0; i < share.size(); ++i) {
        const double t = std::clamp((share[i] - 0.3) / 0.6, 0.0, 1.0);
        share[i] = t * t * (3 - 2 * t);
    }
    for (std::size_t i = 0; i < face.weld.size(); ++i)
        share[static_cast<Eigen::Index>(i)] = share[face.weld[i]];
    return share;
}

// The share at each texel: laid out as if it were a coordinate.
TexelGrid laid_out_share(Face face, const Eigen::VectorXd& share, Material material, int side) {
    face.rest.col(0) = share;
    face.rest.rightCols<2>().setZero();
    return lay_out(face, material, side);
}

struct TexelColours {
    std::vector<Vector3f> colour;  // of the scan, sRGB 0 to 255
    std::vector<float> share;
};

TexelColours scanned_colours(const PaintedSurface& scan, const TexelGrid& grid, const TexelGrid& shares) {
    constexpr double kFar = 4;  // mm
    const NearestSurface surface(scan.mesh.nodes, scan.mesh.triangles);
    TexelColours found{std::vector<Vector3f>(grid.texels.size(), Vector3f::Zero()),
                       std::vector<float>(grid.texels.size())};
    for (std::size_t i = 0; i < grid.texels.size(); ++i) {
        const Texel& texel = grid.texels[i];
        const float share = shares.texels[i].place.x();
        if (texel.part < 0 || !(share > 0)) continue;
        const SurfacePlace near = surface(texel.place.cast<double>(), kFar);
        if (near.triangle < 0) continue;
        found.colour[i] = scan.colour(near.triangle, near.shares);
        found.share[i] = share;
    }
    return found;
}

// What brings the lender's colours to the scan's, by channel: over texels where both are there.
Vector3f gain_of(const Texture& lender, const TexelColours& scanned) {
    Vector3f theirs = Vector3f::Zero(), ours = Vector3f::Zero();
    for (std::size_t i = 0; i < scanned.share.size(); ++i) {
        if (scanned.share[i] < 0.3f) continue;
        const std::uint8_t* pixel = &lender.pixels[i * lender.channels];
        const Vector3f painted(pixel[0], pixel[1], pixel[2]);
        if (painted[0] < 90) continue;  // hair and brows
        theirs += painted;
        ours += scanned.colour[i];
    }
    if (theirs.minCoeff() <= 0) return Vector3f::Ones();
    return ours.cwiseQuotient(theirs).cwiseMax(0.25f).cwiseMin(2.5f);
}

void paint(const PaintedSurface& scan, const Eigen::VectorXd& share, const Face& lender, Face& face,
           Material material) {
    Texture& texture = face.surfaces[static_cast<std::size_t>(material)].base_colour;
    const TexelGrid grid = lay_out(face, material, texture.width),
                    theirs = lay_out(lender, material, texture.width);
    const TexelColours scanned =
        scanned_colours(scan, grid, laid_out_share(face, share, material, texture.width));
    const Vector3f gain = gain_of(texture, scanned);
    for (std::size_t i = 0; i < grid.texels.size(); ++i) {
        if (grid.texels[i].part < 0) continue;
        std::uint8_t* pixel = &texture.pixels[i * texture.channels];
        // The lender's shirt keeps its colour.
        const float bare = std::clamp(above_collar(theirs.texels[i].place) + 0.5f, 0.0f, 1.0f);
        for (int k = 0; k < 3; ++k) {
            const float painted = pixel[k] * (1 + bare * (gain[k] - 1));
            const float mixed = painted + scanned.share[i] * (scanned.colour[i][k] - painted);
            pixel[k] = static_cast<std::uint8_t>(std::clamp(mixed, 0.0f, 255.0f) + 0.5f);
        }
    }
    spread(texture, grid, kSpread);
}

}  // namespace

void paint_from_scan(const AdaptedHead& head, const GenericHead& lender, BorrowedTalker& talker) {
    if (!head.scan.painted()) return;
    PaintedSurface scan = head.scan;
    scan.mesh.nodes = talker.size * (scan.mesh.nodes.rowwise() + talker.shift.transpose());
    const Eigen::VectorXd share = colour_share(head, lender);
    paint(scan, share, lender.face, talker.face, Material::kSkin);
    paint(scan, share, lender.face, talker.face, Material::kLips);
}

}  // namespace viaface

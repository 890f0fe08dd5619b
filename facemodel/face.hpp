// A drawable face: one array of nodes, cut into parts with a material each, with its modes, named shapes,
// textures and lip rings. What face.glb holds. [ATR98, eqs. 1-7 and "Face and lip mesh adaptation"]
// Departure: the report's face has neither teeth, tongue, eyes nor the rest of the head; ours has.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "facemodel/mesh.hpp"

namespace viaface {

enum class Material : std::uint8_t { kSkin, kLips, kMouth, kGums, kTeeth, kTongue, kEye, kLash, kCloth };
inline constexpr int kMaterials = 9;

// What moves a part.
enum class Drive : std::uint8_t {
    kModes,   // the principal components
    kLips,    // the three lip contours
    kMouth,   // the inner lip contour in front, the jaw below: the lining of the mouth
    kJaw,     // rigid with the lower incisors
    kTongue,  // the tongue's points and the jaw
    kFixed    // rigid with the head
};

struct FacePart {
    std::string name;  // "skin", "lips", "mouth", "teeth_upper", "teeth_lower", "gums_upper", "gums_lower",
                       // "tongue", "eye_left", ...
    Material material = Material::kSkin;
    Drive drive = Drive::kFixed;
    int first_node = 0, nodes = 0;    // the part's nodes are consecutive
    std::vector<Triangle> triangles;  // indices into Face::rest, counter-clockwise from outside
};

struct NamedShape {
    std::string name;  // "jawOpen", "eyeBlink_L"
    Nodes delta;       // [nodes of the face x 3], mm, from rest at weight 1
};

struct Texture {
    int width = 0, height = 0, channels = 0;  // 3 or 4, 8 bits each, top row first
    std::vector<std::uint8_t> pixels;
};

// The textures of one material, in glTF's metallic-roughness sense; empty where a constant does.
struct Surface {
    Texture base_colour;  // sRGB, alpha in channel 4 where there are four
    Texture
        occlusion_roughness;  // linear: R occlusion, G roughness, B thinness (how much light comes through)
    Texture normal;           // tangent space
};

// The lip mesh: rows x columns nodes, row 0 the outer contour (welded to the skin), last row the inner
// contour; column 0 at the middle of the upper lip, then towards the talker's left and round. 15 x 40 = 600
// nodes.
struct LipGrid {
    static constexpr int kRows = 15, kColumns = 40, kMiddleRow = 7;
    int first_node = 0;
    int node(int row, int column) const {
        return first_node + row * kColumns + (column + kColumns) % kColumns;
    }
};

struct Face {
    Nodes rest;  // [nodes x 3], mm, head frame: closed relaxed
    Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor>
        uvs;                // [nodes x 2], own layout per material, v up
    std::vector<int> weld;  // [nodes] first node at the same place (seams of uv and parts): shares its normal
    std::vector<FacePart> parts;
    Eigen::VectorXd
        mean;  // [3 x nodes], mm: mean over the postures (eq. 2); equals rest where modes do not reach
    Eigen::MatrixXd modes;  // [3 x nodes, modes], orthonormal over the nodes driven by kModes, ordered by
                            // variance (eqs. 4-5); other rows: how the rest follows,
                            // for viewers
    Eigen::VectorXd mode_variance;   // [modes], mm^2
    std::vector<NamedShape> shapes;  // blend shapes by name on this mesh, blinks among them
    LipGrid lips;
    Eigen::Vector3d jaw_hinge = Eigen::Vector3d::Zero();  // mm: the axis (along x) about which the jaw opens
    std::array<Surface, kMaterials> surfaces;
};

// std::invalid_argument when the face has no such part.
const FacePart& part_named(const Face& face, std::string_view name);

}  // namespace viaface

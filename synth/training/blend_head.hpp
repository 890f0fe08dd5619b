// A blend-shape head in the ICT Face Model Light layout (one topology, a neutral head, named shapes), posed
// by weights: nodes = neutral + sum of weight * (shape - neutral). A person's identity is such a sum that
// stays: neutral and every pose have it. It is posed and scanned to make the built-in talkers; nothing of its
// files, topology or order reaches a talker.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "facemodel/obj.hpp"
#include "viapoints/layout.hpp"

namespace viaface {

using ShapeWeights =
    std::map<std::string, double>;  // shape name -> weight; "mouthPress" stands for both sides

class BlendHead {
  public:
    // Reads the neutral head and every shape; converts cm to mm in the head frame of viapoints/LAYOUT.md.
    // InputError("scans", folder, ...) when the folder is not such a head.
    explicit BlendHead(const std::filesystem::path& folder, const ShapeWeights& identity = {});

    const ObjScan& neutral() const { return neutral_; }  // of the person, mm, head frame
    const Nodes& generic() const { return generic_; }    // neutral of nobody, [nodes x 3], mm, head frame
    Nodes pose(const ShapeWeights& weights) const;       // [nodes x 3], mm, head frame
    std::vector<std::string> shape_names() const;        // sorted; without identities
    std::vector<std::string> identity_names() const;
    const std::vector<int>& landmarks() const {
        return landmarks_;
    }  // the 68 of the usual annotation, node indices

    // The layout's points on a posed head. The tongue of the scan does not move by itself: its points ride on
    // the jaw.
    Configuration points(const Nodes& posed) const;

    // Nodes [first, last) of the parts of the scan.
    struct Range {
        int first, last;
    };
    static constexpr Range kFace{0, 9409}, kHeadAndNeck{9409, 11248}, kMouthSocket{11248, 13294},
        kGumsAndTongue{14062, 17039}, kUpperTeeth{17039, 19247}, kLowerTeeth{19247, 21451},
        kEyeballs{21451, 24591}, kLashes{25351, 26719};

  private:
    void place_points();
    void become(const ShapeWeights& identity);
    Nodes with(Nodes nodes, const ShapeWeights& weights) const;
    const Nodes& delta(const std::string& name) const;

    ObjScan neutral_;
    Nodes generic_;
    std::map<std::string, Nodes> deltas_;
    std::vector<int> landmarks_;
    std::vector<std::vector<int>> point_nodes_;  // a point is the mean of these nodes; empty for the tongue
    Configuration rest_;
};

}  // namespace viaface

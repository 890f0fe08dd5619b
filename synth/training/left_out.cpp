#include "synth/training/left_out.hpp"

#include <algorithm>

#include "synth/pose/pose.hpp"

namespace viaface {
namespace {

struct Drawer {
    Face face;
    Poser poser;

    Drawer(const HeadToFace& source, const std::vector<Posture>& postures)
        : face(make_face(source, postures)), poser(face, pose_training(source, face, postures)) {}
};

DrawnDistance distance(const HeadToFace& source, const Drawer& drawer, const Posture& posture) {
    const Nodes scan = source.head().pose(posture.weights);
    const Nodes asked = source.posed(scan), drawn = drawer.poser.posed(source.head().points(scan));
    std::vector<double> distances;
    for (const FacePart& part : drawer.face.parts) {
        if (part.name != "skin" && part.name != "lips") continue;
        for (int i = part.first_node; i < part.first_node + part.nodes; ++i) {
            distances.push_back((asked.row(i) - drawn.row(i)).norm());
        }
    }
    std::sort(distances.begin(), distances.end());
    double sum = 0;
    for (const double d : distances) sum += d;
    const auto count = distances.size();
    return {posture.name, sum / static_cast<double>(count), distances[count * 95 / 100], distances.back()};
}

}  // namespace

std::vector<DrawnDistance> left_out_distances(const HeadToFace& source,
                                              const std::vector<Posture>& postures) {
    std::vector<DrawnDistance> table;
    for (std::size_t k = 0; k < postures.size(); ++k) {
        std::vector<Posture> others = postures;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
        table.push_back(distance(source, Drawer(source, others), postures[k]));
    }
    return table;
}

std::vector<DrawnDistance> unseen_distances(const HeadToFace& source, const std::vector<Posture>& unseen,
                                            const std::vector<Posture>& postures) {
    const Drawer drawer(source, postures);
    std::vector<DrawnDistance> table;
    for (const Posture& posture : unseen) table.push_back(distance(source, drawer, posture));
    return table;
}

}  // namespace viaface

#include "synth/picture/cut_face.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

namespace viaface {
namespace {

class Cutter {
  public:
    explicit Cutter(const Eigen::VectorXd& field) : field_(field) {}

    std::vector<Triangle> cut(const std::vector<Triangle>& triangles) {
        std::vector<Triangle> left;
        for (const Triangle& triangle : triangles) {
            switch (std::ranges::count_if(triangle, [&](int node) { return stays(node); })) {
                case 3:
                    left.push_back(triangle);
                    break;
                case 2:
                    add_rest_of(turned_to(triangle, false), left);
                    break;
                case 1:
                    add_tip_of(turned_to(triangle, true), left);
                    break;
            }
        }
        return left;
    }

    std::vector<CutNode> nodes;

  private:
    bool stays(int node) const { return field_[node] >= 0; }

    // The same triangle, its one node on the given side of the cut first.
    Triangle turned_to(Triangle t, bool side) const {
        while (stays(t[0]) != side || stays(t[1]) == side) std::rotate(t.begin(), t.begin() + 1, t.end());
        return t;
    }

    void add_tip_of(const Triangle& t, std::vector<Triangle>& left) {
        left.push_back({t[0], between(t[0], t[1]), between(t[0], t[2])});
    }

    void add_rest_of(const Triangle& t, std::vector<Triangle>& left) {
        const int one = between(t[1], t[0]), other = between(t[2], t[0]);
        left.push_back({one, t[1], t[2]});
        left.push_back({one, t[2], other});
    }

    int between(int inside, int outside) {
        const auto [made, is_new] =
            made_.try_emplace({inside, outside}, static_cast<int>(field_.size() + std::ssize(nodes)));
        if (is_new) nodes.push_back({inside, outside, field_[inside] / (field_[inside] - field_[outside])});
        return made->second;
    }

    const Eigen::VectorXd& field_;
    std::map<std::pair<int, int>, int> made_;
};

template <class Rows>
Rows rows_with_cut(const Rows& rows, const std::vector<CutNode>& nodes) {
    using Number = typename Rows::Scalar;
    Rows all(rows.rows() + std::ssize(nodes), rows.cols());
    all.topRows(rows.rows()) = rows;
    Eigen::Index at = rows.rows();
    for (const CutNode& node : nodes) {
        if (std::max(node.from, node.to) >= rows.rows())
            throw std::invalid_argument("a pose with too few nodes for a cut face");
        const auto share = static_cast<Number>(node.share);
        all.row(at++) = (1 - share) * rows.row(node.from) + share * rows.row(node.to);
    }
    return all;
}

}  // namespace

Nodes with_cut(const Nodes& whole, const std::vector<CutNode>& nodes) { return rows_with_cut(whole, nodes); }

CutFace cut_skin(Face face, const Eigen::VectorXd& field, bool (*keeps)(Material)) {
    CutFace cut{std::move(face), {}};
    Cutter cutter(field);
    for (FacePart& part : cut.face.parts) {
        if (part.material == Material::kSkin) {
            part.triangles = cutter.cut(part.triangles);
        } else if (!keeps(part.material)) {
            part.triangles.clear();
        }
    }
    cut.nodes = std::move(cutter.nodes);
    cut.face.rest = with_cut(cut.face.rest, cut.nodes);
    cut.face.uvs = rows_with_cut(cut.face.uvs, cut.nodes);
    for (auto i = std::ssize(cut.face.weld); i < cut.face.rest.rows(); ++i)
        cut.face.weld.push_back(static_cast<int>(i));
    return cut;
}

}  // namespace viaface

#include <render/accel/block_tree.h>
#include <render/accel/bvh.h>
#include <render/accel/sphere_block.h>
#include <render/accel/triangle_block.h>

#include <tuple>
#include <vector>

namespace render {

/// The kinds of leaf, in the order in which a ray tries them.
struct Bvh::Trees : std::tuple<BlockTree<TriangleBlock>, BlockTree<SphereBlock>> {
  using tuple::tuple;
  Trees() = default;
  explicit Trees(std::span<const Shape* const> shapes)
      : tuple(BlockTree<TriangleBlock>(shapes), BlockTree<SphereBlock>(shapes)) {}

  template <bool any> bool trace(const Ray& ray, Hit& hit) const {
    Float t_max = ray.t_max;
    bool found = false;
    const auto one = [&](const auto& tree) { found |= tree.template intersect<any>(ray, t_max, hit); };
    std::apply([&](const auto&... tree) { ((any && found ? void() : one(tree)), ...); }, kinds());
    return found;
  }
  const tuple& kinds() const { return *this; }
};

Bvh::Bvh() : Bvh(std::span<const Shape* const>{}) {}

Bvh::Bvh(std::span<const Shape* const> shapes) : trees_(std::make_shared<const Trees>(shapes)) {
  std::apply([&](const auto&... tree) { (bounds_.add(tree.bounds()), ...); }, trees_->kinds());
}

Bvh::Bvh(std::span<const Shape> shapes)
    : Bvh([&] {
        std::vector<const Shape*> all;
        for (const Shape& shape : shapes) all.push_back(&shape);
        return all;
      }()) {}

std::optional<Hit> Bvh::intersect(const Ray& ray) const {
  Hit hit;
  return trees_->trace<false>(ray, hit) ? std::optional(hit) : std::nullopt;
}

bool Bvh::occluded(const Ray& ray) const {
  Hit hit;
  return trees_->trace<true>(ray, hit);
}

} // namespace render

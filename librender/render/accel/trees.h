#pragma once
/// The trees of a Bvh, and the two questions that rays ask them, compiled for one instruction set or for several.

#include <render/accel/block_tree.h>
#include <render/accel/bvh.h>
#include <render/accel/sphere_block.h>
#include <render/accel/triangle_block.h>

#include <tuple>

namespace render {

static_assert(alignof(TriangleBlock) == 8 * sizeof(Float) && alignof(SphereBlock) == 8 * sizeof(double));

/// A tree for each kind of leaf.
template <class... Block> struct BlockTrees : std::tuple<BlockTree<Block>...> {
  BlockTrees() = default;
  explicit BlockTrees(std::span<const Shape* const> shapes)
      : std::tuple<BlockTree<Block>...>(BlockTree<Block>(shapes)...) {}
};

/// The kinds of leaf, in the order in which a ray tries them.
struct Bvh::Trees : BlockTrees<TriangleBlock, SphereBlock> {
  using BlockTrees::BlockTrees;

  template <bool any> bool trace(const Ray& ray, Hit& hit) const {
    Float t_max = ray.t_max;
    bool found = false;
    const auto one = [&](const auto& tree) { found |= tree.template intersect<any>(ray, t_max, hit); };
    std::apply([&](const auto&... tree) { ((any && found ? void() : one(tree)), ...); }, kinds());
    return found;
  }
  const tuple& kinds() const { return *this; }
};

/// trace.cpp, compiled for an instruction set.
struct Bvh::Trace {
  bool (*nearest)(const Trees& trees, const Ray& ray, Hit& hit);
  bool (*any)(const Trees& trees, const Ray& ray, Hit& hit);
};

/// native where the library is made for this machine alone, else those that it chooses from when it is loaded: all give
/// the same bits.
extern const Bvh::Trace trace_native, trace_baseline, trace_avx2, trace_avx512;

} // namespace render

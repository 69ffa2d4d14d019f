#pragma once
/// A tree with blocks of eight primitives as leaves.

#include <render/accel/wide_tree.h>
#include <render/shape/shape.h>

#include <mc/core/error.h>
#include <mc/core/memory.h>
#include <mc/core/parallel.h>

#include <algorithm>
#include <concepts>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

namespace render {

/// A tree over the primitives of one kind. A leaf is a Block of eight primitives; spare lanes repeat the last
/// primitive. Block defines:
///   Primitive         : one primitive, with bounds().
///   ShapeType         : kind of the shapes that consist of these primitives.
///   size(shape)       : number of primitives in a ShapeType, including degenerate ones.
///   collect(shape, index, begin, end, to) : writes the valid primitives of the nonempty range [begin, end) to `to`.
///   Returns the end of the output.
///   max_brute_force   : up to this number of primitives, each ray tests all blocks, which is faster than a tree.
///   RaySetup(ray)     : values of a ray that the blocks need, computed once per ray.
///   set(lane, primitive) : fills a lane.
///   intersect<any>(ray, setup, t_max, hit) : finds the nearest hit with 0 < t < t_max and stores it in t_max and
///   `hit`. With any = true, only returns whether there is a hit.
template <class Block> class BlockTree {
 public:
  /// An empty tree, which no ray hits.
  BlockTree() = default;
  /// Collects the primitives of all shapes and builds the tree.
  explicit BlockTree(std::span<const Shape* const> shapes) {
    const Primitives primitives = collected(shapes);
    const auto count = static_cast<std::uint32_t>(primitives.size());
    if (count > Block::max_brute_force) {
      mc::require_memory(build_bytes * double(count), fmt::format("the hierarchy of {} primitives", count),
                         "fewer of them need less");
      tree_ = WideTree(
          count, [&](std::size_t i) { return primitives[i].bounds(); }, lanes);
      bounds_ = tree_.bounds();
      const auto& leaves = tree_.leaves();
      blocks_.resize(leaves.size());
      mc::parallel_parts(leaves.size(), 1024, 0, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) fill(blocks_[i], primitives, tree_.order(), leaves[i]);
      });
      tree_.discard_leaves();
    } else {
      for (const Primitive& p : primitives) bounds_.add(p.bounds());
      std::vector<std::uint32_t> order(count);
      std::iota(order.begin(), order.end(), 0u);
      for (std::uint32_t first = 0; first < count; first += lanes)
        fill(blocks_.emplace_back(), primitives, order, {first, std::min(lanes, count - first)});
    }
  }

  /// Bounds of all primitives.
  const Bounds& bounds() const { return bounds_; }

  /// Intersects a ray with all blocks; arguments as for Block::intersect.
  template <bool any> bool intersect(const Ray& ray, Float& t_max, Hit& hit) const {
    if (blocks_.empty()) return false;
    const typename Block::RaySetup prepared(ray);
    bool found = false;
    if (tree_.empty()) {
      for (const Block& block : blocks_) {
        found |= block.template intersect<any>(ray, prepared, t_max, hit);
        if (any && found) return true;
      }
      return found;
    }
    constexpr auto order = any ? WideTree::Order::any : WideTree::Order::near_first;
    tree_.template traverse<order>(ray, t_max, [&](std::uint32_t leaf, Float& t) {
      found |= blocks_[leaf].template intersect<any>(ray, prepared, t, hit);
      return any && found;
    });
    return found;
  }

 private:
  using Primitive = typename Block::Primitive;
  using Primitives = std::vector<Primitive, HugePageAllocator<Primitive>>;
  static constexpr std::uint32_t lanes = 8;
  static constexpr double build_bytes = 85; ///< of a primitive while the tree is built, beside `primitives`

  // The functions of Block for any shape. Shapes of other kinds have no such primitives.
  static std::size_t size(const Shape& shape) {
    return dispatch(shape, []<class S>(const S& s) -> std::size_t {
      if constexpr (std::same_as<S, typename Block::ShapeType>) return Block::size(s);
      return 0;
    });
  }
  static Primitive* collect(const Shape& shape, int index, std::size_t begin, std::size_t end, Primitive* to) {
    return dispatch(shape, [&]<class S>(const S& s) {
      if constexpr (std::same_as<S, typename Block::ShapeType>) return Block::collect(s, index, begin, end, to);
      return to;
    });
  }

  // All valid primitives in the order of the shapes.
  static Primitives collected(std::span<const Shape* const> shapes) {
    std::vector<std::size_t> ends; // ends of the ranges of the shapes, degenerate primitives included
    for (const Shape* shape : shapes) ends.push_back((ends.empty() ? 0 : ends.back()) + size(*shape));
    const std::size_t size = ends.empty() ? 0 : ends.back();
    Primitives all(size);
    constexpr std::size_t most = 4096;
    // number of valid primitives of each part, which are at its front
    std::vector<std::size_t> useful((size + most - 1) / most);
    mc::parallel_parts(size, most, 0, [&](std::size_t begin, std::size_t end) {
      Primitive* to = &all[begin];
      auto shape = static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), begin) - ends.begin());
      for (std::size_t i = begin; i < end; ++shape) {
        const std::size_t first = shape == 0 ? 0 : ends[shape - 1], stop = std::min(end, ends[shape]);
        if (i < stop) to = collect(*shapes[shape], static_cast<int>(shape), i - first, stop - first, to);
        i = stop;
      }
      useful[begin / most] = static_cast<std::size_t>(to - &all[begin]);
    });
    auto last = all.begin();
    for (std::size_t i = 0; i < useful.size(); ++i) {
      const auto part = all.begin() + static_cast<std::ptrdiff_t>(i * most),
                 end = part + static_cast<std::ptrdiff_t>(useful[i]);
      last = part == last ? end : std::copy(part, end, last);
    }
    all.erase(last, all.end());
    return all;
  }
  static void fill(Block& block, const Primitives& primitives, const std::vector<std::uint32_t>& order,
                   const WideTree::Leaf& leaf) {
    for (std::uint32_t lane = 0; lane < lanes; ++lane)
      block.set(lane, primitives[order[leaf.first + std::min(lane, leaf.count - 1)]]);
  }

  WideTree tree_;                                       ///< empty for few primitives
  std::vector<Block, HugePageAllocator<Block>> blocks_; ///< one per leaf, or all blocks without a tree
  Bounds bounds_;
};

} // namespace render

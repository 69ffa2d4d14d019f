#pragma once
/// A tree whose leaves are blocks of eight primitives.

#include <render/accel/wide_tree.h>
#include <render/shape/shape.h>

#include <mc/core/parallel.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

namespace render {

/// A kind of leaf, Block, holds eight primitives of some shapes, spare lanes repeating the last one. It says
///   Block::Primitive             : a primitive, as collect() finds it, with its bounds()
///   Block::size(shape)           : how many primitives of this kind a shape has, useless ones included
///   Block::collect(shape, index, begin, end, to) : writes the useful ones of [begin, end), which is not empty, to `to`
///                                  and the following; says where they end
///   Block::few                   : up to so many, every ray tries all blocks: they cost less than a tree
///   Block::Prepared(ray)         : what the blocks need of a ray, computed once
///   set(lane, primitive)         : fills a lane
///   intersect<any>(ray, prepared, t_max, hit) : the nearest crossing with 0 < t < t_max, which becomes t_max and is
///                                  told in `hit`; any: whether there is one, no more
template <class Block> class BlockTree {
 public:
  BlockTree() = default;
  explicit BlockTree(std::span<const Shape* const> shapes) {
    const Primitives primitives = collected(shapes);
    const auto count = static_cast<std::uint32_t>(primitives.size());
    if (count > Block::max_brute_force) {
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

  const Bounds& bounds() const { return bounds_; }

  /// As Block's intersect.
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

  // In the order of the shapes.
  static Primitives collected(std::span<const Shape* const> shapes) {
    std::vector<std::size_t> ends; // of each shape's primitives, useless ones included
    for (const Shape* shape : shapes) ends.push_back((ends.empty() ? 0 : ends.back()) + Block::size(*shape));
    const std::size_t size = ends.empty() ? 0 : ends.back();
    Primitives all(size);
    constexpr std::size_t most = 4096;
    std::vector<std::size_t> useful((size + most - 1) / most); // of each part, at its front
    mc::parallel_parts(size, most, 0, [&](std::size_t begin, std::size_t end) {
      Primitive* to = &all[begin];
      auto shape = static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), begin) - ends.begin());
      for (std::size_t i = begin; i < end; ++shape) {
        const std::size_t first = shape == 0 ? 0 : ends[shape - 1], stop = std::min(end, ends[shape]);
        if (i < stop) to = Block::collect(*shapes[shape], static_cast<int>(shape), i - first, stop - first, to);
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

  WideTree tree_;                                       ///< none for few
  std::vector<Block, HugePageAllocator<Block>> blocks_; ///< one per leaf, or all
  Bounds bounds_;
};

} // namespace render

#pragma once
/// A tree whose leaves are blocks of eight primitives.

#include <render/accel/wide_tree.h>
#include <render/shape/shape.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

namespace render {

/// A kind of leaf, Block, holds eight primitives of some shapes, spare lanes repeating the last one. It says
///   Block::Primitive             : a primitive, as collect() finds it, with its bounds()
///   Block::collect(shape, index, found) : appends the primitives of a shape, if they are of this kind
///   Block::few                   : up to so many, every ray tries all blocks: they cost less than a tree
///   Block::Prepared(ray)         : what the blocks need of a ray, computed once
///   set(lane, primitive)         : fills a lane
///   intersect<any>(ray, prepared, t_max, hit) : the nearest crossing with 0 < t < t_max, which becomes t_max and is
///                                  told in `hit`; any: whether there is one, no more
template <class Block> class BlockTree {
 public:
  BlockTree() = default;
  explicit BlockTree(std::span<const Shape* const> shapes) {
    std::vector<typename Block::Primitive> primitives;
    for (std::size_t i = 0; i < shapes.size(); ++i) Block::collect(*shapes[i], static_cast<int>(i), primitives);
    std::vector<Bounds> boxes(primitives.size());
    std::transform(primitives.begin(), primitives.end(), boxes.begin(), [](const auto& p) { return p.bounds(); });
    for (const Bounds& b : boxes) bounds_.add(b);
    const auto add = [&](const std::vector<std::uint32_t>& order, std::uint32_t first, std::uint32_t count) {
      Block& block = blocks_.emplace_back();
      for (std::uint32_t lane = 0; lane < lanes; ++lane)
        block.set(lane, primitives[order[first + std::min(lane, count - 1)]]);
    };
    const auto count = static_cast<std::uint32_t>(boxes.size());
    if (count > Block::few) {
      tree_ = WideTree(boxes, lanes);
      blocks_.reserve(tree_.leaves().size());
      for (const auto& leaf : tree_.leaves()) add(tree_.order(), leaf.first, leaf.count);
      tree_.forget_leaves();
    } else {
      std::vector<std::uint32_t> order(count);
      std::iota(order.begin(), order.end(), 0u);
      for (std::uint32_t first = 0; first < count; first += lanes) add(order, first, std::min(lanes, count - first));
    }
  }

  const Bounds& bounds() const { return bounds_; }

  /// As Block's intersect.
  template <bool any> bool intersect(const Ray& ray, Float& t_max, Hit& hit) const {
    if (blocks_.empty()) return false;
    const typename Block::Prepared prepared(ray);
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
  static constexpr std::uint32_t lanes = 8;

  WideTree tree_;                               ///< none for few
  std::vector<Block, HugePages<Block>> blocks_; ///< one per leaf, or all
  Bounds bounds_;
};

} // namespace render

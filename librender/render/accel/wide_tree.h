#pragma once
/// An 8-wide bounding volume hierarchy over boxes, traversed one ray at a time.

#include <render/accel/binary_tree.h>
#include <render/core/huge_pages.h>
#include <render/core/lanes.h>
#include <render/core/ray.h>

#include <array>
#include <cstdint>
#include <vector>

namespace render {

/// An 8-wide bounding volume hierarchy. Leaves are blocks of up to `lanes` primitives, which the owner intersects.
///   build : a BinaryTree, collapsed to 8-wide nodes such that the expected number of node visits is minimal
///           [YlitieKarrasLaine17].
///   ray   : IEEE slab test. 1/0 = inf, and a NaN from 0 * inf never rejects a box, so axis-parallel rays in a box
///           plane hit.
class WideTree {
 public:
  static constexpr std::uint32_t block = 4; ///< Default number of primitives in a leaf.

  /// Builds the tree over `count` boxes as BinaryTree does. A leaf consists of the boxes order()[first .. first +
  /// count).
  WideTree(std::size_t count, const std::function<Bounds(std::size_t)>& box, std::uint32_t lanes = block);
  /// An empty tree, which no ray enters.
  WideTree() = default;

  /// Box indices in the order of the leaves.
  const std::vector<std::uint32_t>& order() const { return order_; }
  /// A range of order().
  struct Leaf {
    std::uint32_t first, count;
  };
  /// The leaves, indexed by the argument of the traversal callback.
  const std::vector<Leaf>& leaves() const { return leaves_; }
  /// Frees the memory of order() and leaves(), which traversal does not read. Assigning {} would keep the memory.
  void discard_leaves() {
    order_ = decltype(order_)();
    leaves_ = decltype(leaves_)();
  }
  /// Whether the tree has no nodes.
  bool empty() const { return nodes_.empty(); }
  /// Bounds of all boxes.
  const Bounds& bounds() const { return bounds_; }

  /// Order of leaves: near leaves first, or any order where one hit is as good as the nearest.
  enum class Order { near_first, any };
  /// Calls leaf(index, t_max) for each leaf that the ray may enter before t_max. `leaf` may reduce t_max; it returns
  /// true to stop.
  template <Order order_wanted = Order::near_first, class F>
  void traverse(const Ray& ray, Float& t_max, F&& leaf) const;

 private:
  struct alignas(64) Node {
    Lanes bounds[6]; ///< lo x, lo y, lo z, hi x, hi y, hi z
    std::uint32_t child[8];
  };
  static constexpr std::uint32_t leaf_bit = 0x80000000u;
  static constexpr int stack_size = 768; ///< 7 per level; the builder bounds the depth

  /// cuts[node][k - 1]: if k children replace a binary node, the number of them that replace its left subtree. 0 if a
  /// single child for the node is cheaper.
  using Cuts = std::vector<std::array<std::uint8_t, 8>>;
  static Cuts cheapest_cuts(const BinaryTree& tree);
  struct Part;
  static std::uint32_t collapse(const BinaryTree& tree, const Cuts& cuts, std::uint32_t root, std::size_t limit,
                                Part& part);
  void join(Part& top, const std::vector<Part>& parts);

  std::vector<Node, HugePageAllocator<Node>> nodes_;
  std::vector<Leaf> leaves_;
  std::vector<std::uint32_t> order_;
  Bounds bounds_; ///< of all boxes
};

template <WideTree::Order order_wanted, class F> void WideTree::traverse(const Ray& ray, Float& t_max, F&& leaf) const {
  if (nodes_.empty()) return;
  struct Entry {
    std::uint32_t child;
    Float t;
  };
  Entry stack[stack_size];
  int size = 0;

  const Vec3 rd = ray.d.cwiseInverse();
  // Enlarges the far distance by more than the rounding of the slab products, so that no box is missed [Ize13].
  const Vec3 rd_far = rd * (1 + 4 * std::numeric_limits<Float>::epsilon());
  Lanes o[3], r[3], r_far[3];
  int near[3], far[3];
  for (int a = 0; a < 3; ++a) {
    o[a] = ray.o[a] - Lanes{};
    r[a] = rd[a] - Lanes{};
    r_far[a] = rd_far[a] - Lanes{};
    near[a] = std::signbit(rd[a]) ? a + 3 : a;
    far[a] = std::signbit(rd[a]) ? a : a + 3;
  }

  std::uint32_t current = 0;
  while (true) {
    if (!(current & leaf_bit)) {
      const Node& node = nodes_[current];
      Lanes enter = Lanes{}, exit = t_max - Lanes{};
      for (int a = 0; a < 3; ++a) {
        const Lanes t0 = (node.bounds[near[a]] - o[a]) * r[a];
        const Lanes t1 = (node.bounds[far[a]] - o[a]) * r_far[a];
        enter = detail::larger(t0, enter); // NaN keeps the old value
        exit = detail::smaller(t1, exit);
      }
      unsigned mask = detail::less_equal(enter, exit);
      if (mask != 0) {
        // Visits the nearest child next. Pushes the others on the stack, nearer ones on top.
        const int first = __builtin_ctz(mask);
        mask &= mask - 1;
        current = node.child[first];
        if constexpr (order_wanted == Order::any) {
          for (; mask != 0; mask &= mask - 1) {
            const int i = __builtin_ctz(mask);
            stack[size++] = {node.child[i], enter[i]};
          }
          continue;
        }
        if (mask == 0) continue;
        Float t = enter[first];
        const int base = size;
        for (; mask != 0; mask &= mask - 1) {
          const int i = __builtin_ctz(mask);
          Entry entry{node.child[i], enter[i]};
          if (entry.t < t) {
            std::swap(entry.child, current);
            std::swap(entry.t, t);
          }
          int k = size++;
          for (; k > base && stack[k - 1].t < entry.t; --k) stack[k] = stack[k - 1];
          stack[k] = entry;
        }
        continue;
      }
    } else if (leaf(current & ~leaf_bit, t_max)) {
      return;
    }
    do {
      if (size == 0) return;
      --size;
    } while (stack[size].t > t_max);
    current = stack[size].child;
  }
}

} // namespace render

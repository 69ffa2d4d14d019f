#pragma once
/// A piecewise constant distribution on the unit cube of any dimension.

#include <mc/domain/box.h>
#include <mc/table/box_tree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace mc {

/// A partition of the unit cube into boxes by a kd-tree. A box is chosen with probability proportional to its weight;
/// points are uniform within. Boxes can be small where the density is large.
///   sample : finds the leaf of u, then maps its box of u linearly to its box of x. Points stay in their box if it is
///            wider than 4 eps.
///   pdf    : p / volume of the box that contains x [1/volume, in two dimensions 1/area]; 0 outside and in boxes of
///            weight 0. p is exactly the volume of the u that map to the box.
///   invert : |invert(sample(u)) - u| <= 4 eps + eps p' / x' for a side that spans a share p' of u and x' of x. The
///            second term is the rounding of x, magnified in narrow boxes.
///   reach  : a box less likely than the spacing of u (2^-24 float, 2^-53 double along an axis) needs a finer u to
///            occur.
///   throws : the errors of BoxTree, and Error for a tree of another dimension.
template <Real S, int N> class TableDistTree {
 public:
  using Scalar = S;
  using Domain = Box<S, N>;
  using Point = Vec<S, N>;

  /// Builds the partition from its nodes in preorder, see BoxTree.
  explicit TableDistTree(std::span<const BoxTreeNode> nodes) : tree_(N, nodes) {}
  /// The distribution of a tree with N dimensions.
  explicit TableDistTree(BoxTree tree) : tree_(std::move(tree)) {
    require(tree_.dim() == N, "TableDistTree: a tree of {} dimensions; {} are needed", tree_.dim(), N);
  }

  /// As BoxTree::from_function, for a function of Vec<double, N>.
  template <class F> static TableDistTree from_function(F&& f, std::size_t leaves) {
    return TableDistTree(BoxTree::from_function(
        N,
        [&](std::span<const double> x) { return static_cast<double>(f(Eigen::Map<const Vec<double, N>>(x.data()))); },
        leaves));
  }

  /// The tree of boxes.
  const BoxTree& tree() const { return tree_; }
  Domain domain() const { return {}; }

  Point sample(const Point& u) const {
    Point x = u;
    for (const BoxTree::AxisExtent& s : tree_.extents(tree_.leaf_of_u(u))) {
      const Wide v = (Wide(u[s.axis]) - s.u_lo) / (Wide(s.u_hi) - s.u_lo);
      x[s.axis] = inside(s.x_lo + v * (Wide(s.x_hi) - s.x_lo), s);
    }
    return x;
  }
  S pdf(const Point& x) const {
    if (!domain().contains(x)) return S(0);
    const std::size_t leaf = tree_.leaf_of_x(x);
    if constexpr (std::floating_point<S>) return S(tree_.density(leaf));
    else {
      S density = 1;
      for (const BoxTree::AxisExtent& s : tree_.extents(leaf)) density *= (S(s.u_hi) - s.u_lo) / (S(s.x_hi) - s.x_lo);
      return density;
    }
  }
  Point invert(const Point& x) const {
    Point u = x;
    for (const BoxTree::AxisExtent& s : tree_.extents(tree_.leaf_of_x(x))) {
      const Wide v = (Wide(x[s.axis]) - s.x_lo) / (Wide(s.x_hi) - s.x_lo);
      u[s.axis] = std::min(S(s.u_lo + v * (Wide(s.u_hi) - s.u_lo)), one_minus_epsilon<S>);
    }
    return u;
  }
  /// Places where the density may jump along each axis.
  std::array<std::vector<double>, N> breaks() const;
  template <Real T> TableDistTree<T, N> cast() const { return TableDistTree<T, N>(tree_); }

 private:
  // A float has too few bits for the planes of a large tree.
  using Wide = std::conditional_t<std::same_as<S, float>, double, S>;

  // Keeps the point in its box: rounding may have moved it into a neighbouring box, which may have weight 0.
  static S inside(Wide exact, const BoxTree::AxisExtent& s) {
    S x = S(exact);
    if constexpr (std::floating_point<S>) {
      if (x < s.x_lo) x = std::nextafter(x, S(1));
      if (x >= s.x_hi) x = std::nextafter(x, S(0));
    }
    return x;
  }

  BoxTree tree_;
};

template <Real S, int N> std::array<std::vector<double>, N> TableDistTree<S, N>::breaks() const {
  std::array<std::vector<double>, N> breaks;
  for (const BoxTreeNode& n : tree_.nodes())
    if (n.axis != BoxTreeNode::leaf) breaks[n.axis].push_back(n.value);
  for (std::vector<double>& places : breaks) {
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
  }
  return breaks;
}

} // namespace mc

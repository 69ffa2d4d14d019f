#pragma once
/// Products of domains, and the plane as a product.

#include <mc/domain/interval.h>

namespace mc {

namespace detail {
/// Number of coordinates of a point, and access to its part of a longer vector.
template <class P>
constexpr int numbers = [] {
  if constexpr (requires { P::SizeAtCompileTime; }) return int(P::SizeAtCompileTime);
  else return 1;
}();
template <class P, class V> P part(const V& v, int start) {
  if constexpr (numbers<P> == 1) return v[start];
  else return v.template segment<numbers<P>>(start);
}
template <class V, class P> void put(V& v, int start, const P& p) {
  if constexpr (numbers<P> == 1) v[start] = p;
  else v.template segment<numbers<P>>(start) = p;
}
} // namespace detail

/// Pairs (a, b) of points of two domains, with their coordinates in one vector.
///   chart : The charts of the two domains in separate coordinates. The Jacobian is the product of their Jacobians.
template <Domain A, Domain B>
requires std::same_as<typename A::Scalar, typename B::Scalar>
struct ProductDomain {
  using Scalar = typename A::Scalar;
  static constexpr int dim = A::dim + B::dim,     ///< Number of dimensions.
      split = detail::numbers<typename A::Point>; ///< Index of the first coordinate of b.
  using Point = Vec<Scalar, split + detail::numbers<typename B::Point>>;
  using UnitPoint = Vec<Scalar, dim>;
  /// Measure of densities on the domain.
  static constexpr Measure measure =
      A::measure == Measure::length && B::measure == Measure::length ? Measure::area : Measure::volume;

  A first;  ///< Domain of the leading coordinates.
  B second; ///< Domain of the remaining coordinates.

  /// Part of the point x in the first domain.
  static typename A::Point first_of(const Point& x) { return detail::part<typename A::Point>(x, 0); }
  /// Part of the point x in the second domain.
  static typename B::Point second_of(const Point& x) { return detail::part<typename B::Point>(x, split); }
  /// Part of the chart coordinates v of the first domain.
  static typename A::UnitPoint first_unit(const UnitPoint& v) { return detail::part<typename A::UnitPoint>(v, 0); }
  /// Part of the chart coordinates v of the second domain.
  static typename B::UnitPoint second_unit(const UnitPoint& v) {
    return detail::part<typename B::UnitPoint>(v, A::dim);
  }
  /// The pair (a, b) as one vector.
  static Point join(const typename A::Point& a, const typename B::Point& b) {
    Point x;
    detail::put(x, 0, a);
    detail::put(x, split, b);
    return x;
  }
  /// The pair (a, b) of chart coordinates as one vector.
  static UnitPoint join_unit(const typename A::UnitPoint& a, const typename B::UnitPoint& b) {
    UnitPoint v;
    detail::put(v, 0, a);
    detail::put(v, A::dim, b);
    return v;
  }

  Point from_unit(const UnitPoint& v) const {
    return join(first.from_unit(first_unit(v)), second.from_unit(second_unit(v)));
  }
  UnitPoint to_unit(const Point& x) const {
    return join_unit(first.to_unit(first_of(x)), second.to_unit(second_of(x)));
  }
  Scalar jacobian(const UnitPoint& v) const { return first.jacobian(first_unit(v)) * second.jacobian(second_unit(v)); }
  bool contains(const Point& x) const { return first.contains(first_of(x)) && second.contains(second_of(x)); }
  template <Real T> auto cast() const {
    return ProductDomain<decltype(first.template cast<T>()), decltype(second.template cast<T>())>{
        first.template cast<T>(), second.template cast<T>()};
  }
};

/// The plane. Each axis uses the chart of the real line.
template <Real S> using Plane = ProductDomain<RealLine<S>, RealLine<S>>;

} // namespace mc

#pragma once
/// Products of independent distributions.

#include <mc/domain/product.h>
#include <mc/warp/concept.h>
#include <mc/warp/normal.h>
#include <mc/warp/tent.h>

namespace mc {

/// Independent pairs (a, b). Concatenates the coordinates of u and of the points. A factor may be a product.
///   pdf    : pdf_a(a) pdf_b(b).
///   invert : each factor separately, with the bounds of the factors. Present if both factors are invertible.
template <Warp A, Warp B>
requires std::same_as<typename A::Scalar, typename B::Scalar>
struct Product {
  using Scalar = typename A::Scalar;
  using Domain = ProductDomain<typename A::Domain, typename B::Domain>;
  using Point = typename Domain::Point;
  using UnitPoint = typename Domain::UnitPoint;

  A first;  ///< Distribution of a.
  B second; ///< Distribution of b.

  Domain domain() const { return {first.domain(), second.domain()}; }
  Point sample(const UnitPoint& u) const {
    return Domain::join(first.sample(Domain::first_unit(u)), second.sample(Domain::second_unit(u)));
  }
  Scalar pdf(const Point& x) const { return first.pdf(Domain::first_of(x)) * second.pdf(Domain::second_of(x)); }
  UnitPoint invert(const Point& x) const requires InvertibleWarp<A> && InvertibleWarp<B> {
    return Domain::join_unit(first.invert(Domain::first_of(x)), second.invert(Domain::second_of(x)));
  }
  template <Real T> auto cast() const {
    return Product<decltype(first.template cast<T>()), decltype(second.template cast<T>())>{first.template cast<T>(),
                                                                                            second.template cast<T>()};
  }
};

/// Deduces the types of the factors.
template <class A, class B> Product(A, B) -> Product<A, B>;

/// The 2-D tent.
template <Real S> using Tent2D = Product<Tent<S>, Tent<S>>;
/// The 2-D Gaussian by inverse CDF, which maps strata of u to strata of the plane.
template <Real S> using Normal2D = Product<Normal<S>, Normal<S>>;

} // namespace mc

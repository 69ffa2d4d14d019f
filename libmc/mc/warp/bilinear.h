#pragma once
/// A bilinear density on the unit square.

#include <mc/domain/box.h>
#include <mc/warp/linear.h>

namespace mc {

/// Density on [0,1]^2 proportional to the bilinear interpolant w(x, y) of four corner values.
///   sample : y from the linear marginal with u1, then x from the linear conditional density at y with u0.
///   pdf    : 4 w(x, y) / (w00 + w10 + w01 + w11) [1/area]; 0 outside.
///   invert : |invert(sample(u)) - u| <= 16 eps.
///   throws : Error unless the values are finite, >= 0 and not all 0.
///   Source : [PharrJakobHumphreys23] section A.5.1.
/// The constructor scales the values so that the largest is 1. Values below min / eps of the largest count as 0.
/// A sample never lands on an edge with two zero corners.
template <Real S> struct Bilinear {
  using Scalar = S;
  using Domain = Square<S>;

  S w00 = 1,   ///< Value at the corner (0, 0). The largest of the four values is 1.
      w10 = 1, ///< Value at the corner (1, 0).
      w01 = 1, ///< Value at the corner (0, 1).
      w11 = 1; ///< Value at the corner (1, 1).

  Bilinear() = default;
  /// A density from the values w_xy at the corners (x, y), in any scale.
  Bilinear(S w00_, S w10_, S w01_, S w11_) : w00(w00_), w10(w10_), w01(w01_), w11(w11_) {
    using std::isfinite, std::max;
    const auto good = [](const S& w) { return isfinite(w) && w >= 0; };
    const S largest = max(max(w00, w10), max(w01, w11));
    require(good(w00) && good(w10) && good(w01) && good(w11) && largest > 0,
            "Bilinear: values {}, {}, {}, {} must be finite, >= 0 and not all 0", static_cast<double>(w00),
            static_cast<double>(w10), static_cast<double>(w01), static_cast<double>(w11));
    for (S* w : {&w00, &w10, &w01, &w11}) {
      *w /= largest;
      // its densities would underflow
      if (*w < std::numeric_limits<S>::min() / std::numeric_limits<S>::epsilon()) *w = 0;
    }
  }

  Domain domain() const { return {}; }
  Vec2<S> sample(const Vec2<S>& u) const {
    const S y = marginal().sample(u[1]);
    return {conditional(y).sample(u[0]), y};
  }
  S pdf(const Vec2<S>& p) const {
    if (!domain().contains(p)) return S(0);
    const Linear<S> row = at(p.y());
    return 4 * ((1 - p.x()) * row.a + p.x() * row.b) / (w00 + w10 + w01 + w11);
  }
  Vec2<S> invert(const Vec2<S>& p) const { return {conditional(p.y()).invert(p.x()), marginal().invert(p.y())}; }
  template <Real T> Bilinear<T> cast() const { return {T(w00), T(w10), T(w01), T(w11)}; }

 private:
  Linear<S> marginal() const { return {S(w00 + w10), S(w01 + w11)}; }
  Linear<S> conditional(const S& y) const {
    const Linear<S> row = at(y);
    return {row.a, row.b};
  }
  /// Unscaled values at the ends x = 0 and x = 1 of the row at height y.
  Linear<S> at(const S& y) const {
    Linear<S> row;
    row.a = (1 - y) * w00 + y * w01;
    row.b = (1 - y) * w10 + y * w11;
    return row;
  }
};

} // namespace mc

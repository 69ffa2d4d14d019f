#pragma once
/// A linear density on an interval.

#include <mc/domain/interval.h>
#include <mc/warp/concept.h>

namespace mc {

/// Density on [0,1] proportional to the line from a at x = 0 to b at x = 1.
///   sample : x = (a + b) / (a w + sqrt((a w)^2 (1-u) + b^2 w)), w = 1 / u. This is the stable root of the quadratic.
///            Every operation is monotone in u, so rounding keeps the sample monotone.
///   pdf    : 2 ((1-x) a + x b) / (a + b) [1/length]; 0 outside.
///   invert : |invert(sample(u)) - u| <= 8 eps.
///   throws : Error unless a and b are finite, >= 0 and not both 0.
///   Source : [PharrJakobHumphreys23] section 2.4.2. The values are scaled by the larger one, so weights of 1e30 and
///            1e-30 do not overflow.
template <Real S> struct Linear {
  using Scalar = S;
  using Domain = Interval<S>;

  S a = 1,   ///< Value at 0. The larger of the two values is 1.
      b = 1; ///< Value at 1.

  Linear() = default;
  /// A density from its end values, in any scale.
  Linear(S a_, S b_) : a(a_), b(b_) {
    using std::isfinite, std::max;
    require(isfinite(a) && isfinite(b) && a >= 0 && b >= 0 && (a > 0 || b > 0),
            "Linear: values {} and {} must be finite, >= 0 and not both 0", static_cast<double>(a),
            static_cast<double>(b));
    const S largest = max(a, b);
    a = a / largest;
    b = b / largest;
  }

  Domain domain() const { return {}; }
  S sample(S u) const {
    using std::max, std::min, std::sqrt;
    // For a = 0 the density vanishes at x = 0, so u = 0 is replaced by half a step of u.
    const S v = a == 0 ? S(max(u, S(std::numeric_limits<S>::epsilon() / 4))) : u;
    if (v == 0) return S(0);
    const S w = 1 / max(v, std::numeric_limits<S>::min()), aw = a * w;
    return min(S((a + b) / (aw + S(sqrt(S(aw * aw * (1 - v) + b * b * w))))), one_minus_epsilon<S>);
  }
  S pdf(S x) const { return x >= 0 && x <= 1 ? S(2 * ((1 - x) * a + x * b) / (a + b)) : S(0); }
  S invert(S x) const { return clamp_to_unit<S>(x * (a * (2 - x) + b * x) / (a + b)); }
  template <Real T> Linear<T> cast() const {
    Linear<T> other;
    other.a = T(a);
    other.b = T(b);
    return other;
  }
};

} // namespace mc

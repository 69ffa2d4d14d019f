#pragma once
/// Scalars, small vectors and constants that every file uses.

#include <Eigen/Core>

#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <numbers>
#include <type_traits>

namespace mc {

/// A real number type: float, double, or a multiprecision type such as the 50-digit type of check/subject/oracle.h.
/// Generic code writes `using std::sqrt; sqrt(x)`, so that lookup also finds the multiprecision overload.
template <class S>
concept Real = std::numeric_limits<S>::is_specialized && !std::numeric_limits<S>::is_integer;

namespace detail {
// Eigen aligns vectors with a multiple of 32 bytes by the instruction set of the translation unit. A library and its
// user may be compiled for different instruction sets, so these vectors keep the alignment of their components.
// Multiprecision vectors stay within one translation unit and need no such care.
template <class S, int N>
inline constexpr int vec_options = (std::is_floating_point_v<S> && (N > 0) && (N * int(sizeof(S))) % 32 == 0)
                                       ? Eigen::DontAlign
                                       : Eigen::AutoAlign;
} // namespace detail

/// A column vector of N components. Its size and alignment do not depend on compiler flags.
template <class S, int N> using Vec = Eigen::Matrix<S, N, 1, detail::vec_options<S, N>>;
/// A vector of two components.
template <class S> using Vec2 = Vec<S, 2>;
/// A vector of three components.
template <class S> using Vec3 = Vec<S, 3>;

namespace detail {
template <class S, int N> struct PointType { using type = Vec<S, N>; };
template <class S> struct PointType<S, 1> { using type = S; };
} // namespace detail

/// A point of an N-dimensional set: a plain scalar if N = 1, a column vector otherwise.
template <class S, int N> using Point = typename detail::PointType<S, N>::type;

/// pi, to the precision of S.
template <Real S>
inline const S pi = [] {
  if constexpr (std::floating_point<S>) return std::numbers::pi_v<S>;
  else return S(acos(S(-1)));
}();

/// The largest S below 1, which is the largest uniform number in [0,1).
template <Real S> inline const S one_minus_epsilon = S(1) - std::numeric_limits<S>::epsilon() / 2;

/// Clamps u to [0, one_minus_epsilon]. Inverses of warps use it, because rounding may carry
/// their result out of [0,1).
template <Real S> S clamp_to_unit(const S& u) {
  const S at_least_0 = u < 0 ? S(0) : u;
  return at_least_0 >= 1 ? one_minus_epsilon<S> : at_least_0;
}
/// Same for each component of a vector.
template <Real S, int N> Vec<S, N> clamp_to_unit(Vec<S, N> u) {
  for (int i = 0; i < N; ++i) u[i] = clamp_to_unit(u[i]);
  return u;
}

/// Positive infinity.
template <Real S> inline const S infinity = std::numeric_limits<S>::infinity();

/// The unsigned integer type with the width of float or double.
template <std::floating_point S> using BitsOf = std::conditional_t<sizeof(S) == 4, std::uint32_t, std::uint64_t>;

/// c ? a : b, by bit masks instead of a branch. For conditions on random numbers, where a branch is mispredicted half
/// of the time.
template <Real S> S choose(bool c, const S& a, const S& b) {
  if constexpr (std::floating_point<S>) {
    using Bits = BitsOf<S>;
    const Bits bits = std::bit_cast<Bits>(b);
    return std::bit_cast<S>(bits ^ ((std::bit_cast<Bits>(a) ^ bits) & (Bits{0} - Bits{c})));
  } else {
    return c ? a : b;
  }
}

/// x^2.
template <class S> constexpr S sqr(const S& x) { return x * x; }

/// sqrt(max(x, 0)), for radicands that rounding may carry just below 0. Returns NaN for NaN.
template <Real S> S safe_sqrt(const S& x) {
  using std::sqrt;
  return sqrt(x < 0 ? S(0) : x); // the choice inside the root lets loops vectorise
}

/// a b - c d without cancellation when the products nearly agree (Kahan's algorithm): two roundings instead of three.
///   error  : 1.5 ulp of the result [JeannerodLouvetMuller13].
template <Real S> S difference_of_products(const S& a, const S& b, const S& c, const S& d) {
  using std::fma;
  const S cd = c * d;
  return S(fma(a, b, S(-cd))) + S(fma(S(-c), d, cd));
}

/// Cross product a x b, each component by difference_of_products().
template <Real S> Vec3<S> cross(const Vec3<S>& a, const Vec3<S>& b) {
  return {difference_of_products(a.y(), b.z(), a.z(), b.y()), difference_of_products(a.z(), b.x(), a.x(), b.z()),
          difference_of_products(a.x(), b.y(), a.y(), b.x())};
}

/// Cartesian direction from the sine and cosine of the polar angle and the azimuth phi [rad].
template <Real S> Vec3<S> spherical_direction(const S& sin_theta, const S& cos_theta, const S& phi) {
  using std::cos, std::sin;
  return {sin_theta * S(cos(phi)), sin_theta * S(sin(phi)), cos_theta};
}

/// Converts a scalar, or every component of a vector, to the scalar type T.
template <class T, class P> auto cast_point(const P& p) {
  if constexpr (requires { p.template cast<T>(); }) return Vec<T, P::RowsAtCompileTime>(p.template cast<T>());
  else return T(p);
}

} // namespace mc

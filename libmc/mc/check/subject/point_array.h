#pragma once
/// Points of any type as arrays of doubles and as text.

#include <mc/core/types.h>

#include <fmt/format.h>

#include <array>
#include <span>
#include <string>

namespace mc {

/// The coordinates of a point; unused entries are 0. Doubles represent floats exactly.
using PointArray = std::array<double, 6>;

/// Returns "0.25" or "(0.25, 0.5)", each number with the given number of digits.
inline std::string format_numbers(std::span<const double> numbers, int digits) {
  std::string text;
  for (const double x : numbers) text += fmt::format("{}{:.{}g}", text.empty() ? "" : ", ", x, digits);
  return numbers.size() == 1 ? text : "(" + text + ")";
}

namespace detail {

template <class P> double component(const P& x, int i) {
  if constexpr (requires { x.size(); }) return static_cast<double>(x[i]);
  else return static_cast<double>(x);
}

template <class P> int components(const P& x) {
  if constexpr (requires { x.size(); }) return static_cast<int>(x.size());
  else return 1;
}

/// Number of coordinates of a point type.
template <class P> constexpr int point_size() {
  if constexpr (requires { P::SizeAtCompileTime; }) return P::SizeAtCompileTime;
  else return 1;
}

/// Returns the coordinates of a point converted to T; a scalar becomes the first entry.
template <class T, std::size_t N = std::tuple_size_v<PointArray>, class P> std::array<T, N> to_array(const P& x) {
  static_assert(point_size<P>() <= static_cast<int>(N));
  std::array<T, N> a{};
  if constexpr (point_size<P>() == 1) a[0] = static_cast<T>(x);
  else
    for (int i = 0; i < point_size<P>(); ++i) a[static_cast<std::size_t>(i)] = static_cast<T>(x[i]);
  return a;
}

/// Returns the point of type P with the given coordinates, rounded to its scalar.
template <class P, class Array> P to_point(const Array& a) {
  if constexpr (point_size<P>() == 1) return static_cast<P>(a[0]);
  else {
    P x;
    for (int i = 0; i < point_size<P>(); ++i) x[i] = static_cast<typename P::Scalar>(a[static_cast<std::size_t>(i)]);
    return x;
  }
}

template <class P> bool all_finite(const P& x) {
  for (int i = 0; i < components(x); ++i)
    if (!std::isfinite(component(x, i))) return false;
  return true;
}

/// Returns "(0.25, 0.5)" with enough digits to identify the point.
template <class P> std::string format_point(const P& x) {
  if constexpr (requires { x.size(); }) {
    const auto wide = x.template cast<double>().eval();
    std::string text = format_numbers({wide.data(), static_cast<std::size_t>(wide.size())},
                                      std::numeric_limits<typename P::Scalar>::max_digits10);
    return wide.size() == 1 ? "(" + text + ")" : text;
  } else {
    const double wide = static_cast<double>(x);
    return format_numbers({&wide, 1}, std::numeric_limits<P>::max_digits10);
  }
}

} // namespace detail

} // namespace mc

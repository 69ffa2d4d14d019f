#pragma once
/// Pixel reconstruction filters, applied by importance sampling.

#include <render/core/dispatch.h>
#include <render/core/types.h>

#include <cmath>

namespace render {

namespace detail {
inline Float checked_width(std::string_view what, Float width) {
  mc::require(std::isfinite(width) && width > 0, "{} {} must be finite and > 0", what, width);
  return width;
}
} // namespace detail

/// Offset of a sample from the pixel's centre [pixels], u in [0,1)^2. Samples belong to one pixel each and weigh the
/// same, so pixels stay independent estimates [ErnstEtAl06]. All throw Error unless their width is finite and > 0.
struct BoxFilter {
  Float radius;
  explicit BoxFilter(Float r = Float(0.5)) : radius(detail::checked_width("box filter: radius", r)) {}
  Vec2 sample(const Vec2& u) const { return radius * (2 * u - Vec2::Ones()); }
};

/// Triangle function of half width `radius`; variance radius^2 / 6 per axis.
struct TentFilter {
  Float radius;
  explicit TentFilter(Float r = 1) : radius(detail::checked_width("tent filter: radius", r)) {}
  static Float tent(Float u) { return u < Float(0.5) ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u); }
  Vec2 sample(const Vec2& u) const { return {radius * tent(u[0]), radius * tent(u[1])}; }
};

/// Normal distribution of standard deviation sigma [pixels], not truncated; by Box and Muller's transform. 1 - u is
/// exact for the multiples of 2^-24 that u is.
struct GaussianFilter {
  Float sigma;
  explicit GaussianFilter(Float s = Float(0.5)) : sigma(detail::checked_width("gaussian filter: stddev", s)) {}
  Vec2 sample(const Vec2& u) const {
    const Float r = sigma * std::sqrt(-2 * std::log(1 - u[0])), phi = 2 * mc::pi<Float> * u[1];
    return {r * std::cos(phi), r * std::sin(phi)};
  }
};

/// The mean of n x n tents of half width `radius`, one about the centre of each subpixel: the filter of smallpt (n =
/// 2).
struct SubpixelTentFilter {
  int n;
  Float radius;
  explicit SubpixelTentFilter(int subpixels = 2, Float r = Float(0.5))
      : n(subpixels), radius(detail::checked_width("subpixel tent filter: radius", r)) {
    mc::require(n >= 1, "subpixel tent filter: n {} must be at least 1", n);
  }
  Float axis(Float u) const {
    const Float cell = std::min(std::floor(u * Float(n)), Float(n - 1));
    return (cell + Float(0.5)) / Float(n) - Float(0.5) + radius * TentFilter::tent(u * Float(n) - cell);
  }
  Vec2 sample(const Vec2& u) const { return {axis(u[0]), axis(u[1])}; }
};

struct Filter : std::variant<BoxFilter, TentFilter, GaussianFilter, SubpixelTentFilter> {
  using variant::variant;
  Vec2 sample(const Vec2& u) const {
    return dispatch(*this, [&](const auto& f) { return f.sample(u); });
  }
};

} // namespace render

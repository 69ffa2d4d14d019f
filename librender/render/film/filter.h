#pragma once
/// Pixel reconstruction filters: warps on the plane.

#include <render/core/dispatch.h>
#include <render/core/types.h>

#include <mc/table/discrete.h>
#include <mc/warp/isotropic_normal.h>
#include <mc/warp/mixture_n.h>
#include <mc/warp/product.h>
#include <mc/warp/uniform.h>

namespace render {

// Each filter is a warp; its point is the offset of a sample from the pixel's centre [pixels]. Samples belong to one
// pixel each and weigh the same, so pixels stay independent estimates [ErnstEtAl06]. All throw Error unless their width
// is finite and > 0.

/// Uniform on the square of half width `radius`.
struct BoxFilter : mc::UniformBox<Float, 2> {
  explicit BoxFilter(Float radius = Float(0.5)) : UniformBox(Vec2::Constant(-radius), Vec2::Constant(radius)) {}
};

/// Triangle function of half width `radius`; variance radius^2 / 6 per axis.
struct TentFilter : mc::Tent2D<Float> {
  explicit TentFilter(Float radius = 1) : Product{{0, radius}, {0, radius}} {}
};

/// Normal distribution of standard deviation sigma, not truncated.
struct GaussianFilter : mc::IsotropicNormal<Float> {
  explicit GaussianFilter(Float stddev = Float(0.5)) : IsotropicNormal(stddev) {}
};

using TentRow = mc::MixtureN<mc::Interval<Float>, mc::Tent<Float>, mc::UniformDiscrete<Float>>;

/// The mean of n x n tents of half width `radius`, one about the centre of each subpixel: smallpt's filter (n = 2).
///   throws : Error unless n >= 1, too
struct SubpixelTentFilter : mc::Product<TentRow, TentRow> {
  explicit SubpixelTentFilter(int n = 2, Float radius = Float(0.5)) : Product{row(n, radius), row(n, radius)} {}

 private:
  static TentRow row(int n, Float radius) {
    mc::require(n >= 1, "subpixel tent filter: n {} must be at least 1", n);
    std::vector<mc::Tent<Float>> tents;
    tents.reserve(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) tents.emplace_back((Float(i) + Float(0.5)) / Float(n) - Float(0.5), radius);
    return {{tents.front().domain().lo, tents.back().domain().hi},
            mc::UniformDiscrete<Float>(static_cast<std::size_t>(n)),
            tents};
  }
};

/// One of the filters; itself a warp.
struct Filter : std::variant<BoxFilter, TentFilter, GaussianFilter, SubpixelTentFilter> {
  using variant::variant;

  Vec2 sample(const Vec2& u) const {
    return dispatch(*this, [&](const auto& f) { return f.sample(u); });
  }
  Float pdf(const Vec2& offset) const {
    return dispatch(*this, [&](const auto& f) { return f.pdf(offset); });
  }
};

} // namespace render

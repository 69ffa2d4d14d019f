#pragma once
/// Pixel reconstruction filters: warps on the plane, and how their samples are shared.

#include <render/core/dispatch.h>
#include <render/core/types.h>

#include <mc/table/discrete.h>
#include <mc/warp/isotropic_normal.h>
#include <mc/warp/mixture_n.h>
#include <mc/warp/product.h>
#include <mc/warp/uniform.h>

#include <cmath>

namespace render {

// Each filter is a warp; its point is the offset of a sample from the pixel's centre [pixels]. Samples belong to one
// pixel each and weigh the same, so pixels are independent estimates [ErnstEtAl06]; SplatFilter is the other way. All
// are products of one `profile` along both axes, 0 beyond `radius`, and throw Error unless their width is finite and
// > 0.

/// Uniform on the square of half width `radius`.
struct BoxFilter : mc::UniformBox<Float, 2> {
  explicit BoxFilter(Float radius = Float(0.5)) : UniformBox(Vec2::Constant(-radius), Vec2::Constant(radius)) {}

  double radius() const { return double(domain().hi[0]); }
  double profile(double x) const { return std::abs(x) <= radius() ? 0.5 / radius() : 0; }
};

/// Triangle function of half width `radius`; variance radius^2 / 6 per axis.
struct TentFilter : mc::Tent2D<Float> {
  explicit TentFilter(Float radius = 1) : Product{{0, radius}, {0, radius}} {}

  double radius() const { return double(first.radius); }
  double profile(double x) const { return double(first.pdf(Float(x))); }
};

/// Normal distribution of standard deviation sigma, not truncated: 6e-7 of its profile lies beyond its radius.
struct GaussianFilter : mc::IsotropicNormal<Float> {
  explicit GaussianFilter(Float stddev = Float(0.5)) : IsotropicNormal(stddev) {}

  double radius() const { return 5 * double(sigma); }
  double profile(double x) const {
    const double s = double(sigma);
    return std::exp(-x * x / (2 * s * s)) / (s * std::sqrt(2 * mc::pi<double>));
  }
};

using TentRow = mc::MixtureN<mc::Interval<Float>, mc::Tent<Float>, mc::UniformDiscrete<Float>>;

/// The mean of n x n tents of half width `radius`, one about the centre of each subpixel: smallpt's filter (n = 2).
///   throws : Error unless n >= 1, too
struct SubpixelTentFilter : mc::Product<TentRow, TentRow> {
  explicit SubpixelTentFilter(int n = 2, Float radius = Float(0.5)) : Product{row(n, radius), row(n, radius)} {}

  double radius() const { return double(first.domain().hi); }
  double profile(double x) const { return double(first.pdf(Float(x))); }

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
  double radius() const {
    return dispatch(*this, [](const auto& f) { return f.radius(); });
  }
};

/// A scene's filter f, by which each sample counts for all pixels that it lies near: sample i of the square of a pixel
/// q, uniform there, counts for the pixel p with the weight f(x_i - p), and p is the sum over the squares q of the
/// means of f(x_i - p) L_i. As little noise as of noise_area times as many samples drawn from the filter of one pixel
/// each; neighbours share it.
///   throws : Error for a filter whose radius is above `max_radius`
class SplatFilter {
 public:
  static constexpr double max_radius = 64; ///< [pixels]: a sample counts for 16,000

  explicit SplatFilter(const Filter& filter);

  /// Pixels to each side that a sample counts for.
  int reach() const { return static_cast<int>(squared_weights_.size() / 2); }
  std::size_t side() const { return squared_weights_.size(); } ///< 2 reach + 1

  /// The profile at the offset from a pixel's centre along one axis, seen from that pixel and `reach` to each side: at
  /// offset + reach, ..., offset - reach [1/pixels].
  void profile(double offset, std::vector<double>& values) const;

  /// The mean over the samples of a pixel's square of the squared weight with which they count for the pixel (dx, dy)
  /// away, at most `reach`.
  double squared_weight(int dx, int dy) const { return along_axis(dx) * along_axis(dy); }

  /// The sum of all squares is 1 / noise_area [pixels].
  double noise_area() const { return noise_area_; }

  /// Whether splats gain something: a filter as narrow as a pixel leaves nothing to share.
  bool is_wide() const { return noise_area_ > 1.001; }

 private:
  double along_axis(int pixels) const {
    const int place = pixels + reach();
    return squared_weights_[static_cast<std::size_t>(place)];
  }

  Filter filter_;
  std::vector<double> squared_weights_;
  double noise_area_;
};

} // namespace render

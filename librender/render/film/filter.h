#pragma once
/// Pixel reconstruction filters, and splatting with them.

#include <render/core/dispatch.h>
#include <render/core/types.h>

#include <mc/table/discrete.h>
#include <mc/warp/isotropic_normal.h>
#include <mc/warp/mixture_n.h>
#include <mc/warp/product.h>
#include <mc/warp/uniform.h>

#include <cmath>

namespace render {

// Each filter is a warp: it maps u to the offset of a sample from the pixel's centre [pixels]. Each sample then belongs
// to one pixel with weight 1, and pixels are independent estimates [ErnstEtAl06]. SplatFilter shares samples instead.
// Every filter is a product of one `profile` along both axes, 0 beyond `radius`. Constructors throw Error unless the
// width is finite and > 0.

/// Box filter: uniform on the square of half width `radius`.
struct BoxFilter : mc::UniformBox<Float, 2> {
  /// radius : half width [pixels].
  explicit BoxFilter(Float radius = Float(0.5)) : UniformBox(Vec2::Constant(-radius), Vec2::Constant(radius)) {}

  /// Half width [pixels].
  double radius() const { return double(domain().hi[0]); }
  /// Density along one axis [1/pixel].
  double profile(double x) const { return std::abs(x) <= radius() ? 0.5 / radius() : 0; }
};

/// Tent filter: triangle function of half width `radius`, with variance radius^2 / 6 per axis.
struct TentFilter : mc::Tent2D<Float> {
  /// radius : half width [pixels].
  explicit TentFilter(Float radius = 1) : Product{{0, radius}, {0, radius}} {}

  /// Half width [pixels].
  double radius() const { return double(first.radius); }
  /// Density along one axis [1/pixel].
  double profile(double x) const { return double(first.pdf(Float(x))); }
};

/// Gaussian filter: normal distribution of standard deviation sigma, not truncated. A share of 6e-7 lies beyond
/// `radius`.
struct GaussianFilter : mc::IsotropicNormal<Float> {
  /// stddev : standard deviation [pixels].
  explicit GaussianFilter(Float stddev = Float(0.5)) : IsotropicNormal(stddev) {}

  /// Five standard deviations [pixels].
  double radius() const { return 5 * double(sigma); }
  /// Density along one axis [1/pixel].
  double profile(double x) const {
    const double s = double(sigma);
    return std::exp(-x * x / (2 * s * s)) / (s * std::sqrt(2 * mc::pi<double>));
  }
};

/// One axis of SubpixelTentFilter.
using TentRow = mc::MixtureN<mc::Interval<Float>, mc::Tent<Float>, mc::UniformDiscrete<Float>>;

/// Mean of n x n tents of half width `radius`, one about the centre of each subpixel. n = 2 is smallpt's filter.
///   throws : Error also unless n >= 1.
struct SubpixelTentFilter : mc::Product<TentRow, TentRow> {
  /// n : number of subpixels per axis; radius : half width of each tent [pixels].
  explicit SubpixelTentFilter(int n = 2, Float radius = Float(0.5)) : Product{row(n, radius), row(n, radius)} {}

  /// Half width of the support [pixels].
  double radius() const { return double(first.domain().hi); }
  /// Density along one axis [1/pixel].
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

/// Any of the filters; itself a warp.
struct Filter : std::variant<BoxFilter, TentFilter, GaussianFilter, SubpixelTentFilter> {
  using variant::variant;

  Vec2 sample(const Vec2& u) const {
    return dispatch(*this, [&](const auto& f) { return f.sample(u); });
  }
  Float pdf(const Vec2& offset) const {
    return dispatch(*this, [&](const auto& f) { return f.pdf(offset); });
  }
  /// Largest distance from the centre along one axis with a positive profile [pixels]; see GaussianFilter.
  double radius() const {
    return dispatch(*this, [](const auto& f) { return f.radius(); });
  }
};

/// Splatting with a scene's filter f: each sample counts for all pixels under the filter. Samples are uniform in the
/// square of each pixel. Sample i of square q counts for pixel p with the weight f(x_i - p). The value of p is the sum
/// over the squares q of the mean of f(x_i - p) L_i. The noise is as low as from noise_area() times the number of own
/// samples, but neighbouring pixels are correlated.
///   throws : Error if the radius of the filter exceeds `max_radius`.
class SplatFilter {
 public:
  static constexpr double max_radius = 64; ///< Largest radius [pixels]; a sample then counts for about 16,000 pixels.

  /// Prepares splatting with a filter, which is copied.
  explicit SplatFilter(const Filter& filter);

  /// Number of pixels to each side that a sample counts for.
  int reach() const { return static_cast<int>(squared_weights_.size() / 2); }
  /// Number of pixels along one axis that a sample counts for: 2 reach + 1.
  std::size_t side() const { return squared_weights_.size(); }

  /// Profile of a sample at an offset from a pixel's centre along one axis, for the 2 reach + 1 nearest pixels:
  /// `values` are the profile at offset + reach, ..., offset - reach [1/pixel].
  void profile(double offset, std::vector<double>& values) const;

  /// Mean squared weight of the samples of a pixel's square for the pixel at distance (dx, dy). Both distances are at
  /// most `reach`.
  double squared_weight(int dx, int dy) const { return along_axis(dx) * along_axis(dy); }

  /// Noise area [pixels]: the inverse of the sum of all squared weights.
  double noise_area() const { return noise_area_; }

  /// Whether splats reduce noise. A filter as narrow as a pixel leaves nothing to share.
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

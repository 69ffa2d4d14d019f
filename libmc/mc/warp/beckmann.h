#pragma once
/// Normals of the Beckmann microsurface: all normals, and the normals visible from a direction.

#include <mc/core/dot.h>
#include <mc/core/erf.h>
#include <mc/core/error.h>
#include <mc/core/probit.h>
#include <mc/core/turns.h>
#include <mc/domain/hemisphere.h>
#include <mc/warp/concept.h>

#include <algorithm>
#include <limits>

namespace mc {

/// Normals of a surface with Gaussian slopes. The density is D(m) m_z.
///   sample : slope (alpha_x r cos phi, alpha_y r sin phi) with r^2 = -log(1 - u0), phi = 2 pi u1.
///   pdf    : exp(-r^2) / (pi alpha_x alpha_y m_z^3) [1/sr] with r^2 = ((m_x / alpha_x)^2 + (m_y / alpha_y)^2) / m_z^2;
///            0 below the horizon. Relative error (8 + 8 r^2) eps: the tail is ill-conditioned in m. 63 % of the
///            samples have r^2 < 1.
///   invert : |invert(sample(u)) - u| <= 16 eps.
///   throws : Error unless both roughnesses lie in [1e-6, 1e3].
///   Source : [WalterEtAl07]. All terms use the components of m, never 1 - z^2, so a float normal suffices at alpha =
///            1e-4.
template <Real S> class BeckmannNormals {
 public:
  using Scalar = S;
  using Domain = Hemisphere<S>;

  /// An isotropic surface of roughness alpha.
  explicit BeckmannNormals(S alpha) : BeckmannNormals(alpha, alpha) {}
  /// A surface of roughness ax along x and ay along y.
  BeckmannNormals(S ax, S ay) : alpha_x_(ax), alpha_y_(ay) {
    require(ax >= S(1e-6) && ax <= S(1e3) && ay >= S(1e-6) && ay <= S(1e3),
            "BeckmannNormals: alpha_x = {}, alpha_y = {}: both must lie in [1e-6, 1000]", static_cast<double>(ax),
            static_cast<double>(ay));
  }

  Domain domain() const { return {}; }
  Vec3<S> sample(const Vec2<S>& u) const {
    using std::log1p, std::sqrt;
    const Vec2<S> slope = polar_point<S>(sqrt(S(-S(log1p(S(-u[0]))))), u[1]);
    return Vec3<S>(alpha_x_ * slope.x(), alpha_y_ * slope.y(), S(1)).normalized();
  }
  S pdf(const Vec3<S>& m) const {
    using std::exp;
    if (!(m.z() > 0)) return S(0);
    const S tail = S(exp(S(-r2(m))));
    if (!(tail > 0)) return S(0); // m.z() may be so small that its powers are 0
    return tail / (pi<S> * (alpha_x_ * m.z()) * (alpha_y_ * m.z()) * m.z());
  }
  Vec2<S> invert(const Vec3<S>& m) const {
    using std::expm1;
    return {clamp_to_unit<S>(-S(expm1(S(-r2(m))))), azimuth_turns<S>(m.x() / alpha_x_, m.y() / alpha_y_)};
  }
  template <Real T> BeckmannNormals<T> cast() const { return {T(alpha_x_), T(alpha_y_)}; }

 private:
  S r2(const Vec3<S>& m) const { return sqr<S>(m.x() / m.z() / alpha_x_) + sqr<S>(m.y() / m.z() / alpha_y_); }
  S alpha_x_, alpha_y_;
};

/// Normals visible from wo, with density D(m) max(wo.m, 0) / sigma(wo) for Beckmann's D. sigma is the projected area of
/// the surface in the direction wo.
///   sample : slopes in the frame that is stretched by alpha and turned so that wo = (sin, 0, cos). The slope x toward
///            wo has the density (cos + x sin) exp(-x^2) / (sqrt(pi) c) for x > -cot, and the one across is normal. x
///            solves P(X > x) = u1 by Newton's method on the logarithm. The logarithm is concave, so the method
///            converges from any start. u = 0 is replaced by half a step of u, so slopes are finite.
///   pdf    : D(m) wo.m / sigma(wo) [1/sr]; 0 below the horizon. Relative error as for BeckmannNormals.
///   invert : |invert(sample(u)) - u| <= 8 eps.
///   throws : Error unless both roughnesses lie in [1e-6, 1e3] and wo is a unit vector with wo_z >= 0.
///   Source : the distribution of visible slopes from [Heitz14].
template <Real S> class BeckmannVisibleNormals {
 public:
  using Scalar = S;
  using Domain = Hemisphere<S>;

  /// Visible normals of an isotropic surface of roughness alpha.
  BeckmannVisibleNormals(const Vec3<S>& wo, S alpha) : BeckmannVisibleNormals(wo, alpha, alpha) {}
  /// Visible normals of a surface of roughness ax along x and ay along y.
  BeckmannVisibleNormals(const Vec3<S>& wo, S ax, S ay)
      : BeckmannVisibleNormals(BeckmannNormals<S>(ax, ay), wo, ax, ay) {
    require(wo.z() >= 0 && is_unit(wo), "BeckmannVisibleNormals: wo = ({}, {}, {}) must be a unit vector with z >= 0",
            static_cast<double>(wo.x()), static_cast<double>(wo.y()), static_cast<double>(wo.z()));
  }

  Domain domain() const { return {}; }

  Vec3<S> sample(const Vec2<S>& u) const {
    using std::max, std::sqrt;
    const S least = std::numeric_limits<S>::epsilon() / 4;
    const S x = slope_with_tail(max(u[1], least));
    const S y = probit(u[0]) / S(sqrt(S(2)));
    const Vec2<S> slope = x * toward_ + y * across_;
    return Vec3<S>(alpha_x_ * slope.x(), alpha_y_ * slope.y(), S(1)).normalized();
  }

  S pdf(const Vec3<S>& m) const {
    if (!(m.z() > 0)) return S(0);
    const S cosine = accurate_dot(wo_, m);
    return cosine > 0 ? S(cosine * (normals_.pdf(m) / m.z() / area_)) : S(0);
  }

  /// Density of wi = reflect(wo, m) [1/sr]: pdf(m) / (4 wo.m), with the cosine cancelled.
  S pdf_reflected(const Vec3<S>& m) const {
    return m.z() > 0 && wo_.dot(m) > 0 ? S(normals_.pdf(m) / m.z() / (4 * area_)) : S(0);
  }

  Vec2<S> invert(const Vec3<S>& m) const {
    const Vec2<S> slope(m.x() / m.z() / alpha_x_, m.y() / m.z() / alpha_y_);
    const S x = slope.dot(toward_), y = slope.dot(across_);
    return {clamp_to_unit<S>(S(erfc(S(-y))) / 2), clamp_to_unit<S>(tail(x) / visible_)};
  }

  /// Direction from which the normals are visible.
  const Vec3<S>& wo() const { return wo_; }
  /// Projected area of the surface in the direction wo, for a horizontal area of 1.
  S area() const { return area_; }

  template <Real T> BeckmannVisibleNormals<T> cast() const {
    return BeckmannVisibleNormals<T>(normals_.template cast<T>(), cast_point<T>(wo_), T(alpha_x_), T(alpha_y_));
  }

 private:
  template <Real T> friend class BeckmannVisibleNormals;

  /// Does not normalize wo: a float unit vector is not a unit vector to 50 digits, and the oracle needs the same wo.
  BeckmannVisibleNormals(const BeckmannNormals<S>& normals, const Vec3<S>& wo, S ax, S ay)
      : normals_(normals), wo_(wo), alpha_x_(ax), alpha_y_(ay) {
    using std::sqrt;
    const Vec2<S> flat(ax * wo.x(), ay * wo.y());
    const S side = flat.norm(), length = sqrt(S(flat.squaredNorm() + wo.z() * wo.z()));
    cos_ = wo.z() / length;
    sin_ = side / length;
    toward_ = side > 0 ? Vec2<S>(flat / side) : Vec2<S>(1, 0);
    across_ = Vec2<S>(-toward_.y(), toward_.x());
    visible_ = tail(S(-cot()));
    area_ = length * visible_;
  }

  // The least visible slope is -cot; infinite for the direction of the surface's normal.
  S cot() const { return sin_ > 0 ? S(cos_ / sin_) : std::numeric_limits<S>::infinity(); }

  // Integral of (cos + t sin) exp(-t^2) / sqrt(pi) over t > x.
  S tail(const S& x) const {
    using std::exp, std::sqrt;
    return (cos_ * S(erfc(x)) + sin_ * S(exp(S(-x * x))) / S(sqrt(pi<S>))) / 2;
  }

  // The slope beyond which the share `u` of the visible slopes lies.
  S slope_with_tail(const S& u) const {
    using std::abs, std::exp, std::log, std::sqrt;
    const S wanted = u * visible_, least = -cot(), eps = std::numeric_limits<S>::epsilon();
    const S grazing = sqrt(S(-log(u)));                    // the solution for cos = 0, an upper bound for the others
    const S normal = S(log(S((1 - u / 2) / u))) * S(0.42); // near the solution for sin = 0
    S x = grazing + cos_ * (normal - grazing);
    if (!(x > least)) x = (least + grazing) / 2;
    for (int step = 0; step < 200; ++step) { // the last steps may alternate by rounding
      const S above = tail(x), density = (cos_ + x * sin_) * S(exp(S(-x * x))) / S(sqrt(pi<S>));
      const S change = S(log(S(above / wanted))) * above / density;
      S next = x + change;
      if (!(next > least)) next = (least + x) / 2;
      const bool is_close = !(abs(S(next - x)) > 2 * eps * (1 + abs(next)));
      x = next;
      if (is_close) break;
    }
    return x;
  }

  BeckmannNormals<S> normals_;
  Vec3<S> wo_;
  S alpha_x_, alpha_y_;
  Vec2<S> toward_, across_;      ///< stretched wo in the plane, normalized; perpendicular to it
  S cos_, sin_, visible_, area_; ///< of the stretched wo; tail(-cot); visible_ times the length of the stretched wo
};

} // namespace mc

#pragma once
/// Normals of the Beckmann microsurface.

#include <mc/core/error.h>
#include <mc/core/turns.h>
#include <mc/domain/hemisphere.h>
#include <mc/warp/concept.h>

#include <algorithm>

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
    return S(exp(S(-r2(m)))) / (pi<S> * (alpha_x_ * m.z()) * (alpha_y_ * m.z()) * m.z());
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

} // namespace mc

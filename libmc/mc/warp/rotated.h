#pragma once
/// Distributions of directions about an arbitrary axis.

#include <mc/core/error.h>
#include <mc/domain/rotated.h>
#include <mc/warp/concept.h>

#include <utility>

namespace mc {

/// A distribution about +z, rotated to an axis n.
///   sample : a direction of the warp, transformed from the frame of n to the world.
///   pdf    : density of the warp at the direction in the frame [1/sr]. Rounding may move a direction on the rim of the
///            support out by up to 8 eps; it still counts as inside. A density that vanishes on the rim is
///            ill-conditioned there: the cosine density by eps / z.
///   invert : invert of the warp at the direction in the frame. Ill-conditioned where the warp is near its pole,
///            because the sum of the axes rounds to eps. For a uniform warp u0 is accurate to eps and u1 to eps /
///            sin(theta).
///   throws : Error unless |n| = 1 within 32 eps.
///   Source : the frame of [DuffEtAl17].
template <Warp W> struct Rotated {
  using Scalar = typename W::Scalar;
  using Domain = RotatedDomain<typename W::Domain>;

  W warp;              ///< Distribution about +z.
  Frame<Scalar> frame; ///< Orthonormal frame with z axis n.

  /// Rotates a warp about +z to the axis n.
  Rotated(W warp_, const Vec3<Scalar>& n) : warp(std::move(warp_)) {
    using std::abs;
    const Scalar square = n.squaredNorm();
    require(abs(Scalar(square - 1)) <= 64 * std::numeric_limits<Scalar>::epsilon(),
            "Rotated: the axis has length^2 {}; a unit vector is needed", static_cast<double>(square));
    frame = Frame<Scalar>::from_z(n.normalized());
  }

  Domain domain() const { return {warp.domain(), frame}; }
  Vec3<Scalar> sample(const typename Domain::UnitPoint& u) const { return domain().to_world(warp.sample(u)); }
  Scalar pdf(const Vec3<Scalar>& w) const { return warp.pdf(domain().to_local(w)); }
  typename Domain::UnitPoint invert(const Vec3<Scalar>& w) const requires InvertibleWarp<W> {
    return warp.invert(domain().to_local(w));
  }
  template <Real T> auto cast() const {
    // A new frame from the axis is orthonormal to the precision of T.
    return Rotated<decltype(warp.template cast<T>())>(warp.template cast<T>(), cast_point<T>(frame.z).normalized());
  }
};

} // namespace mc

#pragma once
/// Concept of a warp: a distribution with sample, pdf and invert. check/laws.h tests their consistency.

#include <mc/domain/concept.h>

namespace mc {

/// A distribution on a domain, sampled by a map from the unit cube of the same dimension.
///   domain()   : the set X with its chart.
///   sample(u)  : maps u in [0,1)^dim to a point of X.
///   pdf(x)     : density [1 / Domain::measure]; 0 outside the support. pdf(sample(u)) > 0.
///   cast<T>()  : the same distribution over the scalar T. With the 50-digit scalar it serves as its own oracle.
/// A warp is a plain struct without base class or registration. Its constructor throws Error for invalid parameters.
template <class W>
concept Warp = Domain<typename W::Domain> &&
    requires(const W w, typename W::Domain::Point x, typename W::Domain::UnitPoint u) {
  typename W::Scalar;
  { w.domain() } -> std::convertible_to<typename W::Domain>;
  { w.sample(u) } -> std::convertible_to<typename W::Domain::Point>;
  { w.pdf(x) } -> std::convertible_to<typename W::Scalar>;
  {w.template cast<double>()};
};

/// A bijective warp: invert(sample(u)) = u up to the bound in the contract of the warp. Hence |det d sample / d u| pdf
/// = 1.
/// invert(x) lies in [0,1)^dim for every x of the domain.
template <class W>
concept InvertibleWarp = Warp<W> && requires(const W w, typename W::Domain::Point x) {
  { w.invert(x) } -> std::convertible_to<typename W::Domain::UnitPoint>;
};

/// Point type of the domain of a warp.
template <class W> using PointOf = typename W::Domain::Point;
/// Type of the argument u of a warp: a scalar in one dimension, else a vector.
template <class W> using UnitPointOf = typename W::Domain::UnitPoint;

} // namespace mc

#pragma once
/// A warp: a distribution as one object, whose sample, pdf and invert obey the laws of check/laws.h.

#include <mc/domain/concept.h>

namespace mc {

/// A distribution on a domain, sampled by mapping the unit cube of the same dimension.
///   domain()   : the set X with its chart
///   sample(u)  : u in [0,1)^dim -> X
///   pdf(x)     : density [1 / Domain::measure]; 0 outside the support; pdf(sample(u)) > 0
///   cast<T>()  : the same distribution over another scalar; over the 50-digit scalar it is its own oracle
/// A warp is a plain struct: no base class, no registration. Its constructor refuses nonsense parameters.
template <class W>
concept Warp = Domain<typename W::Domain> &&
    requires(const W w, typename W::Domain::Point x, typename W::Domain::UnitPoint u) {
  typename W::Scalar;
  { w.domain() } -> std::convertible_to<typename W::Domain>;
  { w.sample(u) } -> std::convertible_to<typename W::Domain::Point>;
  { w.pdf(x) } -> std::convertible_to<typename W::Scalar>;
  {w.template cast<double>()};
};

/// A bijective warp: invert(sample(u)) = u up to the bound in the warp's contract, hence |det d sample / d u| pdf = 1,
/// and invert(x) lies in [0,1)^dim for every x of the domain.
template <class W>
concept InvertibleWarp = Warp<W> && requires(const W w, typename W::Domain::Point x) {
  { w.invert(x) } -> std::convertible_to<typename W::Domain::UnitPoint>;
};

/// Shorthands for the types of a warp.
template <class W> using PointOf = typename W::Domain::Point;
template <class W> using UnitPointOf = typename W::Domain::UnitPoint;

} // namespace mc

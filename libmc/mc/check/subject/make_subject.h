#pragma once
/// Subjects of warps, of discrete distributions and of functions.

#include <mc/check/subject/make_distribution.h>

namespace mc {

/// A sampler on a domain, its claimed density and perhaps the f it is for; see make_distribution.
template <Domain D, class Draw, class Pdf, class F = std::nullptr_t>
Subject make_subject(std::string name, const D& domain, Draw distribution, Pdf pdf, F f = nullptr) {
  return make_subject(
      make_distribution(std::move(name), domain, std::move(distribution), std::move(pdf), std::move(f)));
}

/// A warp, or any struct with domain, sample and pdf. Float points are mapped to the chart in double, so the bins lose
/// no precision. A warp whose density jumps names the places: breaks()[axis], ascending chart coordinates.
template <ContinuousDistribution W> Subject make_subject(std::string name, const W& warp) {
  return make_subject(make_distribution(std::move(name), warp));
}

/// A discrete distribution: its outcomes are atoms, its weight the ratio of stated and tabulated probability. An
/// u_remapped outside [0,1) counts as not finite.
template <DiscreteDistribution D> Subject make_discrete_subject(std::string name, const D& distribution) {
  return make_subject(make_discrete_distribution(std::move(name), distribution));
}

} // namespace mc

#pragma once
/// Subjects from warps, discrete distributions and functions.

#include <mc/check/subject/make_distribution.h>

namespace mc {

/// Returns the subject of a distribution on a domain, given by functions; see make_distribution.
template <Domain D, class Draw, class Pdf, class F = std::nullptr_t>
Subject make_subject(std::string name, const D& domain, Draw distribution, Pdf pdf, F f = nullptr) {
  return make_subject(
      make_distribution(std::move(name), domain, std::move(distribution), std::move(pdf), std::move(f)));
}

/// Returns the subject of a warp, or of any struct with domain, sample and pdf. Float points are mapped to the chart in
/// double, so that bins lose no precision.
template <ContinuousDistribution W> Subject make_subject(std::string name, const W& warp) {
  return make_subject(make_distribution(std::move(name), warp));
}

/// Returns the subject of a discrete distribution; see make_discrete_distribution.
template <DiscreteDistribution D> Subject make_discrete_subject(std::string name, const D& distribution) {
  return make_subject(make_discrete_distribution(std::move(name), distribution));
}

} // namespace mc

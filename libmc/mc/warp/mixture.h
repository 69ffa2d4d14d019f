#pragma once
/// Mixtures of distributions.

#include <mc/core/error.h>
#include <mc/warp/concept.h>

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>

namespace mc {

/// A weighted mixture of warps onto one domain. The first coordinate of u selects the component. It is then stretched
/// back to [0,1), which preserves stratification.
///   pdf    : sum of w_i pdf_i(x) over all components, not only the sampled one.
///   invert : none, because several u give the same x.
///   throws : Error unless the weights are finite, >= 0 and not all 0.
///   Source : one-sample combination, [Veach97] section 9.2.4.
/// The weights are normalized to sum 1. Weights below min / eps of the largest count as 0.
template <Warp First, Warp... Rest>
requires(std::same_as<typename First::Domain, typename Rest::Domain>&&...) class Mixture {
 public:
  using Scalar = typename First::Scalar;
  using Domain = typename First::Domain;
  /// Number of components.
  static constexpr std::size_t size = 1 + sizeof...(Rest);

  /// A mixture with one weight per component.
  Mixture(const std::array<Scalar, size>& weights, First first, Rest... rest)
      : weights_(weights), warps_(std::move(first), std::move(rest)...) {
    using std::isfinite;
    Scalar largest(0), sum(0);
    for (std::size_t i = 0; i < size; ++i) {
      require(isfinite(weights_[i]) && weights_[i] >= 0, "Mixture: weights[{}] = {} is not finite and >= 0", i,
              static_cast<double>(weights_[i]));
      largest = std::max(largest, weights_[i]);
    }
    require(largest > 0, "Mixture: all {} weights are 0; at least one must be > 0", size);
    // Divides by the largest weight first: a sum of weights near the largest number would overflow.
    using Limits = std::numeric_limits<Scalar>;
    for (Scalar& w : weights_) {
      w /= largest;
      if (w < Limits::min() / Limits::epsilon()) w = Scalar(0);
      sum += w;
    }
    for (Scalar& w : weights_) w /= sum;
  }

  Domain domain() const { return std::get<0>(warps_).domain(); }

  typename Domain::Point sample(typename Domain::UnitPoint u) const {
    Scalar& uc = first_of(u);
    // Rounding may leave u above the sum of the weights: the last component of positive weight takes the rest.
    std::size_t last = size - 1;
    while (weights_[last] == 0) --last;
    std::size_t i = 0;
    Scalar below(0);
    while (i < last && !(uc < below + weights_[i])) below += weights_[i++];
    while (weights_[i] == 0) ++i;
    uc = clamp_to_unit<Scalar>((uc - below) / weights_[i]);
    return sample_component(i, u, std::make_index_sequence<size>());
  }

  Scalar pdf(const typename Domain::Point& x) const { return pdf_sum(x, std::make_index_sequence<size>()); }

  template <Real T> auto cast() const { return cast_all<T>(std::make_index_sequence<size>()); }

 private:
  static Scalar& first_of(typename Domain::UnitPoint& u) {
    if constexpr (Domain::dim == 1) return u;
    else return u[0];
  }
  template <std::size_t... I>
  typename Domain::Point sample_component(std::size_t i, const typename Domain::UnitPoint& u,
                                          std::index_sequence<I...>) const {
    typename Domain::Point x{};
    ((I == i ? void(x = std::get<I>(warps_).sample(u)) : void()), ...);
    return x;
  }
  template <std::size_t... I> Scalar pdf_sum(const typename Domain::Point& x, std::index_sequence<I...>) const {
    Scalar sum(0);
    ((weights_[I] > 0 ? void(sum += weights_[I] * std::get<I>(warps_).pdf(x)) : void()), ...);
    return sum;
  }
  template <Real T, std::size_t... I> auto cast_all(std::index_sequence<I...>) const {
    return mc::Mixture(std::array<T, size>{T(weights_[I])...}, std::get<I>(warps_).template cast<T>()...);
  }

  std::array<Scalar, size> weights_;
  std::tuple<First, Rest...> warps_;
};

/// Deduces the types of the components.
template <class S, std::size_t N, class... Warps> Mixture(const std::array<S, N>&, Warps...) -> Mixture<Warps...>;

} // namespace mc

#pragma once
/// Multiple importance sampling: weights for n techniques, and estimators that use them.

#include <mc/core/error.h>
#include <mc/core/types.h>
#include <mc/warp/concept.h>

#include <algorithm>
#include <array>
#include <span>
#include <tuple>
#include <utility>

namespace mc {

/// Heuristic for the weights of techniques that could have drawn a sample. q_j = n_j p_j is number of samples times
/// density.
///   balance()     : w_i = q_i / sum_j q_j. No other heuristic has a much lower variance.
///   power(beta)   : w_i = q_i^beta / sum_j q_j^beta. The usual beta is 2.
///   cutoff(alpha) : Balance among the techniques with q_j >= alpha max q. The others get 0.
///   maximum()     : The technique with the largest q gets all weight. Equal ones share it.
///   throws : Error unless beta > 0 and 0 <= alpha <= 1.
///   Source : [Veach97] section 9.2.3.
template <Real S> struct Heuristic {
  S beta = 1,    ///< Exponent.
      alpha = 0; ///< Cutoff relative to the largest q.

  /// The balance heuristic.
  static Heuristic balance() { return {}; }
  /// The power heuristic.
  static Heuristic power(S beta) {
    require(beta > 0, "Heuristic: power {} must be > 0", static_cast<double>(beta));
    return {beta, 0};
  }
  /// The cutoff heuristic.
  static Heuristic cutoff(S alpha) {
    require(alpha >= 0 && alpha <= 1, "Heuristic: cutoff {} must lie in [0, 1]", static_cast<double>(alpha));
    return {1, alpha};
  }
  /// The maximum heuristic.
  static Heuristic maximum() { return {1, 1}; }

  /// Unnormalised weight of a technique with q equal to x times the largest q.
  S share(const S& x) const {
    using std::pow;
    if (!(x >= alpha)) return S(0);
    if (beta == 1) return x;
    if (beta == 2) return S(x * x);
    return S(pow(x, beta));
  }
};

/// Weight of technique i, from the density p_j >= 0 and the number of samples n_j >= 0 of each technique. All densities
/// must refer to the same measure. For one sample from a randomly selected technique, n_j is the selection probability.
///   error : The weights sum to 1 within (n + 2) eps over the whole range of the scalar. Densities are first divided by
///           the largest density, so 1e-30 and 1e30 neither underflow nor overflow.
///   delta : Techniques with infinite density share all weight by their counts. If all densities are 0, all weights are
///           0.
template <Real S>
S mis_weight(std::size_t i, std::span<const S> densities, std::span<const S> counts,
             const Heuristic<S>& heuristic = {}) {
  using std::isinf;
  MC_ASSERT(densities.size() == counts.size() && i < densities.size());
  S largest(0);
  for (std::size_t j = 0; j < densities.size(); ++j) {
    MC_ASSERT(densities[j] >= 0 && counts[j] >= 0);
    if (counts[j] > 0) largest = std::max(largest, densities[j]);
  }
  if (!(largest > 0) || !(counts[i] > 0)) return S(0);
  const bool delta = isinf(largest);
  // The counts are small numbers, so their products with normalised densities stay in range.
  const auto q = [&](std::size_t j) -> S {
    if (!(counts[j] > 0)) return S(0);
    if (delta) return isinf(densities[j]) ? counts[j] : S(0);
    return counts[j] * (densities[j] / largest);
  };
  S scale(0), sum(0);
  for (std::size_t j = 0; j < densities.size(); ++j) scale = std::max(scale, q(j));
  for (std::size_t j = 0; j < densities.size(); ++j) sum += heuristic.share(q(j) / scale);
  return heuristic.share(q(i) / scale) / sum;
}

/// Balance weight of a technique with n_f samples of density f against one with n_g samples of density g: n_f f / (n_f
/// f + n_g g).
///   error : As for mis_weight(), but computed from the ratio, without loops or products that overflow.
template <Real S> S balance_heuristic(S n_f, S f, S n_g, S g) {
  const S ratio = (n_g / n_f) * (g / f);
  if (ratio >= 0) [[likely]]
    return 1 / (1 + ratio);
  const S densities[] = {f, g}, counts[] = {n_f, n_g}; // two zeros or two infinities
  return mis_weight<S>(0, densities, counts, Heuristic<S>::balance());
}

/// Power weight with exponent 2: squared densities in the balance weight. Gives less noise if one technique is much
/// better than the other.
template <Real S> S power_heuristic(S n_f, S f, S n_g, S g) {
  const S ratio = (n_g / n_f) * (g / f);
  if (ratio >= 0) [[likely]]
    return 1 / (1 + ratio * ratio);
  const S densities[] = {f, g}, counts[] = {n_f, n_g};
  return mis_weight<S>(0, densities, counts, Heuristic<S>{2, 0});
}

/// Balance weight for one sample of each technique.
template <Real S> S balance_heuristic(S f, S g) { return balance_heuristic(S(1), f, S(1), g); }
/// Power weight for one sample of each technique.
template <Real S> S power_heuristic(S f, S g) { return power_heuristic(S(1), f, S(1), g); }

/// Estimators of the integral of f over the common domain of several warps.
///   counts : Number of samples of each technique. f must be 0 where all techniques with a positive count have density
///            0.
///   error  : Unbiased for every heuristic, unless it cuts off a technique everywhere where only that technique samples
///            f.
///   throws : Error unless the counts are finite, >= 0 and not all 0.
///   Source : [Veach97] sections 9.2.1 (several samples) and 9.2.4 (one sample).
template <Warp First, Warp... Rest>
requires(std::same_as<typename First::Domain, typename Rest::Domain>&&...) class MultipleImportance {
 public:
  /// Scalar of the warps.
  using S = typename First::Scalar;
  /// Number of techniques.
  static constexpr std::size_t size = 1 + sizeof...(Rest);
  /// One number for each technique.
  using Values = std::array<S, size>;

  /// Estimators with these counts, heuristic and warps.
  MultipleImportance(const Values& counts, const Heuristic<S>& heuristic, First first, Rest... rest)
      : counts_(counts), heuristic_(heuristic), warps_(std::move(first), std::move(rest)...) {
    using std::isfinite;
    for (std::size_t i = 0; i < size; ++i) {
      require(isfinite(counts[i]) && counts[i] >= 0, "MultipleImportance: counts[{}] = {} is not finite and >= 0", i,
              static_cast<double>(counts[i]));
      total_ += counts[i];
    }
    require(total_ > 0, "MultipleImportance: all {} counts are 0; at least one must be > 0", size);
    require(isfinite(total_), "MultipleImportance: the sum of the counts is infinite; divide them by a common factor");
  }

  /// Density of each technique at x.
  Values densities(const PointOf<First>& x) const {
    return std::apply([&](const auto&... warp) { return Values{warp.pdf(x)...}; }, warps_);
  }

  /// Sum over techniques of the mean of w f / p over counts[i] samples, with counts rounded up. next() returns a point
  /// of the unit cube.
  template <class F, class Next> double multi_sample(F&& f, Next&& next) const {
    Values counts = counts_;
    for (S& n : counts) n = S(std::ceil(static_cast<double>(n)));
    double sum = 0;
    for (std::size_t i = 0; i < size; ++i)
      for (auto k = static_cast<std::uint64_t>(counts[i]); k > 0; --k) sum += contribution(f, i, next(), counts);
    return sum;
  }

  /// Estimate w f / (probability p) from one sample of technique i. uc in [0,1) selects i with probability counts[i] /
  /// sum of counts.
  template <class F> double one_sample(F&& f, const S& uc, const UnitPointOf<First>& u) const {
    Values chances = counts_;
    for (S& n : chances) n /= total_;
    std::size_t last = size - 1, i = 0;
    while (!(chances[last] > 0)) --last;
    for (S below(0); i < last && !(uc < (below += chances[i]));) ++i;
    return contribution(f, i, u, chances);
  }

 private:
  template <class F>
  double contribution(F&& f, std::size_t i, const UnitPointOf<First>& u, const Values& counts) const {
    const PointOf<First> x = sample(i, u, std::make_index_sequence<size>());
    const double value = static_cast<double>(f(x));
    if (value == 0) return 0;
    const Values p = densities(x);
    // w / (n p) in double: a float density of 1e-38 has no float inverse.
    const double w = static_cast<double>(mis_weight<S>(i, p, counts, heuristic_));
    return w * value / (static_cast<double>(counts[i]) * static_cast<double>(p[i]));
  }
  template <std::size_t... I>
  PointOf<First> sample(std::size_t i, const UnitPointOf<First>& u, std::index_sequence<I...>) const {
    PointOf<First> x{};
    ((I == i ? void(x = std::get<I>(warps_).sample(u)) : void()), ...);
    return x;
  }

  Values counts_;
  Heuristic<S> heuristic_;
  std::tuple<First, Rest...> warps_;
  S total_ = 0;
};

/// Deduces the warps.
template <class S, std::size_t N, class... Warps>
MultipleImportance(const std::array<S, N>&, const Heuristic<S>&, Warps...) -> MultipleImportance<Warps...>;

} // namespace mc

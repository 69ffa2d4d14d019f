#pragma once
/// Multiple importance sampling: weights of n techniques, and the estimators that use them.

#include <mc/core/error.h>
#include <mc/core/types.h>
#include <mc/warp/concept.h>

#include <algorithm>
#include <array>
#include <span>
#include <tuple>
#include <utility>

namespace mc {

/// How a sample's weight is shared among the techniques that could have drawn it, by q_j = n_j p_j: number of samples
/// times density.
///   balance()      : w_i = q_i / sum_j q_j; no other has a variance much below its
///   power(beta)    : w_i = q_i^beta / sum_j q_j^beta; beta = 2 is usual
///   cutoff(alpha)  : balance among the techniques with q_j >= alpha max q, the others get 0
///   maximum()      : all to the largest q, shared where several are equal
///   throws : Error unless beta > 0 and 0 <= alpha <= 1
///   Source : [Veach97] section 9.2.3
template <Real S> struct Heuristic {
  S beta = 1, alpha = 0;

  static Heuristic balance() { return {}; }
  static Heuristic power(S beta) {
    require(beta > 0, "Heuristic: power {} must be > 0", static_cast<double>(beta));
    return {beta, 0};
  }
  static Heuristic cutoff(S alpha) {
    require(alpha >= 0 && alpha <= 1, "Heuristic: cutoff {} must lie in [0, 1]", static_cast<double>(alpha));
    return {1, alpha};
  }
  static Heuristic maximum() { return {1, 1}; }

  /// Share of a technique whose q is x times the largest, before normalisation.
  S share(const S& x) const {
    using std::pow;
    if (!(x >= alpha)) return S(0);
    if (beta == 1) return x;
    if (beta == 2) return S(x * x);
    return S(pow(x, beta));
  }
};

/// Weight of technique i, given the density p_j >= 0 [any common measure] and the number of samples n_j >= 0 of each.
/// For one sample from a technique chosen at random, n_j is the probability of the choice.
///   error : the weights sum to 1 within (n + 2) eps over the whole range of the scalar: densities are divided by the
///           largest before anything else, so 1e-30 and 1e30 neither vanish nor overflow. An infinite density (a delta
///           technique) takes all the weight, shared by counts among the infinite ones; all densities 0: all weights 0
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
  // The counts are small numbers: after division by the largest density their products stay in range.
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

/// Weight of the technique with n_f samples of density f against one with n_g of density g: n_f f / (n_f f + n_g g).
///   error : as mis_weight, by the ratio alone: no loop, and no product to overflow
template <Real S> S balance_heuristic(S n_f, S f, S n_g, S g) {
  const S ratio = (n_g / n_f) * (g / f);
  if (ratio >= 0) [[likely]]
    return 1 / (1 + ratio);
  const S densities[] = {f, g}, counts[] = {n_f, n_g}; // two zeros or two infinities met
  return mis_weight<S>(0, densities, counts, Heuristic<S>::balance());
}

/// The same with squared densities: keeps the noise of a technique low where it is much the better one.
template <Real S> S power_heuristic(S n_f, S f, S n_g, S g) {
  const S ratio = (n_g / n_f) * (g / f);
  if (ratio >= 0) [[likely]]
    return 1 / (1 + ratio * ratio);
  const S densities[] = {f, g}, counts[] = {n_f, n_g};
  return mis_weight<S>(0, densities, counts, Heuristic<S>{2, 0});
}

/// The same for one sample of each.
template <Real S> S balance_heuristic(S f, S g) { return balance_heuristic(S(1), f, S(1), g); }
template <Real S> S power_heuristic(S f, S g) { return power_heuristic(S(1), f, S(1), g); }

/// Estimators of the integral of f over the domain of several warps.
///   counts : samples of each technique; f must be 0 wherever all techniques with a positive count have density 0
///   error  : unbiased for every heuristic, provided no technique of positive count is cut off everywhere where it
///            alone samples f
///   throws : Error unless the counts are finite, >= 0 and not all 0
///   Source : [Veach97] sections 9.2.1 (several samples) and 9.2.4 (one sample)
template <Warp First, Warp... Rest>
requires(std::same_as<typename First::Domain, typename Rest::Domain>&&...) class MultipleImportance {
 public:
  using S = typename First::Scalar;
  static constexpr std::size_t size = 1 + sizeof...(Rest);
  using Values = std::array<S, size>;

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

  Values densities(const PointOf<First>& x) const {
    return std::apply([&](const auto&... warp) { return Values{warp.pdf(x)...}; }, warps_);
  }

  /// The sum over techniques of the mean of w f / p over counts[i] samples, rounded up; next() gives the points of the
  /// unit cube.
  template <class F, class Next> double multi_sample(F&& f, Next&& next) const {
    Values counts = counts_;
    for (S& n : counts) n = S(std::ceil(static_cast<double>(n)));
    double sum = 0;
    // A float that counts stops at 2^24.
    for (std::size_t i = 0; i < size; ++i)
      for (double k = 0; k < static_cast<double>(counts[i]); ++k) sum += contribution(f, i, next(), counts);
    return sum;
  }

  /// One sample from technique i with probability counts[i] / sum of counts, chosen by uc in [0,1): w f / (probability
  /// p).
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

template <class S, std::size_t N, class... Warps>
MultipleImportance(const std::array<S, N>&, const Heuristic<S>&, Warps...) -> MultipleImportance<Warps...>;

} // namespace mc

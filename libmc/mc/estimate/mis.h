#pragma once
/// Multiple importance sampling weights.

#include <mc/core/error.h>
#include <mc/core/types.h>

#include <algorithm>
#include <span>

namespace mc {

/// Weights of the power heuristic: w_i = (n_i p_i)^beta / sum_j (n_j p_j)^beta, for the density p_i [any common measure] and
/// number of samples n_i of each technique.
///   beta  : 1 is the balance heuristic, 2 the usual power heuristic, infinity the maximum heuristic
///   error : the weights sum to 1 within (n + 2) eps over the whole range of the scalar: densities are divided by the largest
///           before they are raised, so 1e-30 and 1e30 neither vanish nor overflow. An infinite density (a delta technique)
///           takes all the weight, shared among the infinite ones; all densities 0: all weights 0
///   Source: [Veach97] section 9.2
template <Real S> S mis_weight(std::size_t i, std::span<const S> densities, std::span<const S> counts, S beta) {
  using std::isinf, std::pow;
  MC_ASSERT(densities.size() == counts.size() && i < densities.size());
  S largest(0);
  for (std::size_t j = 0; j < densities.size(); ++j)
    if (counts[j] > 0) largest = std::max(largest, densities[j]);
  if (!(largest > 0) || !(counts[i] > 0)) return S(0);
  const bool delta = isinf(largest);
  // The counts are small numbers: after division by the largest density their products stay in range.
  S scale(0);
  const auto share = [&](std::size_t j) -> S {
    if (!(counts[j] > 0)) return S(0);
    if (delta) return isinf(densities[j]) ? counts[j] : S(0);
    return counts[j] * (densities[j] / largest);
  };
  for (std::size_t j = 0; j < densities.size(); ++j) scale = std::max(scale, share(j));
  const auto term = [&](std::size_t j) -> S {
    const S x = share(j) / scale; // in [0, 1]
    if (isinf(beta)) return x == 1 ? S(1) : S(0);
    return beta == 1 ? x : beta == 2 ? S(x * x) : S(pow(x, beta));
  };
  S sum(0);
  for (std::size_t j = 0; j < densities.size(); ++j) sum += term(j);
  return term(i) / sum;
}

/// Weight of the technique with n_f samples of density f against one with n_g of density g: n_f f / (n_f f + n_g g).
template <Real S> S balance_heuristic(S n_f, S f, S n_g, S g) {
  const S densities[] = {f, g}, counts[] = {n_f, n_g};
  return mis_weight<S>(0, densities, counts, S(1));
}

/// The same with squared densities: keeps the noise of a technique low where it is much the better one.
template <Real S> S power_heuristic(S n_f, S f, S n_g, S g) {
  const S densities[] = {f, g}, counts[] = {n_f, n_g};
  return mis_weight<S>(0, densities, counts, S(2));
}

} // namespace mc

#include <mc/core/error.h>
#include <mc/core/sum.h>
#include <mc/table/cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mc {

Cdf::Cdf(std::span<const double> weights)
    : cumulative_(CdfView::ends(weights.size())), guide_(CdfView::cells(weights.size()) + 1) {
  fill(weights, cumulative_.data(), guide_.data());
}

void Cdf::fill(std::span<const double> weights, double* cumulative, std::uint32_t* guide) {
  const std::size_t n = weights.size();
  require(n > 0, "table: no weights; at least one is needed");
  require(n < std::numeric_limits<std::uint32_t>::max(), "table: {} weights; at most 2^32 - 2 are supported", n);
  double largest = 0;
  std::size_t last = 0;
  for (std::size_t i = 0; i < n; ++i) {
    require(std::isfinite(weights[i]) && weights[i] >= 0, "table: weights[{}] = {} is not finite and >= 0", i,
            weights[i]);
    largest = std::max(largest, weights[i]);
    if (weights[i] > 0) last = i;
  }
  require(largest > 0, "table: all {} weights are 0; at least one must be > 0", n);

  // Scales by a power of two near the largest weight: 1e300 does not overflow, and denormals keep their bits.
  int exponent;
  std::frexp(largest, &exponent);
  CompensatedSum total;
  for (const double w : weights) total.add(std::ldexp(w, -exponent));
  const double scale = total.value();

  // Ends are multiples of the spacing of uniform<double>, so exactly the share pmf(i) of its numbers falls on outcome
  // i.
  constexpr double unit = 0x1p-53;
  CompensatedSum running;
  cumulative[0] = 0;
  for (std::size_t i = 0; i < n; ++i) {
    running.add(std::ldexp(weights[i], -exponent));
    double next = i < last ? std::min(std::nearbyint(running.value() / scale * 0x1p53) * unit, 1.0) : 1.0;
    // A weight that vanishes in the sum still gets the smallest interval.
    if (weights[i] > 0) next = std::max(next, cumulative[i] + unit);
    else next = cumulative[i];
    cumulative[i + 1] = next;
  }
  // Moves ends beyond 1 back, from the last one down; each positive weight keeps an interval.
  double limit = 1;
  for (std::size_t i = n; i > 0 && (cumulative[i] > limit || i > last); --i) {
    cumulative[i] = limit;
    if (weights[i - 1] > 0) limit -= unit;
  }

  for (std::size_t i = n + 1; i < CdfView::ends(n); ++i) cumulative[i] = 2;

  std::size_t outcome = 0;
  const std::uint32_t cells = CdfView::cells(n);
  for (std::uint32_t k = 0; k <= cells; ++k) {
    // The least u for which the rounded product of u and the number of cells lies in cell k.
    const double m = cells, start = k;
    double u = start / m;
    while (u * m < start) u = std::nextafter(u, 2.0);
    while (u > 0 && std::nextafter(u, 0.0) * m >= start) u = std::nextafter(u, 0.0);
    while (outcome < last && !(cumulative[outcome + 1] > u)) ++outcome;
    guide[k] = static_cast<std::uint32_t>(outcome);
  }
}

} // namespace mc

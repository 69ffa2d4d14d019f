#include <mc/core/types.h>
#include <mc/estimate/integrate/mean.h>
#include <mc/estimate/moments.h>
#include <mc/stats/t_test.h>

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mc::detail {

namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();
// minimum error of a mean: a tiny mean may be rounded to 0
constexpr double least = std::numeric_limits<double>::denorm_min();
constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
// factors of one step of one replicate that give the standard error
constexpr double jump_share = 0.75, constant_share = 1.5;
constexpr double light_tail_index = 8;        // a tail of this index does not affect the error
constexpr double large_skewness = 1;          // only some replicates contain large values
constexpr std::size_t remembered_lengths = 4; // number of lengths over which every jump counts

// Jump that separates replicates: the widest gap between neighbours, if it is wider than gaps of a smooth distribution
// or if all replicates are in two narrow clusters.
struct Gap {
  double width = 0;
  bool narrow = false, balanced = false; // narrow: both clusters are; balanced: both have at least three replicates
};
Gap widest_gap(std::vector<double> sorted, double deviation) {
  std::sort(sorted.begin(), sorted.end());
  Gap gap;
  std::size_t at = 0;
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i] - sorted[i - 1] > gap.width) gap.width = sorted[at = i] - sorted[i - 1];
  gap.narrow = sorted.back() - sorted.front() - gap.width < gap.width / 4;
  gap.balanced = at >= 3 && at + 3 <= sorted.size();
  return gap.width > 1.8 * deviation || gap.narrow ? gap : Gap();
}

// Largest jump that certainly belongs to the integrand. Two lengths showed it within a factor 1.5, because gaps between
// replicates of a smooth integrand decrease with the error. Or one length showed it with two narrow clusters.
double established_jump(const std::vector<ReplicateHistory::Jump>& jumps) {
  double highest = 0;
  for (const auto& one : jumps)
    for (const auto& other : jumps) {
      const bool twice = &one != &other && other.height >= one.height && other.height <= 1.5 * one.height;
      if (one.balanced && other.balanced && (twice || one.narrow)) highest = std::max(highest, one.height);
    }
  return highest;
}

// Largest jump that replicates no longer show because all of them have equally many points beyond it. Their deviation
// was in proportion to 1 / points for three lengths, as across a jump, and then dropped suddenly by far more. With two
// values before, the deviation was at most half of their difference.
double hidden_jump(const std::vector<double>& scaled_deviations) {
  constexpr double flat = 1.6, at_once = 12;
  double highest = 0;
  for (std::size_t i = 3; i < scaled_deviations.size(); ++i) {
    const auto before = std::span(scaled_deviations).subspan(i - 3, 3);
    const auto [low, high] = std::minmax_element(before.begin(), before.end());
    if (*high <= flat * *low && before[2] > at_once * scaled_deviations[i]) highest = std::max(highest, 2 * before[2]);
  }
  return highest;
}

bool tail_bound_is_large(const Mean& m) { return std::abs(m.unsampled_tail_bound) > std::abs(m.value) / 16; }
double total_error(const Mean& m) {
  return tail_bound_is_large(m) ? std::hypot(m.error, m.unsampled_tail_bound) : m.error;
}
} // namespace

double ulp(double mean) { return std::numeric_limits<double>::epsilon() * std::abs(mean); }

Estimate estimate(const Mean& m, std::uint64_t calls) {
  return Estimate::from_student_t(m.value, m.reported_error_bar() == ErrorBar::known ? total_error(m) : infinity, m.dof,
                                  calls);
}

Estimate::Interval interval(const Mean& m, double confidence) {
  if (m.reported_error_bar() != ErrorBar::known) return {-infinity, infinity};
  const Estimate::Interval plain = estimate(m, 0).interval(confidence);
  if (!(m.error > 0)) return plain;
  const double t = (plain.hi - plain.lo) / (2 * total_error(m)), shift = m.skew * m.error * (1 + 2 * t * t),
               unsampled_tail_bound = tail_bound_is_large(m) ? 0 : m.unsampled_tail_bound;
  return {plain.lo + std::min(shift, 0.0) + std::min(unsampled_tail_bound, 0.0),
          plain.hi + std::max(shift, 0.0) + std::max(unsampled_tail_bound, 0.0)};
}

double welch_dof(const Mean& a, const Mean& b) {
  const double largest = std::max(a.error, b.error); // squares of shares neither underflow nor overflow
  return largest > 0 ? mc::welch_dof(sqr(a.error / largest), a.dof, sqr(b.error / largest), b.dof) : a.dof + b.dof;
}

Mean combine_independent(const Mean& a, const Mean& b, double share) {
  const Mean mine{a.value, (1 - share) * a.error, a.dof, a.skew}, other{b.value, share * b.error, b.dof, b.skew};
  const double error = std::hypot(mine.error, other.error);
  const auto third = [&](const Mean& m) { return error > 0 ? m.skew * std::pow(m.error / error, 3) : 0.0; };
  return {a.value + share * (b.value - a.value),
          error,
          welch_dof(mine, other),
          third(mine) + third(other),
          b.error_bar,
          b.unsampled_tail_bound,
          a.zero_spread && b.zero_spread};
}

std::optional<double> z_score(const Mean& a, const Mean& b) {
  const double error = std::hypot(a.error, b.error);
  if (!(error > 0) || a.error_bar != ErrorBar::known || b.error_bar != ErrorBar::known) return {};
  const double t =
      std::abs(a.value - b.value) / std::hypot(error, rounding * std::max(std::abs(a.value), std::abs(b.value)));
  const double tail = cdf(complement(boost::math::students_t(welch_dof(a, b)), t));
  return quantile(complement(boost::math::normal(), std::max(tail, 1e-300)));
}

double unsampled_tail_bound(const IntegrandDiagnostics& diagnostics, double error) {
  const OctaveHistogram& all = diagnostics.values;
  const double largest = std::max(std::abs(all.lo()), std::abs(all.hi())) / static_cast<double>(all.count());
  if (diagnostics.tail.empty() || std::isfinite(diagnostics.tail_index()) || error < largest / 2) return 0;
  const double more = all.extrapolated_tail_mean();
  return std::copysign(more > all.mean_magnitude() / 2 ? infinity : more, all.hi() + all.lo());
}

ErrorBar error_bar_of(const IntegrandDiagnostics& diagnostics) {
  if (diagnostics.infinite_variance()) return ErrorBar::infinite_variance;
  return diagnostics.values.undersampled() ? ErrorBar::undersampled : ErrorBar::known;
}

double skewness(std::span<const double> numbers) {
  Moments m;
  double largest = 0, third = 0;
  for (const double x : numbers) largest = std::max(largest, std::abs(x));
  if (!(largest > 0)) return 0;
  for (const double x : numbers) m.add(x / largest);
  if (m.variance() < sqr(rounding)) return 0;
  for (const double x : numbers) third += std::pow(x / largest - m.mean(), 3);
  return third / static_cast<double>(numbers.size()) / std::pow(m.variance(), 1.5);
}

double skew_of_mean(double skewness, double count) {
  const double unbiased = count * count / ((count - 1) * std::max(count - 2, 1.0));
  return skewness * unbiased / (6 * std::sqrt(count));
}

Mean mean_of_replicates(std::span<const double> means, double points, const IntegrandDiagnostics& diagnostics,
                        ReplicateHistory& history) {
  const double r = static_cast<double>(means.size());
  double largest = 0;
  for (const double x : means) largest = std::max(largest, std::abs(x));
  const int exponent = largest > 0 ? std::ilogb(largest) : 0;
  std::vector<double> scaled; // scaled so that no square overflows or underflows
  Moments m;
  for (const double x : means) {
    scaled.push_back(std::ldexp(x, -exponent));
    m.add(scaled.back());
  }
  const double deviation = std::sqrt(m.variance()), now = std::ldexp(deviation, exponent);
  const double rounded = std::max(largest, diagnostics.values.mean_magnitude()); // larger if values cancel
  const bool differ = now > rounding * rounded;

  const Gap gap = differ ? widest_gap(scaled, deviation) : Gap();
  history.jumps.push_back({std::ldexp(gap.width, exponent) * points, gap.narrow, gap.balanced});
  history.scaled_deviations.push_back(now * points);
  double jump = std::max({history.axis_jump, hidden_jump(history.scaled_deviations), established_jump(history.jumps)});
  for (std::size_t i = history.jumps.size(); i > 0 && i + remembered_lengths > history.jumps.size(); --i)
    jump = std::max(jump, history.jumps[i - 1].height);
  double step = jump_share * jump;
  if (differ) history.last_nonzero_deviation = now;
  if (history.last_nonzero_deviation == 0) {
    const OctaveHistogram& all = diagnostics.values;
    const double range = all.hi() - all.lo(), size = std::max(std::abs(all.hi()), std::abs(all.lo()));
    if (size == 0) return {0, 0, r - 1, 0, ErrorBar::all_zero};
    step = std::max(step, range > 1e-9 * size ? jump_share * range : constant_share * size);
  }
  // Under a learned density the bulk of the values hides the tail of the integrand, which only few replicates sample.
  const double index = std::min(diagnostics.tail_index(), diagnostics.values.tail_index());
  const double shown = differ ? now : std::max(now, history.last_nonzero_deviation);
  const double skewness = differ ? detail::skewness(scaled) : 0.0;
  double width = shown;
  if ((index < light_tail_index || std::abs(skewness) > large_skewness) && history.last_points > 0) {
    const double decay = 1 - 1 / std::clamp(index, 2.0, light_tail_index);
    width = std::max(width, history.last_deviation * std::pow(history.last_points / points, decay));
  }
  history.last_points = points;
  history.last_deviation = shown;
  const double unsampled_variance_share = index < 20 ? std::pow(r, 2 / index - 1) : 0;
  const double spread = width / std::sqrt(r * (1 - std::min(unsampled_variance_share, 0.9)));
  const double mean = std::ldexp(m.mean(), exponent);
  return {mean,
          std::max({std::hypot(spread, step / points / r), ulp(rounded), least}),
          r - 1,
          skew_of_mean(skewness, r),
          error_bar_of(diagnostics),
          0,
          history.last_nonzero_deviation == 0 || diagnostics.constant()};
}

} // namespace mc::detail

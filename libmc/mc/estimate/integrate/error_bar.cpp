#include <mc/core/types.h>
#include <mc/estimate/integrate/corrections/pooled_variance.h>
#include <mc/estimate/integrate/corrections/skewness.h>
#include <mc/estimate/integrate/corrections/tail_extension.h>
#include <mc/estimate/integrate/error_bar.h>
#include <mc/estimate/moments.h>
#include <mc/stats/scale.h>
#include <mc/stats/t_test.h>

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mc::detail {

namespace {
constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
constexpr double least_error = std::numeric_limits<double>::denorm_min(); // a mean that underflows need not be 0

Estimate::Interval interval_at(const Mean& m, double confidence) {
  const double alpha = 0.5 * (1 - confidence), tail = tail_extension(alpha);
  const double t = m.dof > 0 ? student_quantile(2 * alpha, m.dof) : quantile(complement(boost::math::normal(), alpha));
  const double shift = skewness_shift(m.skew, m.error, t);
  return {m.value - t * m.error + std::min(shift, 0.0) - tail * m.tail[0],
          m.value + t * m.error + std::max(shift, 0.0) + tail * m.tail[1]};
}

double size_of(const Extremes& e) { return std::max(std::abs(e.lo()), std::abs(e.hi())); }
} // namespace

bool is_constant(const Extremes& extremes) {
  return extremes.hi() - extremes.lo() <= 4 * std::numeric_limits<double>::epsilon() * size_of(extremes);
}

TailFindings tails_of(const SampledValues& values, double cap, const Tuning& t) {
  const double count = static_cast<double>(values.averaged.count());
  TailFindings findings;
  for (std::size_t side = 0; side < 2; ++side) {
    const auto end = static_cast<TailSide>(side);
    const auto contribution = [&](const Tail& tail, double weight) {
      return weight * tail_contribution(tail, count, cap / weight, t);
    };
    const Tail tail = find_tail(values.averaged, end, t.tail);
    findings.contribution[side] = contribution(tail, 1);
    findings.shape[side] = tail.shape;
    if (values.integrand.count() == 0) continue;
    // Weights may hide the tail of the integrand. Near its largest value the density is constant.
    const Tail bare = find_tail(values.integrand, end, t.tail);
    findings.contribution[side] = std::max(findings.contribution[side], contribution(bare, values.weights[side]));
    findings.shape[side] = std::min(tail.shape, bare.shape);
  }
  return findings;
}

double tail_shape(std::span<const std::array<double, 2>> shapes, const Tuning& t) {
  double heavier = -infinity<double>;
  if (shapes.size() < t.persistent) return heavier;
  for (std::size_t side = 0; side < 2; ++side) {
    std::vector<double> last;
    for (const auto& s : shapes.last(t.persistent)) last.push_back(s[side]);
    std::ranges::sort(last);
    heavier = std::max(heavier, last[last.size() / 2]);
  }
  return heavier;
}

namespace {
// Share of the sum that few values and those beyond the largest hold.
double share_of_few(const Extremes& extremes, const std::array<double, 2>& unsampled, const Tuning& t) {
  const double size = extremes.mean_size(), count = static_cast<double>(extremes.count());
  double most = 0;
  for (const auto side : {TailSide::smallest, TailSide::largest}) {
    const bool above = side == TailSide::largest;
    const double missing = unsampled[above] / size;
    double few = missing;
    for (const double x : above ? extremes.largest(t.few_values) : extremes.smallest(t.few_values))
      few += std::abs(x) / size / count;
    most = std::max(most, few / (1 + missing));
  }
  return most;
}
} // namespace

ErrorBar judge(const Extremes& extremes, const std::array<double, 2>& unsampled,
               std::span<const std::array<double, 2>> shapes, int dim, const Tuning& t) {
  if (size_of(extremes) == 0) return ErrorBar::all_zero;
  const double count = static_cast<double>(extremes.count()), shape = tail_shape(shapes, t);
  // Fewer points than the cube has corners cannot tell a singularity from a peak.
  const bool few_points = dim > std::log2(count);
  // One value among zeros, or few values that hold most of the sum: the next may be of any size.
  const bool one = extremes.zeros() >= 100 && extremes.count() - extremes.zeros() == 1;
  const bool few = count > 32 * static_cast<double>(t.few_values);
  if (one || (few && share_of_few(extremes, unsampled, t) > t.dominating_share)) return ErrorBar::undersampled;
  if (shape <= t.infinite_variance) return ErrorBar::known;
  if (few_points) return ErrorBar::too_few_points;
  return shape < t.not_integrable ? ErrorBar::infinite_variance : ErrorBar::not_integrable;
}

Mean mean_of_replicates(std::span<const double> means, double points, const SampledValues& values, int dim,
                        SpreadHistory& history, const Tuning& t) {
  const Extremes& extremes = values.averaged;
  const double replicates = static_cast<double>(means.size());
  const int exponent = largest_exponent(means);
  Moments scaled;
  for (const double x : means) scaled.add(std::ldexp(x, -exponent));
  const double spread = std::ldexp(std::sqrt(scaled.variance()), exponent);
  // Where values of both signs cancel, rounding is relative to their size.
  const double scale = std::max(largest_size(means), extremes.mean_size());
  history.points.push_back(points);
  history.spreads.push_back(spread > rounding * scale ? spread : 0.0);
  const Extremes& of_integrand = values.integrand.count() > 0 ? values.integrand : extremes;
  const bool constant = is_constant(of_integrand);
  double deviation = pooled_spread(history.points, history.spreads, t);
  // Where replicates agree and seldom differed before, they may do so by chance.
  if (constant || (history.spreads.back() == 0 && !convergence_rate(history.points, history.spreads, t))) {
    const double range = constant ? size_of(of_integrand) : extremes.hi() - extremes.lo();
    deviation = std::max(deviation, t.unseen_value * range / points / std::sqrt(replicates));
  }
  const TailFindings tails = tails_of(values, deviation / std::sqrt(replicates), t);
  history.shapes.push_back(tails.shape);
  std::array<double, 2> unsampled{};
  for (std::size_t side = 0; side < 2; ++side) {
    history.contributions[side].push_back(tails.contribution[side]);
    unsampled[side] = pooled_contribution(history.points, history.contributions[side], tails.shape[side], t);
  }

  Mean m{.value = std::ldexp(scaled.mean(), exponent), .dof = replicates - 1};
  m.bar = judge(extremes, unsampled, history.shapes, dim, t);
  m.tail_index = 1 / std::max(tail_shape(history.shapes, t), 0.0);
  if (m.bar == ErrorBar::all_zero) return m;
  m.constant = constant;
  m.tail = unsampled;
  m.skew = history.spreads.back() > 0 ? skew_of_mean(means, t) : 0;
  m.error = std::max({deviation / std::sqrt(replicates), std::numeric_limits<double>::epsilon() * scale, least_error});
  return m;
}

Estimate::Interval interval(const Mean& m, double confidence) {
  if (m.bar != ErrorBar::known) return {-infinity<double>, infinity<double>};
  return interval_at(m, confidence);
}

double half_width(const Mean& m) {
  static const double one_sigma = 2 * cdf(boost::math::normal(), 1.0) - 1;
  const Estimate::Interval i = interval_at(m, one_sigma);
  return (i.hi - i.lo) / 2;
}

Estimate estimate(const Mean& m, std::uint64_t calls) {
  return {m.value, m.bar == ErrorBar::known ? half_width(m) : infinity<double>, m.dof, calls};
}

Mean combine_independent(const Mean& a, const Mean& b, double share) {
  const double of_a = (1 - share) * a.error, of_b = share * b.error, error = std::hypot(of_a, of_b);
  Mean m = b;
  m.value = a.value + share * (b.value - a.value);
  m.error = error;
  m.constant = a.constant && b.constant;
  if (!(error > 0)) return m;
  m.skew = a.skew * std::pow(of_a / error, 3) + b.skew * std::pow(of_b / error, 3);
  m.dof = welch_dof(sqr(of_a / error), a.dof, sqr(of_b / error), b.dof);
  return m;
}

std::optional<double> normal_deviate(const Mean& a, const Mean& b) {
  const double error = std::hypot(a.error, b.error);
  if (!(error > 0) || a.bar != ErrorBar::known || b.bar != ErrorBar::known) return {};
  const double t =
      std::abs(a.value - b.value) / std::hypot(error, rounding * std::max(std::abs(a.value), std::abs(b.value)));
  const double dof = welch_dof(sqr(a.error / error), a.dof, sqr(b.error / error), b.dof);
  const double tail = cdf(complement(boost::math::students_t(dof), t));
  return quantile(complement(boost::math::normal(), std::max(tail, 1e-300)));
}

} // namespace mc::detail

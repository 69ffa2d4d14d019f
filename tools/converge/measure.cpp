#include <converge/measure.h>

#include <mc/core/error.h>
#include <mc/core/types.h>
#include <mc/estimate/diagnostics/tail.h>
#include <mc/random/hash.h>
#include <mc/run/part_run.h>
#include <mc/stats/scale.h>
#include <mc/stats/t_test.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>

namespace carlo {

namespace {

constexpr std::uint64_t first_replicates = 64, most_replicates = 512, reference_replicates = 128;
constexpr double rounding = 1e-12; // rounding error of sums, relative to the mean of |f|

// Numbers in units of 2^exponent, so that their fourth powers neither overflow nor underflow.
struct ScaledValues {
  std::vector<double> values;
  int exponent = 0;

  explicit ScaledValues(const std::vector<double>& x) : exponent(mc::largest_exponent(x)) {
    for (const double one : x) values.push_back(std::ldexp(one, -exponent));
  }
  double mean() const {
    double sum = 0;
    for (const double one : values)
      sum += one; // exact for integers: N must not fall below the start of the fit by rounding
    return sum / static_cast<double>(values.size());
  }
  double squares() const { // sum of squared deviations from the mean
    const double centre = mean();
    double sum = 0;
    for (const double one : values) sum += mc::sqr(one - centre);
    return sum;
  }
};

double mean_of(const std::vector<double>& x) {
  const ScaledValues s(x);
  return std::ldexp(s.mean(), s.exponent);
}

// Standard error of the mean.
double error_of_mean(const std::vector<double>& x) {
  const ScaledValues s(x);
  const double n = static_cast<double>(x.size());
  return std::ldexp(std::sqrt(s.squares() / (n - 1) / n), s.exponent);
}

// The mean kurtosis of the errors over the sets of replicates from N / 16 to 16 N that exist. A single set often misses
// a long tail, so several sets are averaged.
double mean_kurtosis(const std::vector<Replicates>& all, std::size_t at, double truth) {
  constexpr std::size_t beside = 4;
  double sum = 0, count = 0;
  for (std::size_t i = at - std::min(at, beside); i < std::min(at + beside + 1, all.size()); ++i) {
    const double n = static_cast<double>(all[i].values.size());
    sum += n * mc::error_kurtosis(all[i].values, std::isfinite(truth) ? truth : mean_of(all[i].values));
    count += n;
  }
  return count > 0 ? sum / count : 0;
}

// The number of replicates for which the relative standard error of the RMS error is 10 %. Its relative variance is
// (kurtosis - 1) / (4 R). The kurtosis is the larger of the one at this N and the mean at smaller N. If all replicates
// agree, the variance is unknown: then the maximum number is needed.
double replicates_needed(const std::vector<double>& values, double truth, double kurtosis) {
  if (error_of_mean(values) == 0) return double(most_replicates);
  const double own = mc::error_kurtosis(values, std::isfinite(truth) ? truth : mean_of(values));
  return (std::max(own, kurtosis) - 1) / (4 * 0.01);
}

// `before`: the sets of replicates at smaller N.
Replicates replicate(const IntegralTarget& target, const SamplingMethod& method, std::uint64_t n,
                     const std::vector<Replicates>& before, const MeasureOptions& o) {
  const auto run = [&](std::uint64_t first, std::uint64_t count) {
    return o.log->run(target, {&method, n, o.seed, first, count, o.threads, o.cancel});
  };
  if (o.replicates > 0) return run(0, static_cast<std::uint64_t>(o.replicates));
  Replicates all = run(0, first_replicates);
  const double truth = target.integral.truth;
  const double needed = replicates_needed(all.values, truth, mean_kurtosis(before, before.size(), truth));
  const auto count = static_cast<std::uint64_t>(std::clamp(needed, 0.0, double(most_replicates)));
  if (count > first_replicates && !*o.cancel) append(all, run(first_replicates, count - first_replicates));
  return all;
}

double median(std::vector<double> x) {
  std::nth_element(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2), x.end());
  return x[x.size() / 2];
}

// A conservative standard error of the mean of a curve's last replicates. Their spread can be nearly 0 by chance, for
// example if each of them samples the same side of a jump. So the error falls by at most a factor of 4 where N doubles,
// which is N^-2. If replicates have never differed, the error is infinite.
double credible_error_of_mean(const ConvergenceCurve& c) {
  double error = mc::infinity<double>;
  for (const Replicates& r : c.replicates) {
    const double own = error_of_mean(r.values);
    if (own > 0 || std::isfinite(error)) error = std::isfinite(error) ? std::max(own, error / 4) : own;
  }
  return error;
}

// Whether the goals are reached with a safety margin.
bool reaches_goals(const ConvergenceCurve& curve, const UnitCubeIntegral& e, const MeasureOptions& o) {
  const Replicates& r = curve.replicates.back();
  if (o.cpu_goal > 0 && median(r.seconds) > o.cpu_goal) return true;
  if (!(o.error_goal > 0)) return false;
  const auto n = static_cast<double>(r.values.size());
  const double off = std::isfinite(e.truth) ? std::abs(mean_of(r.values) - e.truth) : 0;
  return std::hypot(off, std::sqrt(n - 1) * credible_error_of_mean(curve)) < 0.7 * o.error_goal;
}

// Runs the replicates only; evaluate_curve computes the errors once the truth is available. An interrupt discards only
// the current N.
ConvergenceCurve run_curve(const IntegralTarget& target, const SamplingMethod& method, double seconds,
                           const MeasureOptions& o, const std::function<void(std::uint64_t n)>& progress) {
  ConvergenceCurve curve;
  curve.method = &method;
  if (method.points_file.empty())
    curve.theory = theoretical_rate(method.name, target.integral.smoothness, target.integral.dim);
  const double start = o.log->elapsed();
  const auto elapsed = [&] { return o.log->elapsed() - start; };
  double last = 0;
  for (std::uint64_t n = 16; n <= std::min(o.max_n, method.max_calls); n *= 2) {
    if (n < method.min_calls) continue;
    const double before = elapsed();
    curve.out_of_time = seconds > 0 && before + 2 * last > seconds && curve.replicates.size() >= 3;
    if (curve.out_of_time) break;
    Replicates r = replicate(target, method, n, curve.replicates, o);
    curve.interrupted = *o.cancel;
    if (curve.interrupted) break;
    curve.replicates.push_back(std::move(r));
    last = elapsed() - before;
    progress(n);
    if (curve.replicates.size() >= 3 && reaches_goals(curve, target.integral, o)) break;
  }
  return curve;
}

// The error of the reference can have either sign, so it widens both edges. An error that the reference alone may
// explain becomes a bound.
void add_reference_error(mc::RmsError& e, double truth_error) {
  const double most = 2 * truth_error;
  e.lo = e.lo > most ? std::sqrt(e.lo - most) * std::sqrt(e.lo + most) : 0;
  e.hi = std::hypot(e.hi, most);
  e.is_bound = e.lo == 0;
  if (e.is_bound) e.rms = e.hi;
}

// For a tail with the index a, the share n^(2 / a - 1) of the variance lies beyond the largest of n values. Dependent
// points sample the tail only where one of them is nearest to it: then n is the number of replicates.
void allow_for_tail(mc::RmsError& e, double index, double values) {
  constexpr double light = 8, most = 0.9;
  if (index < light) e.hi /= std::sqrt(1 - std::min(std::pow(values, std::min(2 / index - 1, 0.0)), most));
}

void evaluate_curve(ConvergenceCurve& curve, const UnitCubeIntegral& e, const Measurement& m, double tail_index) {
  const double floor = rounding * m.magnitude;
  double worst = 0;
  for (std::size_t i = 0; i < curve.replicates.size(); ++i) {
    const Replicates& r = curve.replicates[i];
    const double kurtosis = mean_kurtosis(curve.replicates, i, m.truth);
    mc::RmsError error = mc::rms_error(mean_of(r.calls), r.values, m.truth, kurtosis);
    const double together = curve.method->name == m.plain_mc ? error.n : 1;
    allow_for_tail(error, tail_index, together * static_cast<double>(r.values.size()));
    if (m.truth_error > 0) add_reference_error(error, m.truth_error);
    error.seconds = median(r.seconds);
    worst = std::max(worst, error.rms);
    curve.errors.push_back(error);
  }
  curve.exact = worst <= floor;
  if (curve.exact) return;
  // If the asymptotic range is unknown, the fit uses the upper half of the doublings.
  const std::size_t half = curve.errors.size() / 2;
  std::vector<mc::RmsError> fitted;
  double fewest = double(most_replicates), logs = 0;
  for (std::size_t i = 0; i < curve.errors.size(); ++i) {
    const mc::RmsError& one = curve.errors[i];
    if (one.is_bound || one.rms <= floor || (e.min_fit_n > 0 ? one.n < e.min_fit_n : i < half)) continue;
    fitted.push_back(one);
    fewest = std::min(fewest, mc::effective_error_count(double(curve.replicates[i].values.size()),
                                                        mean_kurtosis(curve.replicates, i, m.truth)));
    logs += std::log(one.n);
  }
  if (fitted.size() < 3) return;
  curve.power_law = mc::fit_power_law(fitted, static_cast<std::uint32_t>(fewest));
  curve.fit_center = std::exp(logs / static_cast<double>(fitted.size()));
}

// Properties of an integrand, estimated from independent points.
struct IntegrandProbe {
  double magnitude;  // the mean of |f| over a few points; rounding is relative to it, since the integral itself may
                     // cancel
  double tail_shape; // of the heavier tail of f, as all thresholds show it
  double fit_shape;  // as most values show it
};

IntegrandProbe probe_integrand(const IntegralTarget& target, const MeasureOptions& o) {
  const std::uint64_t points = std::min<std::uint64_t>(4 * o.max_n, 1 << 14); // less than the largest N costs
  const Replicates r =
      o.log->run(target, {&sampling_method("random"), 1, mc::hash(o.seed, 78), 0, points, o.threads, o.cancel});
  std::vector<double> sizes;
  for (const double x : std::span(r.values).first(std::min<std::size_t>(r.values.size(), first_replicates)))
    sizes.push_back(std::abs(x));
  // All values are kept, so that more of them may be the tail than integrate() keeps.
  constexpr mc::TailOptions options{.share = 1.0 / 16, .least = 128, .most = 1024};
  const auto tail = [&](double sign) {
    std::vector<double> values;
    for (const double x : r.values)
      if (std::isfinite(x)) values.push_back(sign * x);
    std::ranges::sort(values, std::greater<>());
    return mc::find_tail(values, values.size(), options);
  };
  const mc::Tail low = tail(-1), high = tail(1);
  return {mean_of(sizes), std::max(low.shape, high.shape), std::max(low.fit.shape, high.fit.shape)};
}

// The curve with the smallest conservative standard error at its largest N, among the methods that do not adapt. An
// interrupted curve with identical replicates is excluded: a few points may all miss the support of the integrand. If
// no replicates have ever differed, it is the curve with the largest N.
const ConvergenceCurve* most_precise_curve(const std::vector<ConvergenceCurve>& curves) {
  const ConvergenceCurve* best = nullptr;
  const auto rank = [](const ConvergenceCurve& c) {
    return std::pair(credible_error_of_mean(c), -c.replicates.back().calls[0]);
  };
  const auto is_usable = [&](const ConvergenceCurve& c) {
    return !c.method->is_adaptive && !(c.interrupted && error_of_mean(c.replicates.back().values) == 0);
  };
  for (const ConvergenceCurve& c : curves)
    if (is_usable(c) && (!best || rank(c) < rank(*best))) best = &c;
  return best;
}

// The truth and its standard error. After an interrupt it uses the existing replicates.
std::pair<double, double> estimate_truth(const IntegralTarget& target, const std::vector<ConvergenceCurve>& curves,
                                         const MeasureOptions& o) {
  const ConvergenceCurve* best = most_precise_curve(curves);
  mc::require(
      best, "{}: its true value is unknown, and no non-adaptive method is given to estimate it; add one to --samplers",
      target.integral.name);
  const Replicates& last = best->replicates.back();
  const auto largest = static_cast<std::uint64_t>(last.calls[0]);
  std::vector<double> values = last.values;
  try {
    const Replicates r =
        o.log->run(target, {best->method, largest, mc::hash(o.seed, 77), 0, reference_replicates, o.threads, o.cancel});
    if (!*o.cancel) values = r.values;
  } catch (const mc::Error&) {
    // Other points than before met an error: then the truth is the mean of the replicates behind the curve.
  }
  return {mean_of(values), error_of_mean(values)};
}

// Why the stated truth must be wrong; empty if there is no reason. An interrupted curve is no evidence.
std::string wrong_truth_warning(const UnitCubeIntegral& e, const Measurement& m) {
  const std::vector<ConvergenceCurve>& curves = m.curves;
  const ConvergenceCurve* best = nullptr;
  double value = 0, error = HUGE_VAL;
  int agree = 0, unbiased = 0;
  for (const ConvergenceCurve& c : curves) {
    if (c.method->is_adaptive || c.exact || c.interrupted) continue;
    const std::vector<double>& last = c.replicates.back().values;
    const double mean = mean_of(last), own = error_of_mean(last);
    ++unbiased;
    if (!(std::abs(mean - e.truth) > 6 * own + rounding * m.magnitude)) continue;
    if (!best || own < error) {
      best = &c;
      value = mean;
      error = own;
    }
  }
  if (!best) return {};
  for (const ConvergenceCurve& c : curves) {
    if (c.method->is_adaptive || c.interrupted) continue;
    const std::vector<double>& last = c.replicates.back().values;
    agree += std::abs(mean_of(last) - value) <= 4 * std::hypot(error_of_mean(last), error);
  }
  if (agree < std::min(unbiased, 2)) return {};
  return fmt::format("the stated truth {:.12g} is wrong, or the integrand is: errors stop falling at {:.2g}, where {} "
                     "settles at {:.12g} +- {:.2g}",
                     e.truth, std::abs(value - e.truth), best->method->name, value, error);
}

// Whether one replicate contributes over half of the squared deviations from the mean, and fewer than one in a million
// sets of normal replicates would. The largest share s of R deviations is distributed as t^2 / (R - 2 + t^2) (R - 1) /
// R, with t of R - 2 degrees of freedom.
bool one_dominates(const std::vector<double>& values) {
  const ScaledValues s(values);
  const double mean = s.mean(), sum = s.squares();
  double largest = 0;
  for (const double x : s.values) largest = std::max(largest, mc::sqr(x - mean));
  const double n = static_cast<double>(values.size()), share = largest / sum * n / (n - 1);
  if (!(largest > sum / 2) || n < 4) return false;
  return share >= 1 || n * mc::student_tail(std::sqrt((n - 2) * share / (1 - share)), n - 2) < 1e-6;
}

// Why an estimated truth may be meaningless; empty if there is no reason. Means with a finite variance are nearly
// normal at the larger N.
std::string unreliable_reference_warning(const std::vector<ConvergenceCurve>& curves) {
  const auto is_usable = [](const ConvergenceCurve& c) { return !c.method->is_adaptive && !c.exact && !c.interrupted; };
  int sets = 0, dominated = 0;
  for (const ConvergenceCurve& c : curves)
    for (std::size_t i = c.replicates.size() / 2; is_usable(c) && i < c.replicates.size(); ++i) {
      ++sets;
      dominated += one_dominates(c.replicates[i].values);
    }
  if (dominated < 2 || 4 * dominated < sets) return {};
  return fmt::format("in {} of {} sets of replicates one holds over half of the variance: the integral or its variance "
                     "may be infinite, or few points meet what it is made of; errors and slopes are of chance",
                     dominated, sets);
}

bool all_zero(const std::vector<ConvergenceCurve>& curves) {
  for (const ConvergenceCurve& c : curves)
    for (const Replicates& r : c.replicates)
      if (std::any_of(r.values.begin(), r.values.end(), [](double x) { return x != 0; })) return false;
  return true;
}

} // namespace

bool ConvergenceCurve::has_measurable_error() const {
  const auto is_known = [](const mc::RmsError& e) { return e.rms > 0 && !e.is_bound; };
  return !exact && std::any_of(errors.begin(), errors.end(), is_known);
}

bool ConvergenceCurve::agrees_with_theory() const {
  return power_law && theory && theory->is_consistent_with(power_law->lo, power_law->hi, fit_center);
}

double replicates_memory(const std::vector<SamplingMethod>& methods, const MeasureOptions& o) {
  const double each = 3 * sizeof(double) * (o.replicates > 0 ? double(o.replicates) : double(most_replicates));
  double sets = 0;
  for (const SamplingMethod& m : methods)
    for (std::uint64_t n = 16; n <= std::min(o.max_n, m.max_calls); n *= 2) sets += n >= m.min_calls;
  return each * sets;
}

Measurement measure_convergence(const IntegralTarget& target, const std::vector<SamplingMethod>& methods,
                                const MeasureOptions& options) {
  static const std::atomic<bool> never = false;
  MeasureOptions o = options;
  if (!o.cancel) o.cancel = &never;
  Measurement m;
  ReplicateLog own_log(nullptr);
  if (!o.log) o.log = &own_log;
  const double start = o.log->elapsed();
  if (o.parts) o.log->use(o.parts->repeated);
  const IntegrandProbe probe = probe_integrand(target, o);
  m.magnitude = probe.magnitude;
  const double tail_index = probe.fit_shape > 0 ? 1 / probe.fit_shape : HUGE_VAL;
  if (probe.tail_shape > 0.5) m.heavy_tail = 1 / probe.tail_shape;
  if (m.magnitude == 0) refuse_underflow(target.integral);
  const bool known = std::isfinite(target.integral.truth);
  mc::IndependentPieces pieces;
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const double gone = o.log->elapsed() - start;
    const double share = o.seconds > 0 ? std::max(1e-3, o.seconds - gone) / static_cast<double>(methods.size() - i) : 0;
    const auto progress = [&](std::uint64_t n) {
      // Work grows with N: the last N takes half of a curve's time.
      const double done = (static_cast<double>(i) + static_cast<double>(n) / static_cast<double>(o.max_n)) /
                          static_cast<double>(methods.size());
      if (o.progress) o.progress(done, fmt::format("{} {} N = {}", target.integral.name, methods[i].name, n));
    };
    if (o.parts) o.log->use(o.parts->alone(o.first_piece + i));
    pieces.attempt([&] {
      try {
        ConvergenceCurve curve = run_curve(target, methods[i], share, o, progress);
        m.interrupted = curve.interrupted;
        if (!curve.replicates.empty()) m.curves.push_back(std::move(curve));
      } catch (const mc::Error& e) {
        m.failures.push_back({&methods[i], e.what()});
      }
    });
    if (m.interrupted) break;
    mc::require(known || m.curves.empty() || !all_zero(m.curves),
                "{}: the integrand was 0 at every point; choose bounds around the region where it is not",
                target.integral.name);
  }
  pieces.end();
  if (o.parts) o.log->use(o.parts->shared);
  if (m.curves.empty() && !m.failures.empty()) throw mc::Error(m.failures.front().reason);
  m.truth = target.integral.truth;
  // After an interrupt the existing replicates may not suffice for a truth. Then no error is reported, and the
  // integrand is not blamed.
  if (m.interrupted && !known && (!most_precise_curve(m.curves) || all_zero(m.curves))) m.curves.clear();
  if (m.curves.empty()) return m;
  if (!known) std::tie(m.truth, m.truth_error) = estimate_truth(target, m.curves, o);
  m.interrupted = m.interrupted || *o.cancel;
  m.magnitude = std::max(m.magnitude, std::abs(m.truth));
  for (ConvergenceCurve& c : m.curves) evaluate_curve(c, target.integral, m, tail_index);
  m.truth_warning = known ? wrong_truth_warning(target.integral, m) : unreliable_reference_warning(m.curves);
  return m;
}

} // namespace carlo

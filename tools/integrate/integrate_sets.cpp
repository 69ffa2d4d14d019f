#include <integrate/integrate_sets.h>

#include <mc/core/error.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace carlo {

namespace {

// A constant, as a finite sum is: it has no error.
mc::VectorIntegral exact(const mc::VectorIntegrand& f, std::size_t outputs) {
  const std::vector<double> u = {0.5};
  std::vector<double> values(outputs);
  f(u, values);
  mc::VectorIntegral r;
  for (const double value : values) {
    mc::require(std::isfinite(value), "the sum is {}; every term must be finite (see --where and --nan)", value);
    mc::Integral sum{.estimate = {.value = value, .std_error = 0}, .interval = {value, value}};
    sum.calls = 1;
    r.outputs.push_back(sum);
  }
  r.correlations.assign(outputs * outputs, 0);
  for (std::size_t i = 0; i < outputs; ++i) r.correlations[i * outputs + i] = 1;
  return r;
}

// Integrates all integrands together, or one with its histogram.
mc::VectorIntegral results_of(const IntegrandSets& sets, const Histogram& histogram, const mc::IntegrateOptions& o) {
  for (const IntegrandSet& set : sets)
    if (set.expression) set.expression->take_replaced(); // of an earlier run
  const IntegrandSet& first = sets.front();
  const std::size_t each = first.integrands.size(), outputs = each * sets.size();
  const auto f = [&](std::span<const double> points, std::span<double> values) {
    if (sets.size() == 1) return first.f(points, values);
    const std::size_t dim = static_cast<std::size_t>(first.dim());
    for (std::size_t i = 0; i < values.size() / outputs; ++i)
      for (std::size_t p = 0; p < sets.size(); ++p)
        sets[p].f(points.subspan(i * dim, dim), values.subspan(i * outputs + p * each, each));
  };
  if (first.is_exact_sum())
    return histogram.bins.empty() ? exact(f, outputs) : exact(histogram.f, 1 + histogram.bins.size());
  if (!histogram.bins.empty()) return integrate(histogram, first.dim(), o);
  if (outputs == 1) return {{mc::integrate_unit(mc::BatchIntegrand{f}, first.dim(), o)}, {1}};
  return mc::integrate_unit(mc::BatchIntegrand{f}, static_cast<int>(outputs), first.dim(), o);
}

// The least absolute value of an integral, of a complex one the modulus.
double least_modulus(const IntegrandSets& sets, const mc::VectorIntegral& r) {
  double least = std::numeric_limits<double>::infinity();
  std::size_t k = 0;
  const auto value = [&] { return r.outputs[k++].estimate.value; };
  for (const IntegrandSet& set : sets)
    for (std::size_t i = 0; i < set.integrands.size(); ++i) {
      const double first = value(), second = set.is_complex(i) ? value() : 0;
      if (set.is_complex(i)) ++i;
      least = std::min(least, std::hypot(first, second));
    }
  return least;
}

} // namespace

mc::VectorIntegral integrate_sets(const IntegrandSets& sets, const Histogram& histogram, mc::IntegrateOptions& o) {
  if (sets.front().texts.back() + 1 == sets.front().texts.size()) // no text has two integrands
    return results_of(sets, histogram, o);
  constexpr std::uint64_t short_run = 1 << 14, least_run = 1 << 10;
  const double given = o.abs_error;
  mc::IntegrateOptions run = o;
  run.max_calls = std::min(o.max_calls / 4, short_run);
  if (run.max_calls < least_run) run.max_calls = o.max_calls; // too few calls for two runs
  mc::VectorIntegral r = results_of(sets, histogram, run);
  std::uint64_t spent = 0;
  for (;;) {
    o.abs_error = std::max(given, o.rel_error * least_modulus(sets, r));
    // A run that reached another error than the one that its own modulus asks for.
    const bool reached = run.abs_error > given && run.abs_error <= 1.01 * o.abs_error;
    const bool stopped = run.abs_error > given && r.outputs.front().stop != mc::StopReason::converged;
    const std::uint64_t calls = spent + r.outputs.front().calls, left = o.max_calls - calls;
    const bool cancelled = r.outputs.front().stop == mc::StopReason::cancelled;
    if (reached || stopped || cancelled || left < least_run) break;
    spent = calls;
    run = o;
    run.max_calls = left;
    r = results_of(sets, histogram, run);
  }
  for (mc::Integral& one : r.outputs) {
    if (one.stop == mc::StopReason::converged && run.abs_error > 1.01 * o.abs_error)
      one.stop = mc::StopReason::max_calls;
    one.calls += spent;
    for (mc::IntegrateRound& round : one.rounds) round.calls += spent;
  }
  return r;
}

std::string in_variables(const mc::NotFinite& e, const IntegrandSets& sets) {
  for (const IntegrandSet& set : sets)
    for (const UnitCubeIntegral& x : set.integrands) {
      const double value = x.describe_point ? x.f(e.u) : 0;
      if (std::isfinite(value)) continue;
      const std::string message = mc::NotFinite(e.bad, e.points, e.u, x.describe_point(e.u)).what();
      if (!set.expression || !std::isnan(value)) return message;
      return message + (set.expression->has_finite_bounds()
                            ? "; it is nan there (see --nan)"
                            : "; it is nan there: inf * 0 or inf - inf? Merge the exponents or bound the domain");
    }
  return e.what();
}

} // namespace carlo

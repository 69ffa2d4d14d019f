// Functions of <mc/estimate/integrate.h> that integrate. They are in this folder because they use its methods, which
// depend on the folder above and not vice versa.

#include <mc/core/error.h>
#include <mc/core/types.h>
#include <mc/estimate/integrate.h>
#include <mc/estimate/integrate/methods/methods.h>

#include <boost/math/distributions/chi_squared.hpp>

#include <cmath>
#include <limits>

namespace mc {

using detail::Integrand;
using detail::Outcome;
using detail::Run;

namespace {

void require_sane(int outputs, int dim, const IntegrateOptions& o) {
  require(dim >= 1, "integrate: dimension {} must be at least 1", dim);
  require(outputs >= 1, "integrate: {} outputs; at least 1 is needed", outputs);
  require(o.rel_error >= 0 && o.abs_error >= 0 && std::isfinite(o.rel_error) && std::isfinite(o.abs_error),
          "integrate: tolerances {} (relative) and {} (absolute) must be finite and >= 0", o.rel_error, o.abs_error);
  require(o.threads >= 0, "integrate: threads {} must be >= 0; 0 stands for all of the machine's", o.threads);
  require(o.confidence > 0 && o.confidence < 1, "integrate: confidence {} must lie in (0, 1)", o.confidence);
  require(o.auxiliary_outputs < static_cast<std::size_t>(outputs),
          "integrate: {} of {} outputs are auxiliary; at least 1 must not be", o.auxiliary_outputs, outputs);
  require(o.replicates >= 2 && o.replicates <= 1u << 20,
          "integrate: {} replicates; between 2 and 2^20 are needed for an error", o.replicates);
  if (!o.density) return;
  require(detail::method_rows()[static_cast<std::size_t>(o.method)].adaptive,
          "integrate: {} uses no density; vegas, tree and auto do", name(o.method));
  require(o.density->dim() == dim, "integrate: the density has {} dimensions, the integrand {}", o.density->dim(), dim);
}

// Results of all rounds for one output.
std::vector<IntegrateRound> rounds_of(const Run& run, std::size_t output) {
  std::vector<IntegrateRound> all;
  for (const detail::Round& r : run.rounds) {
    const detail::Mean& mean = r.means[output];
    const double chi2 = r.chi2.empty() ? std::numeric_limits<double>::quiet_NaN() : r.chi2[output];
    all.push_back({r.method, r.learning, r.calls, detail::estimate(mean, r.calls), mean.bar, chi2});
  }
  return all;
}

Integral integral_of(const Run& run, const Outcome& outcome, std::size_t k) {
  Integral r;
  const detail::Mean& mean = outcome.means[k];
  r.estimate = detail::estimate(mean, run.evaluator.calls);
  r.confidence = run.options().confidence;
  r.interval = detail::interval(mean, r.confidence);
  r.error_bar = mean.bar;
  r.constant = mean.constant;
  r.tail_index = mean.tail_index;
  r.infinite_points = outcome.infinite.empty() ? 0 : outcome.infinite[k];
  r.calls = run.evaluator.calls;
  r.seconds = run.seconds();
  r.method = outcome.method;
  r.stop = outcome.stop;
  r.density = outcome.density;
  r.rounds = rounds_of(run, k);
  for (const IntegrateRound& round : r.rounds)
    if (std::isfinite(round.chi2) && round.chi2 > 0) {
      r.chi2 += round.chi2;
      r.chi2_dof += 1;
    }
  r.consistent = !(r.chi2_dof > 0) || cdf(complement(boost::math::chi_squared(r.chi2_dof), r.chi2)) > 1e-4;
  return r;
}

} // namespace

VectorIntegral detail::integrate(const Integrand& f, int outputs, int dim, const IntegrateOptions& o,
                                 const Tuning& tuning) {
  require_sane(outputs, dim, o);
  require(!f.empty(), "integrate: the integrand is an empty function; it must be callable");
  const std::uint64_t least = o.method == Method::plain ? 2 : 2 * std::uint64_t{o.replicates};
  require(o.max_calls >= least, "integrate: max_calls {} is too few; at least {} are needed", o.max_calls, least);

  Run run{{f, static_cast<std::size_t>(outputs), dim, o}, tuning};
  Outcome outcome;
  try {
    outcome = detail::method_rows()[static_cast<std::size_t>(o.method)].run(run);
  } catch (const detail::Cancelled&) {
    require(run.last.has_value(), "integrate: cancelled before anything was estimated");
    outcome = *run.last;
    outcome.stop = StopReason::cancelled;
  }
  if (outcome.stop == StopReason::max_calls && run.excess(outcome.means) <= 1) outcome.stop = StopReason::converged;
  for (detail::Round& round : run.rounds)
    if (round.independent) round.compare(outcome.means);
  VectorIntegral result{.outputs = {}, .correlations = outcome.correlations};
  for (std::size_t k = 0; k < run.evaluator.outputs; ++k) result.outputs.push_back(integral_of(run, outcome, k));
  return result;
}

VectorIntegral integrate_unit(const VectorIntegrand& f, int outputs, int dim, const IntegrateOptions& o) {
  return detail::integrate(Integrand{.several = &f}, outputs, dim, o);
}

Integral integrate_unit(const std::function<double(std::span<const double>)>& f, int dim, const IntegrateOptions& o) {
  return detail::integrate(Integrand{.one = &f}, 1, dim, o).outputs.front();
}

VectorIntegral integrate_unit(const BatchIntegrand& f, int outputs, int dim, const IntegrateOptions& o) {
  return detail::integrate(Integrand{.batch = &f}, outputs, dim, o);
}

Integral integrate_unit(const BatchIntegrand& f, int dim, const IntegrateOptions& o) {
  return detail::integrate(Integrand{.batch = &f}, 1, dim, o).outputs.front();
}

Integral integrate_rqmc(const std::function<double(std::span<const double>)>& f, int dim, std::uint64_t count,
                        std::uint32_t replicates, std::uint64_t seed, int threads) {
  IntegrateOptions o;
  o.replicates = replicates;
  o.seed = seed;
  o.threads = threads;
  o.max_calls = count * replicates;
  require_sane(1, dim, o);
  require(f != nullptr, "integrate: the integrand is an empty function; it must be callable");
  require(count >= 1 && count <= std::uint64_t{1} << 32, "integrate_rqmc: {} points; between 1 and 2^32 are possible",
          count);
  Run run{{{.one = &f}, 1, dim, o}};
  detail::Replicates sequences(run, detail::Stream::rqmc, 0, replicates);
  sequences.extend(count);
  return integral_of(run, sequences.outcome(Method::rqmc), 0);
}

} // namespace mc

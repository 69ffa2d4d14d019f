// Functions of <mc/estimate/integrate.h> that integrate. They are in this folder because they use its methods, which
// depend on the folder above and not vice versa.

#include <mc/core/error.h>
#include <mc/estimate/integrate.h>
#include <mc/estimate/integrate/methods.h>
#include <mc/estimate/integrate/replicated_sequences.h>

#include <boost/math/distributions/chi_squared.hpp>

#include <cmath>
#include <limits>

namespace mc {

using detail::Integrand;
using detail::IntegrationRun;
using detail::Outcome;

namespace {

void require_sane(int outputs, int dim, const IntegrateOptions& o) {
  require(dim >= 1, "integrate: dimension {} must be at least 1", dim);
  require(outputs >= 1, "integrate: {} outputs; at least 1 is needed", outputs);
  require(o.rel_error >= 0 && o.abs_error >= 0 && std::isfinite(o.rel_error) && std::isfinite(o.abs_error),
          "integrate: tolerances {} (relative) and {} (absolute) must be finite and >= 0", o.rel_error, o.abs_error);
  require(o.threads >= 0, "integrate: threads {} must be >= 0; 0 stands for all of the machine's", o.threads);
  require(o.confidence > 0 && o.confidence < 1, "integrate: confidence {} must lie in (0, 1)", o.confidence);
  require(o.auxiliary_outputs < static_cast<std::size_t>(outputs),
          "integrate: {} of {} outputs are watched; 1 must not be", o.auxiliary_outputs, outputs);
  require(o.replicates >= 2 && o.replicates <= 1u << 20,
          "integrate: {} replicates; between 2 and 2^20 are needed for an error", o.replicates);
  if (!o.density) return;
  require(o.method == Method::automatic || o.method == Method::vegas || o.method == Method::tree,
          "integrate: {} uses no density; vegas, tree and auto do", name(o.method));
  require(o.density->dim() == dim, "integrate: the density has {} dimensions, the integrand {}", o.density->dim(), dim);
}

// Results of all rounds for one output.
std::vector<IntegrateRound> rounds_of(const IntegrationRun& run, std::size_t output) {
  std::vector<IntegrateRound> all;
  for (const detail::Round& r : run.rounds) {
    const detail::Mean& mean = r.means[output];
    const double chi2 = r.chi2.empty() ? std::numeric_limits<double>::quiet_NaN() : r.chi2[output];
    all.push_back({r.method, r.learning, r.calls, detail::estimate(mean, r.calls), mean.reported_error_bar(), chi2});
  }
  return all;
}

Outcome run_method(IntegrationRun& run, Method method, std::optional<Outcome>& last) {
  if (method == Method::plain) return detail::plain(run, last);
  if (method == Method::stratified) return detail::stratified(run, last);
  return detail::replicated_rqmc(run, method, last);
}

VectorIntegral integrate_unit(const Integrand& f, int outputs, int dim, const IntegrateOptions& o) {
  require_sane(outputs, dim, o);
  require(!f.empty(), "integrate: the integrand is an empty function; it must be callable");
  const Method method =
      o.method == Method::automatic && static_cast<std::uint32_t>(dim) > Sobol::dimensions ? Method::plain : o.method;
  const std::uint64_t least = method == Method::plain ? 2 : 2 * std::uint64_t{o.replicates};
  require(o.max_calls >= least, "integrate: max_calls {} is too few; at least {} are needed", o.max_calls, least);

  IntegrationRun run{f, static_cast<std::size_t>(outputs), dim, o};
  std::optional<Outcome> last;
  Outcome outcome;
  try {
    outcome = run_method(run, method, last);
  } catch (const detail::Cancelled&) {
    require(last.has_value(), "integrate: cancelled before anything was estimated");
    outcome = *last;
    outcome.stop = StopReason::cancelled;
  }
  for (detail::Round& round : run.rounds)
    if (round.independent) run.add_chi2(round, outcome.means);
  VectorIntegral result{.outputs = {}, .correlations = outcome.correlations};
  for (std::size_t k = 0; k < run.outputs; ++k) {
    Integral r;
    const detail::Mean& mean = outcome.means[k];
    r.estimate = detail::estimate(mean, run.calls);
    r.interval = detail::interval(mean, o.confidence);
    r.confidence = o.confidence;
    r.error_bar = mean.reported_error_bar();
    r.tail_index = outcome.diagnostics[k].decisive_tail_index();
    r.infinite_points = outcome.diagnostics[k].infinite_count;
    r.calls = run.calls;
    r.seconds = run.seconds();
    r.method = outcome.method;
    r.stop = outcome.stop;
    r.chi2 = run.chi2[k];
    r.chi2_dof = run.chi2_dof[k];
    r.density = outcome.density;
    r.rounds = rounds_of(run, k);
    r.consistent = !(r.chi2_dof > 0) || cdf(complement(boost::math::chi_squared(r.chi2_dof), r.chi2)) > 1e-4;
    result.outputs.push_back(r);
  }
  return result;
}

} // namespace

VectorIntegral integrate_unit(const VectorIntegrand& f, int outputs, int dim, const IntegrateOptions& o) {
  return integrate_unit(Integrand{.several = &f}, outputs, dim, o);
}

Integral integrate_unit(const std::function<double(std::span<const double>)>& f, int dim, const IntegrateOptions& o) {
  return integrate_unit(Integrand{.one = &f}, 1, dim, o).outputs.front();
}

VectorIntegral integrate_unit(const BatchIntegrand& f, int outputs, int dim, const IntegrateOptions& o) {
  return integrate_unit(Integrand{.batch = &f}, outputs, dim, o);
}

Integral integrate_unit(const BatchIntegrand& f, int dim, const IntegrateOptions& o) {
  return integrate_unit(Integrand{.batch = &f}, 1, dim, o).outputs.front();
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
  require(count >= 1 && count <= detail::ReplicatedSequences::max_length,
          "integrate_rqmc: {} points; between 1 and 2^32 are possible", count);
  IntegrationRun run{{.one = &f}, 1, dim, o};
  detail::ReplicatedSequences sequences{.stream_id = 0, .count = replicates};
  const detail::Mean mean = sequences.extend(run, count).front();
  Integral result;
  result.estimate = detail::estimate(mean, run.calls);
  result.interval = detail::interval(mean, o.confidence);
  result.confidence = o.confidence;
  result.error_bar = mean.reported_error_bar();
  result.tail_index = sequences.diagnostics().front().tail_index();
  result.infinite_points = sequences.diagnostics().front().infinite_count;
  result.calls = run.calls;
  result.method = Method::rqmc;
  result.stop = StopReason::max_calls;
  result.seconds = run.seconds();
  return result;
}

} // namespace mc

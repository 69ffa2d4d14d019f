#include <mc/core/error.h>
#include <mc/core/parallel.h>
#include <mc/estimate/integrate.h>
#include <mc/estimate/moments.h>
#include <mc/sampler/independent.h>
#include <mc/sampler/sobol.h>
#include <mc/sampler/stratified.h>

#include <array>
#include <chrono>
#include <cmath>

namespace mc {

namespace {

using Integrand = std::function<double(std::span<const double>)>;

constexpr std::array<std::string_view, 4> method_names = {"auto", "plain", "stratified", "rqmc"};
constexpr std::uint64_t chunk = 4096; // points per task: fixed, so sums do not depend on the number of threads

// Moments of f over points [first, first + count) of a sampler.
template <Sampler T> Moments evaluate(const Integrand& f, int dim, const T& sampler, std::uint64_t first, std::uint64_t count) {
  Moments moments;
  std::vector<double> u(static_cast<std::size_t>(dim));
  for (std::uint64_t i = first; i < first + count; ++i) {
    for (int d = 0; d < dim; ++d) u[static_cast<std::size_t>(d)] = coordinate<double>(sampler, i, static_cast<std::uint32_t>(d));
    moments.add(f(u), i);
  }
  return moments;
}

template <Sampler T> Moments evaluate_parallel(const Integrand& f, int dim, const T& sampler, std::uint64_t first, std::uint64_t count, int threads) {
  return parallel_reduce<Moments>((count + chunk - 1) / chunk, threads, [&](std::size_t i) {
    const std::uint64_t begin = first + i * chunk;
    return evaluate(f, dim, sampler, begin, std::min(chunk, first + count - begin));
  });
}

template <Sampler T> void require_finite(const Moments& m, const T& sampler, int dim) {
  if (m.non_finite() == 0) return;
  std::string point;
  for (int d = 0; d < dim; ++d) point += fmt::format("{}{:.17g}", d ? ", " : "", coordinate<double>(sampler, m.witness(), static_cast<std::uint32_t>(d)));
  throw Error(fmt::format("integrate: the integrand is not finite at {} of {} points, the first at u = ({}); it must be finite almost everywhere",
                          m.non_finite(), m.non_finite() + m.count(), point));
}

// Points [first, first + count) of one randomisation, in parallel.
template <Sampler T> Moments replicate(const Integrand& f, int dim, const T& sampler, std::uint64_t first, std::uint64_t count, int threads) {
  const Moments m = evaluate_parallel(f, dim, sampler, first, count, threads);
  require_finite(m, sampler, dim);
  return m;
}

// Independent rounds of doubling size, weighed by the square of their number of points: by the number alone, the early rounds
// would dominate an error that falls faster than N^-1/2; by the measured variances, the mean would be biased.
struct Rounds {
  double weight = 0, value = 0, variance = 0; // of the weighted mean
  std::vector<std::pair<double, double>> all; // mean and its variance
  void add(const Moments& replicates, double points) {
    const double share = points * points / (weight + points * points), v = sqr(replicates.std_error());
    value += share * (replicates.mean() - value);
    variance = sqr(1 - share) * variance + share * share * v;
    weight += points * points;
    all.emplace_back(replicates.mean(), v);
  }
  double chi2() const {
    double sum = 0;
    for (const auto& [mean, v] : all)
      if (v > 0) sum += sqr(mean - value) / v;
    return sum;
  }
};

} // namespace

std::string_view name(Method method) { return method_names[static_cast<std::size_t>(method)]; }

Method method_from(std::string_view word) {
  for (std::size_t i = 0; i < method_names.size(); ++i)
    if (method_names[i] == word) return static_cast<Method>(i);
  throw Error(fmt::format("unknown method '{}'{}; use one of {}", word, did_you_mean(word, method_names), fmt::join(method_names, ", ")));
}

std::string_view name(Stop stop) {
  switch (stop) {
  case Stop::converged: return "converged";
  case Stop::max_calls: return "max_calls";
  case Stop::cancelled: return "cancelled";
  }
  return "";
}

Integral integrate_unit(const Integrand& f, int dim, const IntegrateOptions& o) {
  require(dim >= 1, "integrate: dimension {} must be at least 1", dim);
  require(o.rel_error >= 0 && o.abs_error >= 0, "integrate: tolerances {} (relative) and {} (absolute) must be >= 0", o.rel_error, o.abs_error);
  require(o.confidence > 0 && o.confidence < 1, "integrate: confidence {} must lie in (0, 1)", o.confidence);
  require(o.replicates >= 2, "integrate: {} replicates; an error needs at least 2", o.replicates);

  Integral result;
  result.method = o.method != Method::automatic ? o.method : static_cast<std::uint32_t>(dim) <= Sobol::dimensions ? Method::rqmc : Method::plain;
  const bool plain = result.method == Method::plain;
  const std::uint64_t per_round = plain ? 1 : o.replicates;
  require(o.max_calls >= 2 * per_round, "integrate: max_calls {} is too few; at least {} are needed", o.max_calls, 2 * per_round);

  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  Moments moments;                              // plain: every sample
  std::vector<Moments> sequences(o.replicates); // rqmc: every replicate, extended from round to round
  Rounds rounds;                                // stratified
  for (std::uint64_t count = plain ? 1024 : 64, round = 0;; ++round) {
    const std::uint64_t left = (o.max_calls - result.calls) / per_round;
    const std::uint64_t points = std::min({count, left, std::uint64_t{1} << 32});
    if (plain) {
      const Independent sampler{o.seed};
      moments.merge(evaluate_parallel(f, dim, sampler, result.calls, points, o.threads));
      require_finite(moments, sampler, dim);
      result.estimate = moments.estimate();
    } else if (result.method == Method::rqmc) {
      Moments means;
      for (std::uint32_t r = 0; r < o.replicates; ++r) {
        Moments& sequence = sequences[r];
        sequence.merge(replicate(f, dim, Sobol(hash(o.seed, r)), sequence.count(), points, o.threads));
        means.add(sequence.mean());
      }
      result.estimate = {means.mean(), means.std_error(), static_cast<double>(o.replicates - 1), result.calls + points * per_round};
    } else {
      Moments means;
      for (std::uint32_t r = 0; r < o.replicates; ++r) {
        const Stratified sampler(static_cast<std::uint32_t>(points), hash(o.seed, round, r), static_cast<std::uint32_t>(std::min(dim, 8)));
        means.add(replicate(f, dim, sampler, 0, points, o.threads).mean());
      }
      rounds.add(means, static_cast<double>(points));
      result.estimate = {rounds.value, std::sqrt(rounds.variance), static_cast<double>(o.replicates - 1), result.calls + points * per_round};
    }
    result.calls += points * per_round;
    result.seconds = elapsed();
    if (o.progress) o.progress({result.estimate, result.calls, result.seconds});
    const double error = result.estimate.std_error;
    if (error <= o.abs_error || error <= o.rel_error * std::abs(result.estimate.value)) result.stop = Stop::converged;
    else if ((o.max_calls - result.calls) / per_round < std::min<std::uint64_t>(count, 2)) result.stop = Stop::max_calls;
    else if (o.cancel && o.cancel->load()) result.stop = Stop::cancelled;
    else {
      // An extended sequence doubles when the new points are as many as the old ones.
      if (!(result.method == Method::rqmc && round == 0)) count *= 2;
      continue;
    }
    break;
  }
  result.interval = result.estimate.interval(o.confidence);
  result.chi2 = rounds.chi2();
  result.chi2_dof = rounds.all.empty() ? 0 : static_cast<double>(rounds.all.size() - 1);
  return result;
}

Integral integrate_rqmc(const Integrand& f, int dim, std::uint64_t count, std::uint32_t replicates, std::uint64_t seed, int threads) {
  require(dim >= 1, "integrate_rqmc: dimension {} must be at least 1", dim);
  require(count >= 1 && count <= (std::uint64_t{1} << 32), "integrate_rqmc: {} points; between 1 and 2^32 are possible", count);
  require(replicates >= 2, "integrate_rqmc: {} replicates; an error needs at least 2", replicates);
  const auto start = std::chrono::steady_clock::now();
  Moments means;
  for (std::uint32_t r = 0; r < replicates; ++r) means.add(replicate(f, dim, Sobol(hash(seed, r)), 0, count, threads).mean());
  Integral result;
  result.estimate = means.estimate();
  result.estimate.count = count * replicates;
  result.interval = result.estimate.interval();
  result.calls = count * replicates;
  result.method = Method::rqmc;
  result.stop = Stop::max_calls;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

} // namespace mc

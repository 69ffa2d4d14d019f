#include <mc/core/error.h>
#include <mc/core/parallel.h>
#include <mc/estimate/importance_grid.h>
#include <mc/estimate/integrate.h>
#include <mc/estimate/moments.h>
#include <mc/estimate/point_set.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>

namespace mc {

namespace {

constexpr std::array<std::string_view, 5> method_names = {"auto", "plain", "stratified", "rqmc", "vegas"};
constexpr std::uint64_t chunk = 4096; // points per task: fixed, so sums do not depend on the number of threads
constexpr std::uint64_t block = 256;  // points drawn at once
constexpr std::uint64_t longest = std::uint64_t{1} << 32;

struct Cancelled {};

// What one task adds up: moments of every output, and what the grid learns from.
struct Sums {
  std::vector<Moments> outputs;
  std::vector<double> power;
  void merge(const Sums& other) {
    if (outputs.empty()) *this = other;
    else {
      for (std::size_t k = 0; k < outputs.size(); ++k) outputs[k].merge(other.outputs[k]);
      for (std::size_t i = 0; i < power.size(); ++i) power[i] += other.power[i];
    }
  }
};

// A mean whose variance was estimated with `dof` degrees of freedom.
struct Mean {
  double value = 0, variance = 0, dof = 0;
};
using Means = std::vector<Mean>; // one per output

// Degrees of freedom behind the sum of the variances [Welch47].
double welch(const Mean& a, const Mean& b) {
  const double sum = a.variance + b.variance; // a share of it does not underflow when squared
  return sum > 0 ? 1 / (sqr(a.variance / sum) / a.dof + sqr(b.variance / sum) / b.dof) : a.dof + b.dof;
}

// By how many standard deviations of a normal two independent means differ; nothing where both are exact.
std::optional<double> deviate(const Mean& a, const Mean& b) {
  const double error = std::sqrt(a.variance + b.variance);
  if (!(error > 0) || !std::isfinite(error)) return {};
  constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
  const double t =
      std::abs(a.value - b.value) / std::hypot(error, rounding * std::max(std::abs(a.value), std::abs(b.value)));
  const double tail = cdf(complement(boost::math::students_t(welch(a, b)), t));
  return quantile(complement(boost::math::normal(), std::max(tail, 1e-300)));
}

// One value or several, without a call through another for the one.
struct Integrand {
  const std::function<double(std::span<const double>)>* one = nullptr;
  const VectorIntegrand* several = nullptr;
  void operator()(std::span<const double> u, std::span<double> values) const {
    if (one) values[0] = (*one)(u);
    else (*several)(u, values);
  }
};

// A run of integrate: the integrand, the budget, the clock.
struct Run {
  Integrand f;
  std::size_t outputs;
  int dim;
  const IntegrateOptions& o;
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  std::uint64_t calls = 0;
  std::vector<Means> rounds = {}; // of learning: independent of each other and of the last means
  std::vector<double> chi2 = std::vector<double>(outputs), chi2_dof = std::vector<double>(outputs);

  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); }
  std::uint64_t left() const { return o.max_calls - calls; }

  Sums evaluate(const PointSet& set, std::uint64_t first, std::uint64_t last, const ImportanceGrid* grid,
                std::span<const double> learn) const {
    if (o.cancel && o.cancel->load()) throw Cancelled{};
    const auto d = static_cast<std::size_t>(dim);
    Sums sums{std::vector<Moments>(outputs), std::vector<double>(learn.empty() ? 0 : d * ImportanceGrid::bins)};
    std::vector<double> u(block * d), values(outputs), columns(outputs * block);
    std::vector<std::uint8_t> bins(grid ? d : 0);
    for (; first < last; first += block) {
      const auto n = static_cast<std::size_t>(std::min(block, last - first));
      fill_points(set, first, dim, {u.data(), n * d});
      for (std::size_t i = 0; i < n; ++i) {
        const std::span<double> point(u.data() + i * d, d);
        const double jacobian = grid ? grid->map(point, bins) : 1.0;
        f(point, values);
        double power = 0;
        for (std::size_t k = 0; k < outputs; ++k) {
          const double x = values[k] * jacobian;
          columns[k * block + i] = x;
          if (!learn.empty()) power += sqr(x * learn[k]);
        }
        if (!learn.empty())
          for (std::size_t j = 0; j < d; ++j) sums.power[j * ImportanceGrid::bins + bins[j]] += power;
      }
      for (std::size_t k = 0; k < outputs; ++k) sums.outputs[k].add(std::span(columns).subspan(k * block, n), first);
    }
    return sums;
  }

  // Points [first, first + count) of each set; one result per set.
  std::vector<Sums> evaluate_all(const std::vector<PointSet>& sets, std::uint64_t first, std::uint64_t count,
                                 const ImportanceGrid* grid = nullptr, std::span<const double> learn = {}) {
    const std::uint64_t chunks = (count + chunk - 1) / chunk;
    std::vector<Sums> parts(sets.size() * chunks), results(sets.size());
    parallel_for(parts.size(), o.threads, [&](std::size_t i) {
      const std::uint64_t begin = first + i % chunks * chunk;
      parts[i] = evaluate(sets[i / chunks], begin, std::min(begin + chunk, first + count), grid, learn);
    });
    for (std::size_t i = 0; i < parts.size(); ++i) results[i / chunks].merge(parts[i]);
    for (std::size_t r = 0; r < sets.size(); ++r)
      for (const Moments& m : results[r].outputs) require_finite(m, sets[r], grid);
    calls += count * sets.size();
    return results;
  }

  void require_finite(const Moments& m, const PointSet& set, const ImportanceGrid* grid) const {
    if (m.non_finite() == 0) return;
    std::vector<double> u(static_cast<std::size_t>(dim));
    std::vector<std::uint8_t> bins(u.size());
    fill_points(set, m.witness(), dim, u);
    if (grid) grid->map(u, bins);
    std::string point;
    for (const double x : u) point += fmt::format("{}{:.17g}", point.empty() ? "" : ", ", x);
    throw Error(fmt::format("integrate: the integrand is not finite at {} of {} points, the first at u = ({}); it must "
                            "be finite almost everywhere",
                            m.non_finite(), m.non_finite() + m.count(), point));
  }

  // Whether the bare sequences, those of purpose 0, are interlaced. Under a grid they are not: smooth peaks would gain
  // by it, but integrands that jump would lose.
  bool interlaced() const { return dim <= 2; }
  std::vector<PointSet> sobol_sets(std::uint64_t purpose, std::uint32_t first, std::uint32_t last) const {
    std::vector<PointSet> sets;
    for (std::uint32_t r = first; r < last; ++r) {
      const std::uint64_t seed = hash(o.seed, purpose, r);
      if (purpose == 0 && interlaced()) sets.emplace_back(InterlacedSobol{seed});
      else sets.emplace_back(ScrambledSobol{seed});
    }
    return sets;
  }

  Means means(const std::vector<Sums>& replicates) const {
    Means all;
    for (std::size_t k = 0; k < outputs; ++k) {
      Moments m;
      for (const Sums& s : replicates) m.add(s.outputs[k].mean());
      all.push_back({m.mean(), sqr(m.std_error()), static_cast<double>(replicates.size() - 1)});
    }
    return all;
  }

  void compare(const Means& a, const Means& b) {
    for (std::size_t k = 0; k < outputs; ++k)
      if (const auto z = deviate(a[k], b[k])) chi2[k] += sqr(*z), chi2_dof[k] += 1;
  }

  Estimate estimate(const Mean& m) const { return Estimate::student(m.value, std::sqrt(m.variance), m.dof, calls); }

  bool converged(const Means& all) const {
    for (const Mean& m : all)
      if (const double error = estimate(m).std_error;
          !(error <= o.abs_error || error <= o.rel_error * std::abs(m.value)))
        return false;
    return true;
  }

  void report(const Means& all) const {
    if (o.progress) o.progress({estimate(all.front()), calls, seconds()});
  }
};

// Replicated Sobol' sequences, extended from step to step.
struct Sequences {
  std::uint64_t purpose;
  const ImportanceGrid* grid = nullptr;
  std::uint64_t length = 0;
  std::vector<PointSet> sets = {};
  std::vector<Sums> sums = {};
  std::vector<Means> history = {}; // at each length

  Means extend(Run& run, std::uint64_t to) {
    if (sets.empty()) sets = run.sobol_sets(purpose, 0, run.o.replicates);
    sums.resize(sets.size());
    const std::vector<Sums> more = run.evaluate_all(sets, length, to - length, grid);
    for (std::size_t r = 0; r < sums.size(); ++r) sums[r].merge(more[r]);
    length = to;
    history.push_back(run.means(sums));
    return history.back();
  }

  // More of them, as long as the others.
  Means widen(Run& run, std::uint32_t count) {
    const auto have = static_cast<std::uint32_t>(sets.size());
    const std::vector<PointSet> more = run.sobol_sets(purpose, have, have + count);
    const std::vector<Sums> theirs = run.evaluate_all(more, 0, length, grid);
    sets.insert(sets.end(), more.begin(), more.end());
    sums.insert(sums.end(), theirs.begin(), theirs.end());
    return run.means(sums);
  }
};

// The outcome so far, good for an answer when the run is cancelled.
struct Outcome {
  Means means;
  Method method;
  Stop stop = Stop::max_calls;
};

Outcome plain(Run& run, std::optional<Outcome>& last) {
  Sums total;
  for (std::uint64_t first = 0, count = 1024;; first += count, count = first) {
    count = std::min(count, run.left());
    total.merge(run.evaluate_all({Independent{run.o.seed}}, first, count).front());
    Outcome out{{}, Method::plain};
    for (const Moments& m : total.outputs)
      out.means.push_back({m.mean(), sqr(m.std_error()), static_cast<double>(m.count() - 1)});
    run.report(out.means);
    if (run.converged(out.means)) out.stop = Stop::converged;
    if (out.stop == Stop::converged || run.left() == 0) return out;
    last = out;
  }
}

// Independent rounds, weighed by the square of their number of points: by the number alone, the early rounds would
// dominate an error that falls faster than N^-1/2; by the measured variances, the mean would be biased.
Outcome stratified(Run& run, std::optional<Outcome>& last) {
  Outcome out{Means(run.outputs), Method::stratified};
  double weight = 0;
  for (std::uint64_t points = std::min<std::uint64_t>(64, run.left() / run.o.replicates), round = 0;; ++round) {
    std::vector<PointSet> sets;
    for (std::uint32_t r = 0; r < run.o.replicates; ++r)
      sets.emplace_back(Stratified(static_cast<std::uint32_t>(points), hash(run.o.seed, round, r),
                                   static_cast<std::uint32_t>(std::min(run.dim, 8))));
    const Means now = run.means(run.evaluate_all(sets, 0, points));
    if (round > 0) run.compare(now, out.means);
    const double square = sqr(static_cast<double>(points)), share = square / (weight + square);
    weight += square;
    for (std::size_t k = 0; k < run.outputs; ++k) {
      const Mean& all = out.means[k];
      const Mean a{all.value, sqr(1 - share) * all.variance, std::max(all.dof, 1.0)},
          b{now[k].value, sqr(share) * now[k].variance, now[k].dof};
      out.means[k] = {a.value + share * (b.value - a.value), a.variance + b.variance, welch(a, b)};
    }
    run.report(out.means);
    if (run.converged(out.means)) out.stop = Stop::converged;
    // The last round takes all that is left rather than leave a rest that is too small for another doubling.
    const std::uint64_t left = std::min(run.left() / run.o.replicates, longest - 1);
    if (out.stop == Stop::converged || left < points) return out;
    points = left < 4 * points ? left : 2 * points;
    last = out;
  }
}

// Learns the grid in rounds of growing size, on a 32nd of the calls, or, where those are few, on up to a quarter.
ImportanceGrid learn(Run& run, std::vector<double>& scale) {
  const std::uint64_t least = std::min<std::uint64_t>(run.o.max_calls / 4, 1 << 13);
  const std::uint64_t budget = std::clamp<std::uint64_t>(run.o.max_calls / 32, least, 1 << 18);
  ImportanceGrid grid(run.dim);
  constexpr std::array<std::uint64_t, 5> share = {16, 16, 8, 4, 2};
  const std::uint32_t r = run.o.replicates;
  for (std::size_t k = 0; k < share.size(); ++k) {
    const std::uint64_t points = budget / share[k] / r;
    if (points < 8) continue;
    const std::vector<Sums> sums = run.evaluate_all(run.sobol_sets(2 + k, 0, r), 0, points, &grid, scale);
    run.rounds.push_back(run.means(sums));
    run.report(run.rounds.back());
    Sums total;
    for (const Sums& s : sums) total.merge(s);
    grid.refine(total.power, points * r);
    // Outputs of different size count alike from the second round on.
    for (std::size_t j = 0; j < run.outputs; ++j) {
      const double size = std::hypot(total.outputs[j].mean(), std::sqrt(total.outputs[j].variance()));
      scale[j] = size > 0 && std::isfinite(1 / size) ? 1 / size : 0;
    }
  }
  return grid;
}

// By how much the errors of a will exceed those of b, a mean logarithm, after so many more doublings, if they go on
// falling as they did over the last three.
double advantage(const Sequences& a, const Sequences& b, double doublings) {
  const std::size_t steps = std::min<std::size_t>(std::min(a.history.size(), b.history.size()) - 1, 3);
  const auto error = [](const Sequences& s, std::size_t back, std::size_t k) {
    return std::log(s.history[s.history.size() - 1 - back][k].variance + 1e-300);
  };
  double sum = 0;
  for (std::size_t k = 0; k < a.history.back().size(); ++k) {
    const double now = error(a, 0, k) - error(b, 0, k), then = error(a, steps, k) - error(b, steps, k);
    sum += now + (steps > 0 ? (now - then) * doublings / static_cast<double>(steps) : 0);
  }
  return sum;
}

Outcome sequences(Run& run, Method method, std::optional<Outcome>& last) {
  Outcome out{{}, method == Method::vegas ? Method::vegas : Method::rqmc};
  const auto affordable = [&](const Sequences& s) {
    return std::min(std::bit_floor(s.length + run.left() / run.o.replicates), longest);
  };
  const auto done = [&] {
    run.report(out.means);
    if (run.converged(out.means)) out.stop = Stop::converged;
    last = out;
    return out.stop == Stop::converged;
  };
  const auto next = [](const Sequences& s, std::uint64_t end) {
    return std::max(std::min<std::uint64_t>(64, end), 2 * s.length);
  };
  const auto grow = [&](Sequences& s, std::uint64_t end) {
    for (std::uint64_t to = next(s, end); to <= end; to *= 2) {
      out.means = s.extend(run, to);
      if (done()) return true;
    }
    return false;
  };

  Sequences chosen{.purpose = 0};
  if (method == Method::rqmc && grow(chosen, affordable(chosen))) return out;
  if (method == Method::automatic && grow(chosen, std::max<std::uint64_t>(affordable(chosen) / 16, 1))) return out;
  std::optional<ImportanceGrid> grid;
  if (method != Method::rqmc) {
    std::vector<double> scale(run.outputs, 1.0);
    grid = learn(run, scale);
    Sequences guided{.purpose = 1, .grid = &*grid};
    if (method == Method::vegas) chosen = std::move(guided);
    else {
      const std::uint64_t end = std::min(chosen.length, affordable(guided));
      for (std::uint64_t to = next(guided, end); to <= end; to *= 2) guided.extend(run, to);
      // Interlaced points may start worse and fall faster, so where there are any the two compete at the length they
      // would end with.
      const double doublings =
          run.interlaced() ? std::log2(static_cast<double>(affordable(guided)) / static_cast<double>(end)) : 0;
      if (advantage(chosen, guided, doublings) > 0) {
        out.means = guided.history.back();
        out.method = Method::vegas;
        chosen = std::move(guided);
        if (done()) return out;
      } else run.rounds.clear();
    }
    if (grow(chosen, affordable(chosen))) return out;
  }
  // What is left is too little for twice the length, but may do for more replicates.
  if (const auto more = static_cast<std::uint32_t>(run.left() / chosen.length); more > 0) {
    out.means = chosen.widen(run, more);
    done();
  }
  return out;
}

void require_sane(int outputs, int dim, const IntegrateOptions& o) {
  require(dim >= 1, "integrate: dimension {} must be at least 1", dim);
  require(outputs >= 1, "integrate: {} outputs; at least 1 is needed", outputs);
  require(o.rel_error >= 0 && o.abs_error >= 0 && std::isfinite(o.rel_error) && std::isfinite(o.abs_error),
          "integrate: tolerances {} (relative) and {} (absolute) must be finite and >= 0", o.rel_error, o.abs_error);
  require(o.threads >= 0, "integrate: threads {} must be >= 0; 0 stands for all of the machine's", o.threads);
  require(o.confidence > 0 && o.confidence < 1, "integrate: confidence {} must lie in (0, 1)", o.confidence);
  require(o.replicates >= 2 && o.replicates <= 1u << 20,
          "integrate: {} replicates; between 2 and 2^20 are needed for an error", o.replicates);
}

} // namespace

std::string_view name(Method method) { return method_names[static_cast<std::size_t>(method)]; }

Method method_from(std::string_view word) {
  for (std::size_t i = 0; i < method_names.size(); ++i)
    if (method_names[i] == word) return static_cast<Method>(i);
  throw Error(fmt::format("unknown method '{}'{}; use one of {}", word, did_you_mean(word, method_names),
                          fmt::join(method_names, ", ")));
}

std::string_view name(Stop stop) {
  switch (stop) {
  case Stop::converged: return "converged";
  case Stop::max_calls: return "max_calls";
  case Stop::cancelled: return "cancelled";
  }
  return "";
}

namespace {
VectorIntegral integrate_unit(const Integrand& f, int outputs, int dim, const IntegrateOptions& o) {
  require_sane(outputs, dim, o);
  require(f.one ? *f.one != nullptr : *f.several != nullptr,
          "integrate: the integrand is an empty function; it must be callable");
  const Method method =
      o.method == Method::automatic && static_cast<std::uint32_t>(dim) > Sobol::dimensions ? Method::plain : o.method;
  const std::uint64_t least = method == Method::plain ? 2 : 2 * std::uint64_t{o.replicates};
  require(o.max_calls >= least, "integrate: max_calls {} is too few; at least {} are needed", o.max_calls, least);

  Run run{f, static_cast<std::size_t>(outputs), dim, o};
  std::optional<Outcome> last;
  Outcome outcome;
  try {
    outcome = method == Method::plain        ? plain(run, last)
              : method == Method::stratified ? stratified(run, last)
                                             : sequences(run, method, last);
  } catch (const Cancelled&) {
    require(last.has_value(), "integrate: cancelled before anything was estimated");
    outcome = *last;
    outcome.stop = Stop::cancelled;
  }
  if (outcome.method == Method::vegas)
    for (const Means& round : run.rounds) run.compare(round, outcome.means);
  VectorIntegral result;
  for (std::size_t k = 0; k < run.outputs; ++k) {
    Integral r;
    r.estimate = run.estimate(outcome.means[k]);
    r.interval = r.estimate.interval(o.confidence);
    r.calls = run.calls;
    r.seconds = run.seconds();
    r.method = outcome.method;
    r.stop = outcome.stop;
    r.chi2 = run.chi2[k];
    r.chi2_dof = run.chi2_dof[k];
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

Integral integrate_rqmc(const std::function<double(std::span<const double>)>& f, int dim, std::uint64_t count,
                        std::uint32_t replicates, std::uint64_t seed, int threads) {
  IntegrateOptions o;
  o.replicates = replicates;
  o.seed = seed;
  o.threads = threads;
  o.max_calls = count * replicates;
  require_sane(1, dim, o);
  require(f != nullptr, "integrate: the integrand is an empty function; it must be callable");
  require(count >= 1 && count <= longest, "integrate_rqmc: {} points; between 1 and 2^32 are possible", count);
  Run run{{.one = &f}, 1, dim, o};
  Integral result;
  result.estimate = run.estimate(run.means(run.evaluate_all(run.sobol_sets(0, 0, replicates), 0, count)).front());
  result.interval = result.estimate.interval();
  result.calls = run.calls;
  result.method = Method::rqmc;
  result.stop = Stop::max_calls;
  result.seconds = run.seconds();
  return result;
}

} // namespace mc

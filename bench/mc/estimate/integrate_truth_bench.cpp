/// Coverage of the error bars of integrate() on randomly generated integrands. Prints CSV: for each class and method,
/// the share of runs with a 95 % interval that contains the exact value.
/// Usage: bench_mc_estimate_truth [RUNS [CALLS [REL_ERROR [FIRST_SEED [METHODS [CLASSES [CONSTANT=VALUE...]]]]]]]
/// METHODS and CLASSES are comma-separated lists, or all. CONSTANT is a constant of the error bar.
///   covered : share among the runs with an error bar and consistent rounds.
///   held    : share of all runs that are covered, or have no error bar.
///   unknown : runs without an error bar.
///   infinite: runs that are called of infinite variance, or not integrable.
///   flagged : runs with inconsistent rounds.

#include <integrands/composed_integrands.h>
#include <integrands/random_integrands.h>
#include <terminal/version.h>

#include <mc/core/error.h>
#include <mc/estimate/integrate.h>
#include <mc/estimate/integrate/methods/methods.h>
#include <mc/random/hash.h>

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

struct Shares {
  int runs = 0, flagged = 0, unknown = 0, infinite = 0, below = 0, above = 0, converged = 0;
  double squares = 0, calls = 0, width = 0;

  void add(const mc::Integral& r, double truth) {
    ++runs;
    infinite += r.error_bar == mc::ErrorBar::infinite_variance || r.error_bar == mc::ErrorBar::not_integrable;
    converged += r.stop == mc::StopReason::converged;
    calls += static_cast<double>(r.calls);
    if (!r.consistent) ++flagged;
    else if (!std::isfinite(r.estimate.std_error)) ++unknown;
    else {
      below += r.interval.hi < truth;
      above += r.interval.lo > truth;
      width += r.estimate.std_error / std::abs(truth);
    }
    squares += mc::sqr(r.estimate.value / truth - 1);
  }
  void print(std::string_view name, mc::Method method, double rel_error) const {
    const double n = runs - flagged - unknown;
    fmt::print("{},{},{:g},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.3g},{:.3g},{:.0f}\n", name,
               mc::name(method), rel_error, runs, n > 0 ? (n - below - above) / n : 0, below / std::max(n, 1.0),
               above / std::max(n, 1.0), 1 - double(below + above) / runs, double(unknown) / runs,
               double(infinite) / runs, double(flagged) / runs, double(converged) / runs, std::sqrt(squares / runs),
               width / std::max(n, 1.0), calls / runs);
    std::fflush(stdout);
  }
};

bool chosen(const std::string& list, std::string_view name) {
  return list == "all" || ("," + list + ",").find(fmt::format(",{},", name)) != std::string::npos;
}

// Sets a constant from NAME=VALUE.
void set_constant(mc::detail::Tuning& t, const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  const double value = equals == std::string::npos ? std::nan("") : std::strtod(text.c_str() + equals + 1, nullptr);
  const auto whole = static_cast<std::size_t>(value);
  if (name == "pooled_lengths") t.pooled_lengths = whole;
  else if (name == "rate_lengths") t.rate_lengths = whole;
  else if (name == "max_rate") t.max_rate = value;
  else if (name == "skewness") t.skewness = value;
  else if (name == "tail.share") t.tail.share = value;
  else if (name == "tail.least") t.tail.least = whole;
  else if (name == "tail.most") t.tail.most = whole;
  else if (name == "tail_length") t.tail_length = value;
  else if (name == "tail.shape_deviation") t.tail.shape_deviation = value;
  else if (name == "tail.max_shape") t.tail.max_shape = value;
  else if (name == "infinite_variance") t.infinite_variance = value;
  else if (name == "persistent") t.persistent = whole;
  else if (name == "few_values") t.few_values = whole;
  else if (name == "dominating_share") t.dominating_share = value;
  else throw mc::Error("bench_mc_estimate_truth: unknown constant " + name);
}

} // namespace

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::atoi(argv[1]) : 200;
  const auto calls = static_cast<std::uint64_t>(argc > 2 ? std::strtod(argv[2], nullptr) : 1e5);
  const double rel_error = argc > 3 ? std::strtod(argv[3], nullptr) : 0;
  const std::uint64_t first = argc > 4 ? std::strtoull(argv[4], nullptr, 10) : 1;
  const std::string methods = argc > 5 ? argv[5] : "all", classes = argc > 6 ? argv[6] : "all";
  mc::detail::Tuning tuning;
  for (int i = 7; i < argc; ++i) set_constant(tuning, argv[i]);
  std::string command = "bench_mc_estimate_truth";
  for (int i = 1; i < argc; ++i) command += fmt::format(" {}", argv[i]);
  fmt::print("# command: {}\n# commit: {}\n# seed: {}\n", command, carlo::commit, first);
  fmt::print("class,method,rel_error,runs,covered,low,high,held,unknown,infinite,flagged,converged,rel_rms,rel_std_"
             "error,calls\n");
  std::vector<carlo::IntegrandClass> all = carlo::integrand_classes();
  all.insert(all.end(), carlo::composed_integrand_classes().begin(), carlo::composed_integrand_classes().end());
  for (const carlo::IntegrandClass& kind : all) {
    if (!chosen(classes, kind.name)) continue;
    for (const mc::Method method : {mc::Method::plain, mc::Method::stratified, mc::Method::rqmc, mc::Method::vegas,
                                    mc::Method::tree, mc::Method::automatic}) {
      if (!chosen(methods, mc::name(method))) continue;
      Shares shares;
      for (int i = 0; i < runs; ++i) {
        const std::uint64_t seed = first + static_cast<std::uint64_t>(i);
        const carlo::UnitCubeIntegral e = kind.draw(mc::hash(seed, 1));
        mc::IntegrateOptions o;
        o.method = method;
        o.rel_error = rel_error;
        o.max_calls = calls;
        o.seed = mc::hash(seed, 2);
        o.threads = 1;
        const std::function<double(std::span<const double>)> f = e.f;
        shares.add(mc::detail::integrate({.one = &f}, 1, e.dim, o, tuning).outputs.front(), e.truth);
      }
      shares.print(kind.name, method, rel_error);
    }
  }
}

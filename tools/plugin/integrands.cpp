#include <plugin/integrands.h>
#include <plugin/plugin.h>

#include <mc/core/error.h>
#include <mc/core/text.h>
#include <mc/random/uniform.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>

namespace carlo {

using nlohmann::json;

namespace {

constexpr std::size_t most_dimensions = 64; // load_plugin enforces it

// The box over which an integrand is integrated.
struct Bounds {
  std::vector<double> lo, hi;

  explicit Bounds(const mc_integrand& f)
      : lo(static_cast<std::size_t>(f.dim), 0.0), hi(static_cast<std::size_t>(f.dim), 1.0) {
    if (f.lo) lo.assign(f.lo, f.lo + f.dim);
    if (f.hi) hi.assign(f.hi, f.hi + f.dim);
  }
  double volume() const {
    double product = 1;
    for (std::size_t k = 0; k < lo.size(); ++k) product *= hi[k] - lo[k];
    return product;
  }
  double at(std::size_t k, double u) const { return lo[k] * (1 - u) + hi[k] * u; }
};

// Runs only in the child. The monitor records every call.
UnitCubeIntegral experiment_of(const mc_integrand& f, CallMonitor& monitor) {
  const Bounds bounds(f);
  UnitCubeIntegral e;
  e.name = f.name;
  e.dim = f.dim;
  e.truth = f.has_truth ? f.truth : std::numeric_limits<double>::quiet_NaN();
  e.describe_point = [bounds](UnitCubeIntegral::UnitPoint u) {
    std::string text;
    for (std::size_t k = 0; k < u.size(); ++k) text += fmt::format("{}{:.17g}", k ? ", " : "", bounds.at(k, u[k]));
    return "x = (" + text + ")";
  };
  e.f = [f, bounds, &monitor](UnitCubeIntegral::UnitPoint u) {
    std::array<double, most_dimensions> x;
    for (std::size_t k = 0; k < u.size(); ++k) x[k] = bounds.at(k, u[k]);
    monitor.enter("eval", "x", x.data(), std::min(f.dim, CallMonitor::max_arguments));
    const double value = f.eval(x.data());
    monitor.leave();
    return bounds.volume() * value;
  };
  if (!f.eval_many) return e;
  e.f_batch = [f, bounds, &monitor](UnitCubeIntegral::UnitPoint points, std::span<double> values) {
    std::vector<double> x(points.begin(), points.end());
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = bounds.at(i % bounds.lo.size(), x[i]);
    monitor.enter("eval_many", "x", x.data(), std::min(f.dim, CallMonitor::max_arguments));
    f.eval_many(static_cast<std::int64_t>(values.size()), x.data(), values.data());
    monitor.leave();
    for (double& value : values) value *= bounds.volume();
  };
  return e;
}

// Points to check an integrand before it is measured, and its values at single points.
struct Looked {
  std::vector<double> u, values; ///< one point after another
};

// A slow integrand is evaluated at fewer points, since its measurement runs under the worker's limits anyway.
Looked look_at(const UnitCubeIntegral& e) {
  using Clock = std::chrono::steady_clock;
  constexpr std::size_t most = 22 * 23 / 2; // batches of 1 to 22 points
  const auto dim = static_cast<std::size_t>(e.dim);
  const auto end = Clock::now() + std::chrono::milliseconds(100);
  Looked all;
  while (all.values.size() < most && (all.values.empty() || Clock::now() < end)) {
    for (std::size_t k = 0; k < dim; ++k) all.u.push_back(mc::hash_uniform<double>(79, all.values.size(), k));
    all.values.push_back(e.f(std::span(all.u).last(dim)));
  }
  return all;
}

/// Compares repeated values of an integrand with its first values.
class Repeated {
 public:
  Repeated(const UnitCubeIntegral& e, double volume, const Looked& looked)
      : e_(e), looked_(looked), dim_(static_cast<std::size_t>(e.dim)), volume_(volume) {
    for (const double value : looked.values)
      if (std::isfinite(value)) size_ = std::max(size_, std::abs(value));
  }

  UnitCubeIntegral::UnitPoint points(std::size_t first, std::size_t count) const {
    return std::span(looked_.u).subspan(first * dim_, count * dim_);
  }
  // Values may differ by rounding, for example in a vectorised loop. If both are not finite, the measurement reports
  // it.
  void hold(std::size_t i, double again, const std::string& says, const std::string& remedy) const {
    constexpr double tolerance = 1.5e-8; // about the square root of epsilon
    const double first = looked_.values[i];
    const bool same = first == again || std::abs(again - first) <= tolerance * size_;
    mc::require(same || (std::isnan(first) && std::isnan(again)), "{}: at {} eval says {:.17g} {} {:.17g}; {}", e_.name,
                e_.describe_point(points(i, 1)), first / volume_, says, again / volume_, remedy);
  }

 private:
  const UnitCubeIntegral& e_;
  const Looked& looked_;
  std::size_t dim_;
  double volume_, size_ = 0;
};

// Throws Error if an integrand is no function of x alone, or if eval_many differs from eval.
void require_a_function(const UnitCubeIntegral& e, double volume) {
  const Looked looked = look_at(e);
  const Repeated repeated(e, volume, looked);
  const std::size_t count = looked.values.size();
  for (std::size_t i = count; i-- > 0;)
    repeated.hold(i, e.f(repeated.points(i, 1)), "and then", "it must depend on x alone, on nothing before");
  if (!e.f_batch) return;
  const auto hold_batch = [&](std::size_t first, std::size_t size) {
    std::vector<double> values(size, std::numeric_limits<double>::quiet_NaN()); // a value that is not written stays NaN
    e.f_batch(repeated.points(first, size), values);
    for (std::size_t i = 0; i < size; ++i)
      repeated.hold(first + i, values[i], fmt::format("and eval_many, as point {} of {},", i, size),
                    "values[i] must be eval(x + i dim) (nan: perhaps not written); mend eval_many, or leave it out");
  };
  hold_batch(0, count);
  // Batches of every small size, to test the remainders of vectorised loops.
  for (std::size_t first = 0, size = 1; first < count; first += size++)
    hold_batch(first, std::min(size, count - first));
}

json describe(const std::vector<mc_integrand>& integrands) {
  json all = json::array();
  for (const mc_integrand& f : integrands)
    all.push_back({{"name", f.name},
                   {"title", mc::printable(f.title ? f.title : f.name, 200)},
                   {"dim", f.dim},
                   {"batch", f.eval_many != nullptr},
                   {"truth", f.has_truth ? json(f.truth) : json()}});
  return all;
}

// `is_checked` records whether the integrand has passed the check, which runs only once.
Replicates run(const std::string& path, std::size_t index, const ReplicateTask& task, WorkerOptions worker,
               bool& is_checked) {
  worker.cancel = task.cancel;
  json r;
  try {
    if (!is_checked) call_worker({{"task", "check integrand"}, {"who", path}, {"index", index}}, worker);
    is_checked = true;
    r = call_worker({{"task", "integrand"},
                     {"who", path},
                     {"index", index},
                     {"way", task.method->name},
                     {"file", task.method->points_file},
                     {"one_by_one", task.method->scalar_calls},
                     {"n", task.n},
                     {"seed", task.seed},
                     {"first", task.first},
                     {"count", task.count}},
                    worker);
  } catch (const Interrupted&) {
    const std::vector<double> nothing(task.count, 0.0);
    return {nothing, nothing, nothing};
  }
  return {r["values"], r["calls"], r["seconds"]};
}

} // namespace

json run_integrand_task(const json& request, CallMonitor& monitor) {
  const Plugin plugin = load_plugin(request["who"], monitor);
  if (request["task"] == "describe integrands") return describe(plugin.integrands);
  const mc_integrand& f = plugin.integrands[request["index"].get<std::size_t>()];
  const UnitCubeIntegral e = experiment_of(f, monitor);
  if (request["task"] == "check integrand") {
    require_a_function(e, Bounds(f).volume());
    return {};
  }
  ReplicateTask task;
  const std::string file = request["file"];
  SamplingMethod chosen = file.empty() ? sampling_method(request["way"]) : points_file_method(file);
  chosen.scalar_calls = request["one_by_one"];
  task.method = &chosen;
  task.n = request["n"];
  task.seed = request["seed"];
  task.first = request["first"];
  task.count = request["count"];
  task.threads = 1;
  const Replicates r = run_replicates(e, task);
  return {{"values", r.values}, {"calls", r.calls}, {"seconds", r.seconds}};
}

std::vector<IntegralTarget> plugin_targets(const std::string& path, const std::vector<std::string>& names,
                                           const WorkerOptions& worker) {
  const json all = call_worker({{"task", "describe integrands"}, {"who", path}}, worker);
  mc::require(!all.empty(), "{}: it contains distributions but no integrands; see carlo validate --plugin", path);
  std::vector<std::string> known;
  for (const json& one : all) known.push_back(one["name"]);
  for (const std::string& name : names)
    mc::require(std::find(known.begin(), known.end(), name) != known.end(), "{}: unknown integrand '{}'{}; it holds {}",
                path, name, mc::did_you_mean(name, known), fmt::join(known, ", "));
  std::vector<IntegralTarget> targets;
  for (std::size_t index = 0; index < known.size(); ++index) {
    if (!names.empty() && std::find(names.begin(), names.end(), known[index]) == names.end()) continue;
    const json& one = all[index];
    IntegralTarget t;
    t.integral.name = known[index];
    t.integral.title = one["title"];
    t.integral.source = path;
    t.integral.dim = one["dim"];
    t.integral.truth = one["truth"].is_null() ? std::numeric_limits<double>::quiet_NaN() : one["truth"].get<double>();
    t.integral.min_fit_n = 0;
    t.has_batch = one["batch"];
    t.run = [path, index, worker, is_checked = std::make_shared<bool>(false)](const ReplicateTask& task) {
      return run(path, index, task, worker, *is_checked);
    };
    targets.push_back(std::move(t));
  }
  return targets;
}

} // namespace carlo

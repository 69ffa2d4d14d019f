#include <integrands/box_map.h>
#include <plugin/plugin_integrand.h>
#include <plugin/pure_check.h>

#include <mc/core/error.h>
#include <mc/random/uniform.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace carlo {

namespace {

// The functions of an integrand, with every call recorded.
class Functions {
 public:
  Functions(const mc_integrand& f, CallMonitor& monitor)
      : f_(f), dim_(static_cast<std::size_t>(f.dim)), outputs_(output_count(f)), monitor_(monitor) {}

  void eval_many(std::span<const double> x, std::span<double> values) const {
    enter("eval_many", x.first(dim_));
    f_.eval_many(static_cast<std::int64_t>(values.size() / outputs_), x.data(), values.data());
    monitor_.leave();
  }
  void eval_each(std::span<const double> x, std::span<double> values) const {
    for (std::size_t i = 0; i < values.size() / outputs_; ++i) {
      const std::span<const double> at = x.subspan(i * dim_, dim_);
      enter(f_.eval ? "eval" : "eval_outputs", at);
      if (f_.eval) values[i] = f_.eval(at.data());
      else f_.eval_outputs(at.data(), &values[i * outputs_]);
      monitor_.leave();
    }
  }

 private:
  void enter(const char* function, std::span<const double> at) const {
    monitor_.enter(function, "x", at.data(), std::min(f_.dim, CallMonitor::max_arguments));
  }

  const mc_integrand& f_;
  std::size_t dim_, outputs_;
  CallMonitor& monitor_;
};

BoxMap box_of(const mc_integrand& f) {
  std::vector<VariableBounds> bounds;
  bounds.reserve(static_cast<std::size_t>(f.dim));
  for (int i = 0; i < f.dim; ++i) bounds.push_back({fmt::format("x{}", i), f.lo ? f.lo[i] : 0, f.hi ? f.hi[i] : 1});
  return BoxMap(bounds);
}

bool is_in_box(const mc_integrand& f, std::span<const double> x) {
  for (std::size_t k = 0; k < x.size(); ++k)
    if (!(x[k] >= (f.lo ? f.lo[k] : 0) && x[k] <= (f.hi ? f.hi[k] : 1))) return false;
  return true;
}

std::string text_of(std::span<const double> x) {
  constexpr std::size_t most = 8;
  const std::span<const double> some = x.first(std::min(x.size(), most));
  std::string text;
  for (const double one : some) text += fmt::format("{}{:.17g}", text.empty() ? "" : ", ", one);
  return "(" + text + (x.size() > most ? ", ...)" : ")");
}

EvalPoints eval_of(const mc_integrand& f, CallMonitor& monitor, bool one_by_one) {
  const auto functions = std::make_shared<const Functions>(f, monitor);
  if (f.eval_many && !one_by_one)
    return [functions](std::span<const double> x, std::span<double> values) { functions->eval_many(x, values); };
  return [functions](std::span<const double> x, std::span<double> values) { functions->eval_each(x, values); };
}

// Points of the box, and the factor of their values.
using PointMap = std::function<void(UnitCubeIntegral::UnitPoint u, std::span<double> x, double& factor)>;

PointMap map_to_box(const mc_integrand& f) {
  return
      [box = box_of(f)](UnitCubeIntegral::UnitPoint u, std::span<double> x, double& factor) { factor = box.map(u, x); };
}

PointMap map_by_density(const mc_integrand& f, CallMonitor& monitor) {
  return [&f, &monitor](UnitCubeIntegral::UnitPoint u, std::span<double> x, double& factor) {
    factor = 1 / sample_density(f, monitor, u, x);
    if (is_in_box(f, x)) return;
    factor = 0;
    for (std::size_t k = 0; k < x.size(); ++k) // eval is defined in the box only
      x[k] = std::clamp(x[k], f.lo ? f.lo[k] : 0, f.hi ? f.hi[k] : 1);
  };
}

} // namespace

std::size_t output_count(const mc_integrand& f) { return static_cast<std::size_t>(std::max(f.outputs, 1)); }

std::string output_name(const mc_integrand& f, std::size_t output) {
  if (output_count(f) == 1 && !f.output_names) return f.name;
  return fmt::format("{}.{}", f.name, f.output_names ? f.output_names[output] : fmt::format("{}", output));
}

double truth_of(const mc_integrand& f, std::size_t output) {
  if (!f.has_truth) return std::numeric_limits<double>::quiet_NaN();
  return f.truths ? f.truths[output] : f.truth;
}

int unit_dimension(const mc_integrand& f) { return f.sample && f.uniforms > 0 ? f.uniforms : f.dim; }

void require_density(double density, std::span<const double> u, std::span<const double> x) {
  for (const double one : x)
    mc::require(std::isfinite(one), "the sample at u = {} is {}; it must be finite", text_of(u), text_of(x));
  mc::require(density > 0 && std::isfinite(density),
              "the density is {:.9g} at its own sample x = {}; it must be above 0 and finite there", density,
              text_of(x));
}

double sample_density(const mc_integrand& f, CallMonitor& monitor, std::span<const double> u, std::span<double> x) {
  const auto shown = [](std::span<const double> at) {
    return static_cast<int>(std::min<std::size_t>(at.size(), CallMonitor::max_arguments));
  };
  monitor.enter("sample", "u", u.data(), shown(u));
  f.sample(u.data(), x.data());
  monitor.leave();
  monitor.enter("pdf", "x", x.data(), shown(x));
  const double density = f.pdf(x.data());
  monitor.leave();
  require_density(density, u, x);
  return density;
}

JointIntegrand joint_of(const mc_integrand& f, CallMonitor& monitor, bool one_by_one) {
  const PointMap map = f.sample ? map_by_density(f, monitor) : map_to_box(f);
  JointIntegrand all;
  for (std::size_t k = 0; k < output_count(f); ++k) {
    UnitCubeIntegral e;
    e.name = output_name(f, k);
    e.dim = unit_dimension(f);
    e.truth = truth_of(f, k);
    e.describe_point = [map, dim = static_cast<std::size_t>(f.dim)](UnitCubeIntegral::UnitPoint u) {
      std::vector<double> x(dim);
      double factor = 0;
      map(u, x, factor);
      return "x = " + text_of(x);
    };
    all.outputs.push_back(std::move(e));
  }
  // The buffers are kept: an allocation would cost more than a cheap integrand.
  struct Buffers {
    std::vector<double> x, factors;
  };
  all.f = [map, eval = eval_of(f, monitor, one_by_one), buffers = std::make_shared<Buffers>(),
           dim = static_cast<std::size_t>(f.dim), uniforms = static_cast<std::size_t>(unit_dimension(f)),
           outputs = output_count(f)](UnitCubeIntegral::UnitPoint points, std::span<double> values) {
    const std::size_t count = values.size() / outputs;
    auto& [x, factors] = *buffers;
    x.resize(count * dim);
    factors.resize(count);
    for (std::size_t i = 0; i < count; ++i)
      map(points.subspan(i * uniforms, uniforms), std::span(x).subspan(i * dim, dim), factors[i]);
    eval(x, values);
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = factors[i / outputs] == 0 ? 0 : values[i] * factors[i / outputs];
  };
  return all;
}

void require_pure(const mc_integrand& f, CallMonitor& monitor) {
  const BoxMap box = box_of(f);
  PureCheck check{.name = f.name,
                  .dim = box.dim(),
                  .outputs = output_count(f),
                  .point =
                      [&](std::size_t i, std::span<double> x) {
                        std::vector<double> u(box.dim());
                        for (std::size_t k = 0; k < u.size(); ++k) u[k] = mc::hash_uniform<double>(79, i, k);
                        box.map(u, x);
                      },
                  .each = eval_of(f, monitor, true),
                  .many = {},
                  .many_name = "eval_many",
                  .many_remedy =
                      "values[i] must be eval(x + i dim) (nan: perhaps not written); mend eval_many, or leave it out"};
  if (f.eval_many) check.many = eval_of(f, monitor, false);
  require_pure(check);
}

} // namespace carlo

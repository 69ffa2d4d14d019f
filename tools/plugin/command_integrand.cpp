#include <integrands/box_map.h>
#include <integrands/expression.h>
#include <plugin/command_integrand.h>
#include <plugin/foreign_rows.h>
#include <plugin/paced_program.h>
#include <plugin/pure_check.h>

#include <mc/core/error.h>
#include <mc/core/text.h>
#include <mc/random/uniform.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <memory>
#include <string_view>

namespace carlo {

using nlohmann::json;

namespace {

constexpr std::size_t most_dimensions = 1024, most_outputs = 64;
constexpr std::string_view word = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";

/// The integrand over the unit cube.
class CommandIntegrand {
 public:
  explicit CommandIntegrand(const CommandIntegrandOptions& o)
      : box_(o.bounds), outputs_(std::max<std::size_t>(o.outputs.size(), 1)),
        rows_({{"task", "integrand command"}, {"who", o.command}, {"dim", box_.dim()}, {"outputs", outputs_}},
              {box_.dim(), outputs_}, o.worker) {}

  const BoxMap& box() const { return box_; }
  std::size_t outputs() const { return outputs_; }

  /// The program's values at points x of the box. Returns the CPU seconds of the program.
  double eval(std::span<const double> x, std::span<double> values) { return rows_(x, values); }

  /// Values at points of the unit cube.
  double eval_unit(UnitCubeIntegral::UnitPoint points, std::span<double> values) {
    const std::size_t dim = box_.dim(), count = values.size() / outputs_;
    std::vector<double> x(points.size()), factors(count);
    for (std::size_t i = 0; i < count; ++i)
      factors[i] = box_.map(points.subspan(i * dim, dim), std::span(x).subspan(i * dim, dim));
    const double seconds = eval(x, values);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] *= factors[i / outputs_];
    return seconds;
  }

 private:
  BoxMap box_;
  std::size_t outputs_;
  ForeignRows rows_;
};

void require_valid(const CommandIntegrandOptions& o) {
  mc::require(!o.bounds.empty() && o.bounds.size() <= most_dimensions,
              "--command: {} variables; at most {} are possible", o.bounds.size(), most_dimensions);
  mc::require(o.outputs.size() <= most_outputs, "--command: {} outputs; at most {} are possible", o.outputs.size(),
              most_outputs);
  for (const std::string& name : o.outputs) {
    mc::require(!name.empty() && name.find_first_not_of(word) == name.npos,
                "--command: '{}' names no output: letters, digits and _ do", abbreviate(name));
    mc::require(std::count(o.outputs.begin(), o.outputs.end(), name) == 1, "--command: the output '{}' is named twice",
                name);
  }
}

void require_pure_program(const std::string& name, CommandIntegrand& f) {
  const std::size_t dim = f.box().dim();
  const EvalPoints eval = [&](std::span<const double> x, std::span<double> values) { f.eval(x, values); };
  require_pure({.name = name,
                .dim = dim,
                .outputs = f.outputs(),
                .point =
                    [&](std::size_t i, std::span<double> x) {
                      std::vector<double> u(dim);
                      for (std::size_t k = 0; k < dim; ++k) u[k] = mc::hash_uniform<double>(79, i, k);
                      f.box().map(u, x);
                    },
                .each = eval,
                .many = eval,
                .many_name = "in a question about several points",
                .many_remedy = "the answer at a point must not depend on the other points of a question"});
}

UnitCubeIntegral output_of(const CommandIntegrandOptions& o, const BoxMap& box, std::size_t k) {
  UnitCubeIntegral e;
  e.name = o.outputs.empty() ? abbreviate(o.command) : o.outputs[k];
  e.title = e.name;
  e.source = o.command;
  e.dim = static_cast<int>(box.dim());
  e.truth = std::numeric_limits<double>::quiet_NaN();
  e.min_fit_n = 0;
  e.bounds = box.bounds();
  e.describe_point = [box](UnitCubeIntegral::UnitPoint u) { return box.describe(u); };
  return e;
}

// An output whose evaluations add their CPU seconds to `seconds`.
UnitCubeIntegral timed_output(JointIntegrand all, const std::shared_ptr<CommandIntegrand>& f, std::size_t k,
                              double& seconds) {
  all.f = [f, &seconds](UnitCubeIntegral::UnitPoint points, std::span<double> values) {
    seconds += f->eval_unit(points, values);
  };
  bind_outputs(all);
  return all.outputs[k];
}

struct Started {
  std::shared_ptr<CommandIntegrand> f;
  JointIntegrand all;
};

Started start(const CommandIntegrandOptions& o) {
  require_valid(o);
  Started s{std::make_shared<CommandIntegrand>(o), {}};
  for (std::size_t k = 0; k < s.f->outputs(); ++k) s.all.outputs.push_back(output_of(o, s.f->box(), k));
  require_pure_program(abbreviate(o.command), *s.f);
  s.all.f = [f = s.f](UnitCubeIntegral::UnitPoint points, std::span<double> values) { f->eval_unit(points, values); };
  bind_outputs(s.all);
  return s;
}

} // namespace

JointIntegrand command_integrand(const CommandIntegrandOptions& options) { return start(options).all; }

std::vector<IntegralTarget> command_targets(const CommandIntegrandOptions& options) {
  const Started started = start(options);
  std::vector<IntegralTarget> targets;
  for (std::size_t k = 0; k < started.all.outputs.size(); ++k) {
    IntegralTarget t;
    t.is_foreign = true;
    t.integral = started.all.outputs[k];
    t.run = [started, k](const ReplicateTask& task) {
      return run_replicates([&](double& seconds) { return timed_output(started.all, started.f, k, seconds); }, task);
    };
    targets.push_back(std::move(t));
  }
  return targets;
}

json run_command_integrand_task(const json& request, CallMonitor& monitor) {
  const RowShape shape{request["dim"], request["outputs"]};
  PacedProgram program(request["who"], monitor);
  answer_rows(
      request, monitor, shape,
      [&](std::span<const double> x, std::span<double> values) { program.ask("eval", "x", x, shape.in, values); },
      [&] { return program.cpu_seconds(); });
  return {};
}

} // namespace carlo

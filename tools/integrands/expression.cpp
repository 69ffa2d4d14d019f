/// The only file that includes muParser.

#include <input/sides.h>
#include <integrands/expression.h>

#include <mc/core/error.h>

#include <muParser.h>

#include <atomic>
#include <limits>
#include <memory>

namespace carlo {

namespace {

// A parser with its variables: muParser evaluates in place, so each thread needs its own.
struct Instance {
  mu::Parser parser;
  std::vector<double> values;

  Instance(const std::string& expression, const std::vector<Side>& sides) : values(sides.size()) {
    try {
      parser.ClearConst(); // muParser's own pi and e have 13 digits
      parser.DefineConst("_pi", 3.14159265358979323846);
      parser.DefineConst("_e", 2.71828182845904523536);
      for (std::size_t i = 0; i < sides.size(); ++i) parser.DefineVar(sides[i].name, &values[i]);
      parser.SetExpr(expression);
      parser.Eval();
    } catch (const mu::Parser::exception_type& e) {
      throw mc::Error(fmt::format("expression '{}', position {}: {}", expression, e.GetPos(), e.GetMsg()));
    }
  }
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;
};

} // namespace

Experiment parse_expression(const std::string& expression, const std::string& box) {
  mc::require(!box.empty(), "'{}' is not a name of --list; for an expression give --domain, as in \"x=0:1,y=-1:2\"",
              expression);
  const std::vector<Side> sides = parse_sides(box);
  const Instance checked(expression, sides);
  double volume = 1;
  for (const Side& s : sides) volume *= s.hi - s.lo;
  mc::require(std::isfinite(volume), "--domain: the volume of '{}' overflows", box);

  static std::atomic<std::uint64_t> ids = 0;
  const std::uint64_t id = ++ids;
  Experiment e;
  e.name = expression;
  e.title = expression;
  e.source = box;
  e.dim = static_cast<int>(sides.size());
  e.truth = std::numeric_limits<double>::quiet_NaN();
  e.stratified_slope = e.fit_from = 0;
  e.f = [=](std::span<const double> u) {
    thread_local std::uint64_t owner = 0;
    thread_local std::unique_ptr<Instance> mine;
    if (owner != id) mine = std::make_unique<Instance>(expression, sides), owner = id;
    for (std::size_t i = 0; i < sides.size(); ++i) mine->values[i] = sides[i].lo * (1 - u[i]) + sides[i].hi * u[i];
    return volume * mine->parser.Eval();
  };
  return e;
}

} // namespace carlo

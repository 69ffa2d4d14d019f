/// The only file that includes muParser.

#include <integrands/expression.h>
#include <integrands/sides.h>

#include <mc/core/error.h>

#include <muParser.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <memory>

namespace carlo {

namespace {

double both(double a, double b) { return a != 0 && b != 0; }
double either(double a, double b) { return a != 0 || b != 0; }
double negated(double a) { return a == 0; }
double chosen(double condition, double yes, double no) { return condition != 0 ? yes : no; }

void define_words(mu::Parser& parser) {
  parser.ClearConst(); // muParser's own pi and e have 13 digits
  parser.DefineConst("_pi", 3.14159265358979323846);
  parser.DefineConst("_e", 2.71828182845904523536);
  parser.DefineOprt("and", both, mu::prLAND);
  parser.DefineOprt("or", either, mu::prLOR);
  parser.DefineFun("not", negated);
  parser.DefineFun("if", chosen);
}

// muParser takes "x = 0.5" for an assignment, even within a sum.
void refuse_assignment(std::string_view expression) {
  for (std::size_t at = expression.find('='); at != expression.npos; at = expression.find('=', at + 1)) {
    const bool second = at > 0 && std::string_view("=<>!").find(expression[at - 1]) != std::string_view::npos;
    const bool first = at + 1 < expression.size() && expression[at + 1] == '=';
    mc::require(first || second, "expression '{}', position {}: '=' sets a variable; use == to compare", expression,
                at);
  }
}

// A parser with its variables: muParser evaluates in place, so each thread needs its own.
struct Instance {
  mu::Parser parser;
  std::vector<double> values;

  Instance(const std::string& expression, const std::vector<std::string>& names) : values(names.size()) {
    refuse_assignment(expression);
    try {
      define_words(parser);
      for (std::size_t i = 0; i < names.size(); ++i) parser.DefineVar(names[i], &values[i]);
      parser.SetExpr(expression);
      parser.Eval();
      mc::require(parser.GetNumResults() == 1,
                  "expression '{}' has {} values; give one, or each as an argument of its own", expression,
                  parser.GetNumResults());
    } catch (const mu::Parser::exception_type& e) {
      throw mc::Error(fmt::format("expression '{}', position {}: {}", expression, e.GetPos(), e.GetMsg()));
    }
  }
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;
};

} // namespace

void require_variable(std::string_view name) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_";
  const bool sound = !name.empty() && letters.find(name[0]) != letters.npos &&
                     name.find_first_not_of(std::string(letters) + "0123456789") == name.npos;
  mc::require(sound, "'{}' is no name of a variable: a letter or _, then letters, digits and _", name);
  mu::Parser parser;
  define_words(parser);
  const std::string word(name);
  const bool taken =
      parser.GetFunDef().contains(word) || parser.GetConst().contains(word) || word == "and" || word == "or";
  mc::require(!taken, "'{}' is no name of a variable: it means something in expressions; choose another", name);
}

std::function<double(std::span<const double>)> parse_function(const std::string& expression,
                                                              const std::vector<std::string>& variables) {
  const Instance checked(expression, variables);
  static std::atomic<std::uint64_t> ids = 0;
  const std::uint64_t id = ++ids;
  return [=](std::span<const double> x) {
    // A few, for several that are evaluated in turn.
    thread_local std::array<std::uint64_t, 16> owners{};
    thread_local std::array<std::unique_ptr<Instance>, 16> instances;
    const std::size_t place = id % owners.size();
    std::unique_ptr<Instance>& mine = instances[place];
    if (owners[place] != id) {
      mine = std::make_unique<Instance>(expression, variables);
      owners[place] = id;
    }
    std::copy(x.begin(), x.end(), mine->values.begin());
    return mine->parser.Eval();
  };
}

Experiment parse_expression(const std::string& expression, const std::string& box) {
  mc::require(!box.empty(), "'{}' is not a name of --list; for an expression give --domain, as in \"x=0:1,y=-1:2\"",
              expression);
  const std::vector<Side> sides = parse_sides(box);
  mc::require(sides.size() <= 32, "--domain: {} variables; at most 32 are possible", sides.size());
  std::vector<std::string> names;
  double volume = 1;
  for (const Side& s : sides) {
    names.push_back(s.name);
    if (s.is_finite()) volume *= s.hi - s.lo;
  }
  mc::require(std::isfinite(volume), "--domain: the volume of '{}' overflows", box);

  Experiment e;
  e.name = expression;
  e.title = expression;
  e.source = box;
  e.dim = static_cast<int>(sides.size());
  e.truth = std::numeric_limits<double>::quiet_NaN();
  e.fit_from = 0;
  e.f = [sides, volume, f = parse_function(expression, names)](std::span<const double> u) {
    std::array<double, 32> x;
    double scale = volume;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const Placed at = place_on(sides[i], u[i]);
      x[i] = at.x;
      if (sides[i].is_finite()) continue;
      if (std::isinf(at.x)) return 0.0; // an end at infinity: no point of the domain
      scale *= at.slope;
    }
    return scale * f(std::span(x).first(sides.size()));
  };
  e.place = [sides](std::span<const double> u) {
    std::string text;
    for (std::size_t i = 0; i < sides.size(); ++i)
      text += fmt::format("{}{} = {:.9g}", i > 0 ? ", " : "", sides[i].name, place_on(sides[i], u[i]).x);
    return text;
  };
  return e;
}

} // namespace carlo

#pragma once
/// Integrals of expressions over a domain with bounds that may depend on other variables.

#include <integrands/complex_expression.h>
#include <integrands/expression.h>
#include <integrands/unit_cube_integral.h>
#include <integrands/variable_bounds.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace carlo {

/// Domain and names for expressions, as options give them.
struct ExpressionContext {
  std::string domain = {};                  ///< "x=0:1,y=0:x,z=normal,k=1..6", see split_domain
  std::vector<std::string> conditions = {}; ///< "x*x+y*y<1": elsewhere the integrand counts as 0 and is not evaluated
  std::vector<std::string> lets = {};       ///< "r=sqrt(x*x+y*y)"
  std::vector<std::string> settings = {};   ///< "a=2"
  std::optional<double> nan = {};           ///< replaces values that are not a number
  bool operator==(const ExpressionContext&) const = default;
};

/// A text "name=value" in two parts, trimmed. Throws Error that names the option for any other text.
std::pair<std::string, std::string> split_definition(std::string_view option, std::string_view text);

/// Integrals of expressions over one domain, as integrals over the unit cube. An expression has one output, or two if
/// it is complex.
///   variables   : in their order. Bounds may use settings, and variables and lets that need no later variable.
///   interval    : see map_to_bounds.
///   normal      : the measure is the normal distribution.
///   integers    : summed at every point if both ends are finite and, where they are constant, at most `summed_terms`
///                 terms lie between them. Otherwise a coordinate of the cube selects one; see map_to_integers.
///   conditions  : each is tested as soon as its variables have values.
class ExpressionIntegral {
 public:
  static constexpr int summed_terms = 1000;

  /// throws : mc::Error for text that does not parse, names that collide or are unknown, and bounds that are not
  ///          ordered, with the option and a remedy.
  ExpressionIntegral(const ExpressionContext& context, const std::vector<std::string>& expressions);

  /// One value of an expression.
  enum class Part { whole, real, imaginary };
  struct Output {
    std::size_t text; ///< index of its expression
    Part part;
    std::size_t value; ///< index in the program; of a complex expression in complex_
  };
  const std::vector<Output>& outputs() const { return outputs_; }
  int dim() const { return std::max(coordinates_, 1); }
  /// Whether the integral is a finite sum, the same at every point of the cube.
  bool is_exact_sum() const { return coordinates_ == 0; }
  bool has_finite_bounds() const;
  /// The measure of the domain, which is the factor between values and integrand everywhere.
  ///   throws : mc::Error that begins with `option` for another domain than a finite box with normal variables.
  double uniform_measure(std::string_view option) const;
  /// Whether a variable, a let or a setting has this name.
  bool has_name(std::string_view name) const;
  /// The variable of each coordinate of the cube. One without constant bounds has the bounds NaN.
  std::vector<VariableBounds> coordinate_bounds() const;
  /// The value of a variable for a coordinate of the cube; nothing where its parameters are not constant, or where it
  /// is summed.
  std::optional<double> value_at(std::string_view variable, double u) const;

  /// Adds an expression that visit() can evaluate. Returns its index.
  std::size_t add_expression(const std::string& text) { return program_.add_expression(text); }
  /// Calls f(weight, frame) for every term at the point u: once, or for each tuple of summed integers. Not called where
  /// a condition fails.
  ///   throws : mc::Error where a bound is not a number or the bounds are not ordered.
  template <class F> void visit(std::span<const double> u, F&& f) const {
    const ExpressionProgram::Frame frame = program_.frame();
    walk(0, u, constant_measure_, frame, f);
  }
  /// The value of an output in a term; see ExpressionContext::nan.
  double value(const ExpressionProgram::Frame& frame, std::size_t output) const {
    const Output& o = outputs_[output];
    const double y = o.part == Part::whole ? frame.evaluate(o.value) : part_of(complex_[o.value].evaluate(frame), o);
    return y == y || !nan_ ? y : replaced();
  }
  /// The integrands at the point u, one for each output.
  void evaluate(std::span<const double> u, std::span<double> values) const;
  /// The integrand of one output.
  double evaluate(std::span<const double> u, std::size_t output) const;

  /// "x = 0.5, k = 3": the first term at u whose value is not finite, otherwise the first term.
  std::string describe_point(std::span<const double> u) const;
  /// Whether a value underflows although the value of its expression does not.
  bool underflows_at(std::span<const double> u, std::size_t output) const;

  /// How many values were replaced since the last call.
  std::uint64_t take_replaced() const { return replaced_->exchange(0); }

 private:
  enum class StepKind { interval, normal, coordinate_integer, summed_integers, let, condition };
  /// A number, or an expression that computes it.
  struct Parameter {
    static constexpr std::size_t constant = std::numeric_limits<std::size_t>::max();
    double value = 0;
    std::size_t expression = constant;
    bool is_constant() const { return expression == constant; }
    double in(const ExpressionProgram::Frame& frame) const {
      return is_constant() ? value : frame.evaluate(expression);
    }
  };
  struct Step {
    StepKind kind;
    std::size_t value;      ///< index of the value that it sets
    std::size_t expression; ///< of a let or a condition
    Parameter first, second;
    std::size_t coordinate; ///< of the cube
    std::size_t variable;   ///< index in variables_; of a let or a condition the number of those before it
    bool is_box_side;       ///< an interval with constant finite bounds
    bool is_constant() const { return first.is_constant() && second.is_constant(); }
  };
  struct Builder;

  template <class F>
  void walk(std::size_t from, std::span<const double> u, double weight, const ExpressionProgram::Frame& frame,
            F&& f) const {
    for (std::size_t i = from; i < steps_.size(); ++i) {
      const Step& step = steps_[i];
      if (step.kind == StepKind::summed_integers) {
        const auto [lo, terms] = summed_range(step, frame);
        for (int k = 0; k < terms; ++k) {
          frame[step.value] = lo + k;
          walk(i + 1, u, weight, frame, f);
        }
        return;
      }
      if (step.is_box_side) { // as map_to_bounds; the factor is part of constant_measure_
        frame[step.value] = between(step.first.value, step.second.value, u[step.coordinate]);
        continue;
      }
      const double factor = take(step, u, frame);
      if (factor == 0) return;
      weight *= factor;
    }
    f(weight, frame);
  }
  /// Sets the value of a step. Returns the factor of the weight; 0 where the term has no part in the integral.
  double take(const Step& step, std::span<const double> u, const ExpressionProgram::Frame& frame) const;
  /// The first number of a sum, and how many there are.
  std::pair<double, int> summed_range(const Step& step, const ExpressionProgram::Frame& frame) const;
  /// "--domain: 'y=0:x' <complaint> at x = 2; <remedy>".
  [[noreturn]] void refuse(const Step& step, const ExpressionProgram::Frame& frame, std::string_view complaint,
                           std::string_view remedy) const;
  /// "x = 0.5, y = 1": the first variables.
  std::string describe(const ExpressionProgram::Frame& frame, std::size_t variables) const;
  double part_of(std::complex<double> z, const Output& output) const;
  double replaced() const;
  void add_output(std::size_t index, const std::string& text);

  ExpressionProgram program_;
  std::vector<VariableText> variables_;
  std::vector<std::size_t> variable_values_; ///< indices of their values
  std::vector<std::string> names_;           ///< of variables, lets and settings
  std::vector<Step> steps_;
  std::vector<Output> outputs_;
  std::vector<ComplexExpression> complex_;
  double constant_measure_ = 1; ///< product of the lengths of the finite constant intervals
  int coordinates_ = 0;
  std::optional<double> nan_;
  std::shared_ptr<std::atomic<std::uint64_t>> replaced_;
};

/// The outputs as integrands. `texts` are the expressions.
std::vector<UnitCubeIntegral> integrands_of(const std::shared_ptr<const ExpressionIntegral>& integral,
                                            const std::vector<std::string>& texts, const std::string& domain);

/// The integral of an expression such as "exp(-x*x)*cos(y)" over the domain "x=0:1,y=-1:2", as an integral over the
/// unit cube. Its truth is NaN, since it is unknown.
///   throws : mc::Error as ExpressionIntegral, for a complex expression, and where there is no domain.
UnitCubeIntegral parse_expression(const std::string& expression, const ExpressionContext& context);

} // namespace carlo

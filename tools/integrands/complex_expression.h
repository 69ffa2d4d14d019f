#pragma once
/// Expressions with the imaginary unit i.

#include <integrands/expression.h>

#include <complex>
#include <string>
#include <vector>

namespace carlo {

/// Whether an expression uses the name i.
bool uses_imaginary_unit(std::string_view expression);

/// A complex expression: parts without i are real expressions, see parse_function. Parts with i may use + - * / ^ and
/// parentheses, exp, log, ln, sqrt, the trigonometric and hyperbolic functions with their inverses, abs, arg, conj, re
/// and im. Roots, logarithms and powers have their principal values.
class ComplexExpression {
 public:
  /// Adds the real parts to the program, which must outlive evaluations.
  ///   throws : mc::Error for an expression that does not parse, with the position.
  ComplexExpression(const std::string& text, ExpressionProgram& program);

  /// Whether the value is real wherever it is defined, as that of abs(exp(i*x))^2. A function of real values counts:
  /// where it is complex, as the square root of a negative value, it is undefined as in real expressions.
  bool is_real_valued() const { return is_real_valued_; }
  std::complex<double> evaluate(const ExpressionProgram::Frame& frame) const { return evaluate(frame, root_); }

 private:
  using Value = std::complex<double>;
  enum class Kind { real, unit, sum, difference, product, quotient, power, negation, function };
  struct Node {
    Kind kind;
    std::size_t left = 0, right = 0; ///< operands; of a real part the expression
    Value (*function)(Value) = nullptr;
  };
  struct Parser;

  Value evaluate(const ExpressionProgram::Frame& frame, std::size_t node) const;
  Value power(const ExpressionProgram::Frame& frame, const Node& node) const;

  std::vector<Node> nodes_;
  std::size_t root_ = 0;
  bool is_real_valued_ = false;
};

} // namespace carlo

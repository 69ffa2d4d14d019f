#pragma once
/// Expressions of the command line.

#include <cctype>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// About 60 bytes of a text around a position in it, for messages.
std::string abbreviate(std::string_view text, std::size_t at = 0);

/// Accepts a variable name: a letter or _, then letters, digits and _, and not a word that expressions reserve.
///   throws : mc::Error "'3x' is no name of a variable: ...".
void require_variable_name(std::string_view name);

/// An expression as a function of the variables' values, in order. It can be called from several threads at once. It
/// supports the functions and operators of muParser, the constants _pi and _e, "a and b", "a or b", not(a),
/// if(condition, yes, no) and floor(a); assignments are errors.
///   throws : mc::Error for an expression that does not parse, with the position and, if possible, the correct form.
std::function<double(std::span<const double>)> parse_function(const std::string& expression,
                                                              const std::vector<std::string>& variables);

/// Whether a character can be part of a name.
inline bool in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

/// The value of a number or a constant expression. Throws mc::Error as parse_function.
double parse_number(const std::string& text);

/// The names in an expression that stand for values, each once: all words but functions, operators and constants. The
/// expression need not parse.
std::vector<std::string> variables_of(std::string_view expression);

/// Expressions over named values, which are evaluated one at a time. An expression may use the values that were added
/// before it. Each thread has its own values.
class ExpressionProgram {
  struct Source;
  struct State;

 public:
  ExpressionProgram();

  /// Adds a value with the content that each thread starts from. Returns its index.
  std::size_t add_value(const std::string& name, double initial = 0);
  /// Adds an expression; see parse_function. Returns its index.
  ///   throws : mc::Error for an expression that does not parse.
  std::size_t add_expression(const std::string& text);

  /// The values of the calling thread. Valid until the program changes.
  class Frame {
   public:
    explicit Frame(State& state);
    double& operator[](std::size_t value) const { return values_[value]; }
    double evaluate(std::size_t expression) const;

   private:
    State* state_;
    double* values_;
  };
  Frame frame() const;

 private:
  std::shared_ptr<Source> source_;
};

} // namespace carlo

#include <integrands/complex_expression.h>

#include <mc/core/error.h>
#include <mc/core/text.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

namespace carlo {

namespace {

using Value = std::complex<double>;

struct ComplexFunction {
  const char* name;
  Value (*f)(Value);
  bool is_real_valued = false;
};
constexpr ComplexFunction functions[] = {
    {"exp", [](Value z) { return std::exp(z); }},
    {"log", [](Value z) { return std::log(z); }},
    {"ln", [](Value z) { return std::log(z); }},
    {"sqrt", [](Value z) { return std::sqrt(z); }},
    {"sin", [](Value z) { return std::sin(z); }},
    {"cos", [](Value z) { return std::cos(z); }},
    {"tan", [](Value z) { return std::tan(z); }},
    {"asin", [](Value z) { return std::asin(z); }},
    {"acos", [](Value z) { return std::acos(z); }},
    {"atan", [](Value z) { return std::atan(z); }},
    {"sinh", [](Value z) { return std::sinh(z); }},
    {"cosh", [](Value z) { return std::cosh(z); }},
    {"tanh", [](Value z) { return std::tanh(z); }},
    {"asinh", [](Value z) { return std::asinh(z); }},
    {"acosh", [](Value z) { return std::acosh(z); }},
    {"atanh", [](Value z) { return std::atanh(z); }},
    {"abs", [](Value z) { return Value(std::abs(z)); }, true},
    {"arg", [](Value z) { return Value(std::arg(z)); }, true},
    {"conj", [](Value z) { return std::conj(z); }},
    {"re", [](Value z) { return Value(z.real()); }, true},
    {"im", [](Value z) { return Value(z.imag()); }, true},
};

} // namespace

bool uses_imaginary_unit(std::string_view expression) {
  const std::vector<std::string> names = variables_of(expression);
  return std::find(names.begin(), names.end(), "i") != names.end();
}

// Recursive descent. A part without i stays text, and joins its real neighbours.
struct ComplexExpression::Parser {
  struct Part {
    std::size_t begin, end;          // in the text
    std::optional<std::size_t> node; // none for a part without i
    bool is_real_valued = true;
  };

  const std::string& text;
  ExpressionProgram& program;
  std::vector<Node>& nodes;
  std::size_t at = 0;

  template <class... Args> [[noreturn]] void refuse(fmt::format_string<Args...> complaint, Args&&... args) const {
    throw mc::Error(fmt::format("expression '{}', position {}: {}", abbreviate(text, at), at,
                                fmt::format(complaint, std::forward<Args>(args)...)));
  }
  char next() {
    while (at < text.size() && std::isspace(static_cast<unsigned char>(text[at]))) ++at;
    return at < text.size() ? text[at] : '\0';
  }
  std::size_t add(Node node) {
    nodes.push_back(node);
    return nodes.size() - 1;
  }
  std::size_t node_of(const Part& part) {
    if (part.node) return *part.node;
    return add({Kind::real, program.add_expression(text.substr(part.begin, part.end - part.begin))});
  }
  Part join(Kind kind, const Part& left, const Part& right) {
    Part both{left.begin, right.end, {}, left.is_real_valued && right.is_real_valued};
    if (!left.node && !right.node) return both;
    const std::size_t l = node_of(left), r = node_of(right);
    both.node = add({kind, l, r});
    return both;
  }

  Part sum() {
    Part left = product();
    for (char c = next(); c == '+' || c == '-'; c = next()) {
      ++at;
      left = join(c == '+' ? Kind::sum : Kind::difference, left, product());
    }
    return left;
  }
  Part product() {
    Part left = signed_power();
    for (char c = next(); c == '*' || c == '/'; c = next()) {
      ++at;
      left = join(c == '*' ? Kind::product : Kind::quotient, left, signed_power());
    }
    return left;
  }
  Part signed_power() {
    const char c = next();
    if (c != '-' && c != '+') return power();
    const std::size_t begin = at++;
    Part part = signed_power();
    part.begin = begin;
    if (part.node && c == '-') part.node = add({Kind::negation, *part.node});
    return part;
  }
  Part power() {
    const Part base = value();
    if (next() != '^') return base;
    ++at;
    return join(Kind::power, base, signed_power());
  }
  Part value() {
    const char c = next();
    const std::size_t begin = at;
    if (c == '(') return parenthesis(begin, nullptr);
    if (std::isdigit(static_cast<unsigned char>(c)) || c == '.') return number();
    while (at < text.size() && in_word(text[at])) ++at;
    const std::string word = text.substr(begin, at - begin);
    if (word.empty()) refuse("a value is missing");
    if (word == "i") return {begin, at, add({Kind::unit}), false};
    if (next() != '(') return {begin, begin + word.size(), {}};
    return parenthesis(begin, &word);
  }
  Part number() {
    const std::size_t begin = at;
    while (at < text.size() && (in_word(text[at]) || text[at] == '.')) {
      const bool exponent = text[at] == 'e' || text[at] == 'E';
      ++at;
      if (exponent && at < text.size() && (text[at] == '-' || text[at] == '+')) ++at;
    }
    const std::string_view digits = std::string_view(text).substr(begin, at - begin);
    at = mc::parse_double(digits) ? at : begin;
    if (at == begin) refuse("'{}' is not a number; a product is 2*i", abbreviate(digits));
    return {begin, at, {}};
  }
  // What stands in parentheses, or the function of it. `at` is the opening parenthesis.
  Part parenthesis(std::size_t begin, const std::string* function) {
    const std::size_t open = at;
    int depth = 0;
    std::size_t close = open;
    for (; close < text.size(); ++close) {
      if (text[close] == '(') ++depth;
      if (text[close] == ')' && --depth == 0) break;
    }
    if (close == text.size()) refuse("a parenthesis is not closed");
    if (!uses_imaginary_unit(std::string_view(text).substr(open, close - open))) {
      at = close + 1;
      return {begin, at, {}};
    }
    ++at;
    Part part = sum();
    if (next() != ')' || at != close) refuse("'{}' cannot follow a complex value", text[at]);
    ++at;
    if (function) {
      const auto found = std::find_if(std::begin(functions), std::end(functions),
                                      [&](const ComplexFunction& f) { return f.name == *function; });
      std::vector<std::string_view> names;
      for (const ComplexFunction& f : functions) names.emplace_back(f.name);
      at = begin;
      if (found == std::end(functions))
        refuse("{} takes no complex value{}; use one of {}", *function, mc::did_you_mean(*function, names),
               fmt::join(names, ", "));
      at = close + 1;
      part.node = add({Kind::function, node_of(part), 0, found->f});
      part.is_real_valued = part.is_real_valued || found->is_real_valued;
    }
    return {begin, at, part.node, part.is_real_valued};
  }
};

ComplexExpression::ComplexExpression(const std::string& text, ExpressionProgram& program) {
  Parser parser{text, program, nodes_};
  const Parser::Part whole = parser.sum();
  if (const char c = parser.next()) parser.refuse("'{}' cannot follow a complex value", c);
  root_ = parser.node_of(whole);
  is_real_valued_ = whole.is_real_valued;
}

ComplexExpression::Value ComplexExpression::power(const ExpressionProgram::Frame& frame, const Node& node) const {
  const Value base = evaluate(frame, node.left), exponent = evaluate(frame, node.right);
  const double n = exponent.real();
  if (exponent.imag() != 0 || n != std::floor(n) || std::abs(n) > 1024) return std::pow(base, exponent);
  Value result = 1, square = base; // exact for i^2
  for (int rest = static_cast<int>(std::abs(n)); rest > 0; rest /= 2) {
    if (rest % 2) result *= square;
    square *= square;
  }
  return n < 0 ? 1.0 / result : result;
}

ComplexExpression::Value ComplexExpression::evaluate(const ExpressionProgram::Frame& frame, std::size_t index) const {
  const Node& node = nodes_[index];
  switch (node.kind) {
  case Kind::real: return frame.evaluate(node.left);
  case Kind::unit: return {0, 1};
  case Kind::sum: return evaluate(frame, node.left) + evaluate(frame, node.right);
  case Kind::difference: return evaluate(frame, node.left) - evaluate(frame, node.right);
  case Kind::product: return evaluate(frame, node.left) * evaluate(frame, node.right);
  case Kind::quotient: return evaluate(frame, node.left) / evaluate(frame, node.right);
  case Kind::power: return power(frame, node);
  case Kind::negation: return -evaluate(frame, node.left);
  case Kind::function: return node.function(evaluate(frame, node.left));
  }
  return {};
}

} // namespace carlo

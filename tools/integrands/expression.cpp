/// This is the only file that includes muParser.

#include <integrands/expression.h>
#include <integrands/special_functions.h>

#include <mc/core/error.h>
#include <mc/core/text.h>

#include <muParser.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>
#include <unordered_map>

namespace carlo {

namespace {

double both(double a, double b) { return a != 0 && b != 0; }
double either(double a, double b) { return a != 0 || b != 0; }
double negated(double a) { return a == 0; }
double whole_below(double a) { return std::floor(a); }
double chosen(double condition, double yes, double no) { return condition != 0 ? yes : no; }

void define_words(mu::Parser& parser) {
  parser.ClearConst(); // muParser's own pi and e have only 13 digits
  parser.DefineConst("_pi", 3.14159265358979323846);
  parser.DefineConst("_e", 2.71828182845904523536);
  parser.DefineOprt("and", both, mu::prLAND);
  parser.DefineOprt("or", either, mu::prLOR);
  parser.DefineFun("not", negated);
  parser.DefineFun("if", chosen);
  parser.DefineFun("floor", whole_below);
}

// Special functions are no reserved words: a variable may be called gamma, since gamma(x) is told from gamma by its
// parenthesis.
void define_special_functions(mu::Parser& parser) {
  for (const NamedFunction& f : special_functions())
    std::visit([&](auto* function) { parser.DefineFun(f.name, function); }, f.f);
}

// Notation of other languages, and the equivalent in expressions.
struct Habit {
  std::string_view text, remedy;
};
constexpr Habit habits[] = {
    {"\xe2\x88\x92", "this is the minus of typeset text; type -"},
    {"\xc3\x97", "a product is x*y"},
    {"\xc2\xb7", "a product is x*y"},
    {"\xc2\xb2", "a square is x^2"},
    {"\xcf\x80", "pi is _pi"},
    {"**", "a power is x^2, not x**2"},
    {"%", "there is no %; the rest of x by 2 is x - 2*floor(x/2)"},
    {"pi", "pi is _pi"},
    {"e", "e is _e; a power of it is exp(x)"},
    {"pow", "a power is x^2, not pow(x, 2)"},
};

// The correct notation for the text at which the parser failed; empty if unknown.
std::string_view remedy(std::string_view expression, std::size_t at, const std::vector<std::string>& names) {
  const std::size_t last = at > 0 ? expression.find_last_not_of(" \t", at - 1) : expression.npos;
  const std::string_view before = expression.substr(0, last + 1); // also for no text: npos + 1 is 0
  std::string_view here = expression.substr(at);
  double number;
  if (std::from_chars(here.data(), here.data() + here.size(), number).ec == std::errc::result_out_of_range)
    return "a number must be at most 1.7e308";
  const auto in_value = [](char c) { return in_word(c) || c == '.'; };
  const bool two_values = !before.empty() && !here.empty() && (in_value(before.back()) || before.back() == ')') &&
                          (in_value(here[0]) || here[0] == '(');
  if (here.starts_with('*') && before.ends_with('*')) here = expression.substr(before.size() - 1);
  const std::size_t digits = std::min(here.find_first_not_of("0123456789."), here.size());
  here.remove_prefix(digits); // the parser reads 2pi as one word
  const bool glued = digits > 0 && !here.empty() && in_word(here[0]);
  for (const Habit& h : habits)
    if (here.starts_with(h.text) && std::find(names.begin(), names.end(), h.text) == names.end() &&
        !(in_word(h.text[0]) && here.size() > h.text.size() && in_word(here[h.text.size()])))
      return h.remedy;
  return two_values || glued ? "an operator is missing; a product is 2*x" : "";
}

// The words of a text with their positions. A word that follows a digit belongs to a number, such as 1e5.
std::vector<std::size_t> word_starts(std::string_view text) {
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (in_word(text[i]) && !std::isdigit(static_cast<unsigned char>(text[i])) &&
        (i == 0 || !(in_word(text[i - 1]) || text[i - 1] == '.')))
      starts.push_back(i);
  return starts;
}

std::string_view word_at(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && in_word(text[end])) ++end;
  return text.substr(at, end - at);
}

bool is_called(std::string_view text, std::size_t at) {
  const std::size_t next = text.find_first_not_of(" \t", at + word_at(text, at).size());
  return next != text.npos && text[next] == '(';
}

// "unknown names 'expo', 'y'; did you mean 'exp'?; use one of ...": all unknown functions, or all unknown variables, of
// the expression, whichever stands at this position. Empty if no unknown name stands there.
std::string unknown_name(std::string_view expression, std::size_t at, const std::vector<std::string>& names) {
  const std::vector<std::size_t> starts = word_starts(expression);
  if (std::find(starts.begin(), starts.end(), at) == starts.end()) return {};
  mu::Parser parser;
  define_words(parser);
  define_special_functions(parser);
  const bool called = is_called(expression, at);
  std::vector<std::string> known;
  if (called)
    for (const auto& function : parser.GetFunDef()) known.push_back(function.first);
  else {
    known = names;
    for (const auto& constant : parser.GetConst()) known.push_back(constant.first);
  }
  const auto is_known = [&](std::string_view word) {
    return word == "and" || word == "or" || std::find(known.begin(), known.end(), word) != known.end();
  };
  std::vector<std::string> unknown;
  for (const std::size_t start : starts) {
    const std::string word(word_at(expression, start));
    if (is_called(expression, start) == called && !is_known(word) &&
        std::find(unknown.begin(), unknown.end(), word) == unknown.end())
      unknown.push_back(word);
  }
  if (is_known(word_at(expression, at))) return {};
  const std::string_view here = word_at(expression, at);
  if (parser.GetFunDef().contains(std::string(here)))
    return fmt::format("{0} is a function; its argument stands in parentheses: {0}(x)", here);
  std::vector<std::string> everything = known;
  for (const auto& function : parser.GetFunDef()) everything.push_back(function.first);
  for (std::string& word : unknown) word = abbreviate(word);
  return fmt::format("unknown {}{} '{}'{}; use one of {}", called ? "function" : "name", unknown.size() > 1 ? "s" : "",
                     fmt::join(unknown, "', '"), mc::did_you_mean(here, everything), fmt::join(known, ", "));
}

mc::Error refusal(const std::string& expression, const mu::Parser::exception_type& e,
                  const std::vector<std::string>& names) {
  if (e.GetCode() == mu::ecEXPRESSION_TOO_LONG)
    return mc::Error(fmt::format("expression '{}' is too long: {} bytes; at most {} are read", abbreviate(expression),
                                 expression.size(), int{mu::MaxLenExpression} - 1));
  if (e.GetPos() < 0) return mc::Error(fmt::format("expression '{}': {}", abbreviate(expression), e.GetMsg()));
  const std::size_t at = std::min(static_cast<std::size_t>(e.GetPos()), expression.size());
  std::string complaint(remedy(expression, at, names));
  if (complaint.empty()) complaint = unknown_name(expression, at, names);
  if (complaint.empty()) {
    complaint = e.GetMsg();
    for (const char* place : {" found at position", " at expression position", " at position"})
      complaint.resize(std::min(complaint.find(place), complaint.size()));
    complaint = abbreviate(complaint);
  }
  return mc::Error(fmt::format("expression '{}', position {}: {}", abbreviate(expression, at), at, complaint));
}

// muParser reads "x = 0.5" as an assignment, even within a sum.
void refuse_assignment(std::string_view expression) {
  for (std::size_t at = expression.find('='); at != expression.npos; at = expression.find('=', at + 1)) {
    const bool second = at > 0 && std::string_view("=<>!").find(expression[at - 1]) != std::string_view::npos;
    const bool first = at + 1 < expression.size() && expression[at + 1] == '=';
    mc::require(first || second, "expression '{}', position {}: '=' sets a variable; use == to compare",
                abbreviate(expression, at), at);
  }
}

// muParser reads "0.2 < x < 0.5" as (0.2 < x) < 0.5.
void refuse_chain(std::string_view expression) {
  std::vector<bool> compared(1); // for each open parenthesis: whether a comparison follows the last joining word
  for (std::size_t at = 0; at < expression.size(); ++at) {
    const std::string_view here = expression.substr(at);
    const char c = here[0];
    const auto is_word = [&](std::string_view word) {
      return here.starts_with(word) && (at == 0 || !in_word(expression[at - 1])) &&
             (here.size() == word.size() || !in_word(here[word.size()]));
    };
    const bool is_comparison = c == '<' || c == '>' || here.starts_with("==") || here.starts_with("!=");
    if (c == '(') compared.push_back(false);
    if (c == ')' && compared.size() > 1) compared.pop_back();
    if (is_word("and") || is_word("or") || std::string_view("&|?:,").find(c) != std::string_view::npos)
      compared.back() = false;
    if (!is_comparison) continue;
    mc::require(!compared.back(), "expression '{}', position {}: comparisons do not chain; write 0.2 < x and x < 0.5",
                abbreviate(expression), at);
    compared.back() = true;
    at += here.size() > 1 && here[1] == '=' ? 1 : 0;
  }
}

// A parser of the expression over variables at these places. muParser evaluates in place, so each thread needs its own.
std::unique_ptr<mu::Parser> make_parser(const std::string& expression, const std::vector<std::string>& names,
                                        double* values) {
  refuse_assignment(expression);
  refuse_chain(expression);
  try {
    auto parser = std::make_unique<mu::Parser>();
    define_words(*parser);
    define_special_functions(*parser);
    for (std::size_t i = 0; i < names.size(); ++i) parser->DefineVar(names[i], &values[i]);
    parser->SetExpr(expression);
    parser->Eval();
    mc::require(parser->GetNumResults() == 1,
                "expression '{}' has {} values; give one, or each as an argument of its own", abbreviate(expression),
                parser->GetNumResults());
    return parser;
  } catch (const mu::Parser::exception_type& e) {
    throw refusal(expression, e, names);
  }
}

} // namespace

std::string abbreviate(std::string_view text, std::size_t at) {
  constexpr std::size_t most = 60;
  const auto whole = [&](std::size_t i) { // does not cut a multi-byte character
    while (i > 0 && i < text.size() && (static_cast<unsigned char>(text[i]) & 0xc0) == 0x80) --i;
    return i;
  };
  if (text.size() <= most) return std::string(text);
  const std::size_t first = whole(std::min(at - std::min(at, most / 2), text.size() - most));
  const std::size_t last = whole(std::min(first + most, text.size()));
  return fmt::format("{}{}{}", first > 0 ? "..." : "", text.substr(first, last - first),
                     last < text.size() ? "..." : "");
}

void require_variable_name(std::string_view name) {
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

std::vector<std::string> variables_of(std::string_view expression) {
  std::vector<std::string> words;
  for (const std::size_t start : word_starts(expression)) {
    const std::string_view word = word_at(expression, start);
    const bool is_name =
        !is_called(expression, start) && word != "and" && word != "or" && word != "_pi" && word != "_e";
    if (is_name && std::find(words.begin(), words.end(), word) == words.end()) words.emplace_back(word);
  }
  return words;
}

// The definition of a program.
struct ExpressionProgram::Source {
  struct Expression {
    std::string text;
    std::size_t names; ///< it uses the first names only
  };
  std::uint64_t id = 0; ///< changes with the program
  std::vector<std::string> names;
  std::vector<double> initial;
  std::vector<Expression> expressions;

  void renew() {
    static std::atomic<std::uint64_t> ids = 0;
    id = ++ids;
  }
};

// The values of one thread, and the parsers that use them.
struct ExpressionProgram::State {
  std::vector<double> values;
  std::vector<std::unique_ptr<mu::Parser>> parsers;

  explicit State(const Source& source) : values(source.initial) {
    for (const Source::Expression& e : source.expressions) {
      const auto end = source.names.begin() + static_cast<std::ptrdiff_t>(e.names);
      parsers.push_back(make_parser(e.text, {source.names.begin(), end}, values.data()));
    }
  }
};

ExpressionProgram::ExpressionProgram() : source_(std::make_shared<Source>()) { source_->renew(); }

std::size_t ExpressionProgram::add_value(const std::string& name, double initial) {
  source_->renew();
  source_->names.push_back(name);
  source_->initial.push_back(initial);
  return source_->names.size() - 1;
}

std::size_t ExpressionProgram::add_expression(const std::string& text) {
  std::vector<double> values(source_->initial);
  make_parser(text, source_->names, values.data());
  source_->renew();
  source_->expressions.push_back({text, source_->names.size()});
  return source_->expressions.size() - 1;
}

ExpressionProgram::Frame ExpressionProgram::frame() const {
  struct Cached {
    std::weak_ptr<const Source> owner;
    State state;
  };
  thread_local std::unordered_map<std::uint64_t, Cached> states;
  thread_local std::uint64_t last_id = 0; // of the last call, which mostly was of the same program
  thread_local State* last = nullptr;
  if (last && last_id == source_->id) return Frame(*last);
  auto found = states.find(source_->id);
  if (found == states.end()) {
    std::erase_if(states, [](const auto& entry) { return entry.second.owner.expired(); });
    found = states.emplace(source_->id, Cached{source_, State(*source_)}).first;
  }
  last_id = source_->id;
  last = &found->second.state;
  return Frame(*last);
}

ExpressionProgram::Frame::Frame(State& state) : state_(&state), values_(state.values.data()) {}
double ExpressionProgram::Frame::evaluate(std::size_t expression) const { return state_->parsers[expression]->Eval(); }

std::function<double(std::span<const double>)> parse_function(const std::string& expression,
                                                              const std::vector<std::string>& variables) {
  ExpressionProgram program;
  for (const std::string& name : variables) program.add_value(name);
  program.add_expression(expression);
  return [program](std::span<const double> x) {
    const ExpressionProgram::Frame frame = program.frame();
    for (std::size_t i = 0; i < x.size(); ++i) frame[i] = x[i];
    return frame.evaluate(0);
  };
}

double parse_number(const std::string& text) {
  const std::optional<double> number = mc::parse_double(text);
  return number ? *number : parse_function(text, {})({});
}

} // namespace carlo

/// carlo: the command line. The only file that includes CLI11.

#include <options/subcommand.h>
#include <terminal/interrupt.h>
#include <terminal/version.h>

#include <mc/core/error.h>
#include <mc/core/text.h>

#include <CLI/CLI.hpp>

#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <concepts>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <limits>
#include <new>
#include <system_error>

namespace {

using carlo::Option, carlo::Subcommand;

constexpr const char* exit_codes =
    "Exit codes: 0 done and every check passed; 1 a check failed; 2 bad usage, file or value; 130 interrupted, "
    "143 by SIGTERM.";

// Puts a count as digits: 1e6 is one too. What is wrong with it, or nothing.
template <std::integral T> std::string whole_number(std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || *end != 0 || value != std::floor(value) || std::isinf(value))
    return fmt::format("'{}' is not a whole number", text);
  if (std::is_unsigned_v<T> && text.starts_with('-')) return text + " must be >= 0";
  // More digits than a double has are kept.
  std::string digits = text.find_first_not_of("-0123456789") < text.size() ? fmt::format("{:.0f}", value) : text;
  T whole{};
  if (std::from_chars(digits.data(), digits.data() + digits.size(), whole).ec == std::errc::result_out_of_range)
    return fmt::format("{} is too {}", text,
                       value > 0 ? fmt::format("large; at most {}", std::numeric_limits<T>::max())
                                 : fmt::format("small; at least {}", std::numeric_limits<T>::min()));
  text = std::move(digits);
  return {};
}

std::string number(const std::string& text) {
  return mc::number_in(text) ? std::string() : fmt::format("'{}' is not a number", text);
}

// Or else --plugin "$MINE" with no MINE would check a sampler of ours, and -o=a.png would be a file '=a.png'.
std::string some_word(const std::string& text) {
  if (text.empty()) return "'' is empty; give a value or leave it out";
  return text.starts_with('=') ? fmt::format("'{}' begins with =; leave that out", text) : std::string();
}

CLI::Option* add(CLI::App& app, const Option& o, bool* flag) { return app.add_flag(o.names, *flag, o.help); }

CLI::Option* add(CLI::App& app, const Option& o, std::vector<std::string>* list) {
  CLI::Option* option = app.add_option(o.names, *list, o.help);
  if (o.names.starts_with('-')) option->allow_extra_args(false); // each time it is given adds one
  return option;
}

template <class T> CLI::Option* add(CLI::App& app, const Option& o, T* target) {
  CLI::Option* option = app.add_option(o.names, *target, o.help);
  if constexpr (std::integral<T>) option->transform(CLI::Validator(whole_number<T>, ""));
  if constexpr (std::same_as<T, std::optional<int>>) option->transform(CLI::Validator(whole_number<int>, ""));
  if constexpr (std::same_as<T, double> || std::same_as<T, std::optional<double>>) option->check(number);
  if constexpr (std::same_as<T, std::string>) option->check(some_word);
  if constexpr (requires { target->empty(); }) {
    if (!target->empty()) option->capture_default_str();
  } else if constexpr (!requires { target->has_value(); }) {
    option->capture_default_str();
  }
  return option;
}

void add(CLI::App& app, const Subcommand& subcommand) {
  CLI::App* c = app.add_subcommand(subcommand.name, subcommand.help);
  if (subcommand.hidden) c->group("");
  c->footer(subcommand.footer.empty() ? exit_codes : fmt::format("{}\n{}", subcommand.footer, exit_codes));
  for (const Option& o : subcommand.options) {
    CLI::Option* option = std::visit([&](auto* target) { return add(*c, o, target); }, o.target);
    if (!o.value.empty()) option->type_name(o.value);
    option->required(o.required);
    for (const std::string& name : o.excludes) option->excludes(c->get_option(name));
  }
}

std::string quoted(const std::string& word) {
  const bool plain = !word.empty() && word.find_first_of(" \t\n'\"\\$`&|;<>()*?[]#~{}!") == std::string::npos;
  if (plain) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

// What the parser complains of, with the name that may have been meant.
std::string complaint(const CLI::App& app, const CLI::ParseError& e) {
  const std::vector<CLI::App*> given = app.get_subcommands();
  const CLI::App& asked = given.empty() ? app : *given.front();
  const std::string help = fmt::format("see carlo {}--help", given.empty() ? "" : asked.get_name() + " ");
  for (const CLI::Option* o : asked.get_options())
    if (o->get_expected_max() == 1 && o->count() > 1)
      return fmt::format("{} is given {} times; give it once ({})", o->get_name(), o->count(), help);
  const std::vector<std::string> unknown = app.remaining(true);
  if (unknown.empty()) return fmt::format("{} ({})", e.what(), help);
  auto word = std::find_if(unknown.begin(), unknown.end(), [](const auto& u) { return u.starts_with('-'); });
  if (word == unknown.end()) word = unknown.begin();
  std::vector<std::string> names;
  for (const CLI::App* c : asked.get_subcommands([](const CLI::App* c) { return !c->get_group().empty(); }))
    names.push_back(c->get_name());
  for (const CLI::Option* o : asked.get_options())
    for (const std::string& name : o->get_lnames()) names.push_back("--" + name);
  const bool is_sum = word->starts_with('-') && !word->starts_with("--") && word->find_first_of("*/^(") != word->npos;
  if (is_sum && asked.get_option_no_throw("INTEGRAND"))
    return fmt::format("unknown argument '{}'; an expression that begins with - goes into parentheses: \"({})\" ({})",
                       *word, *word, help);
  return fmt::format("unknown argument '{}'{} ({})", *word, mc::did_you_mean(*word, names), help);
}

int run(int argc, char** argv) {
  CLI::App app("carlo: Monte Carlo samplers validated, convergence measured, scenes rendered with error bars");
  app.set_version_flag("--version", fmt::format("carlo {} ({})", carlo::version, carlo::commit));
  app.require_subcommand(1);
  app.footer(exit_codes);
  const std::vector<Subcommand> all = carlo::subcommands();
  for (const Subcommand& c : all) add(app, c);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e); // --help, --version
    throw mc::Error(complaint(app, e));
  }

  std::string command = "carlo";
  for (int i = 1; i < argc; ++i) command += " " + quoted(argv[i]);
  for (const Subcommand& c : all)
    if (app.got_subcommand(c.name)) {
      const int code = c.run(command);
      return code == carlo::exit_interrupted && carlo::Interrupt::is_terminated() ? carlo::exit_terminated : code;
    }
  return carlo::exit_bad_input;
}

// A stream that was closed before carlo began would lend its number to the next file that is opened.
void occupy_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0) open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

// What one case of validate gives back the next one takes: asking the system for pages anew, which it clears each time,
// takes a tenth of the time.
void keep_memory() {
  mallopt(M_MMAP_THRESHOLD, 1 << 25); // bytes; the largest that is allowed
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
}

// A full disk or a closed pipe may show only here.
int finish(int code) {
  const bool flushed = std::fflush(stdout) == 0;
  const int failure = flushed ? 0 : errno;
  mc::require(flushed && !std::ferror(stdout) && std::cout.flush().good(), "cannot write to standard output: {}",
              failure != 0 ? std::strerror(failure) : "what was printed before is lost");
  return code;
}

} // namespace

int main(int argc, char** argv) {
  occupy_standard_streams();
  keep_memory();
  std::signal(SIGPIPE, SIG_IGN); // a closed pipe is an error of the write
  try {
    return finish(run(argc, argv));
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "carlo: out of memory; ask for a smaller image or fewer samples\n");
  } catch (const std::filesystem::filesystem_error& e) {
    std::fprintf(stderr, "carlo: %s\n", e.what());
  } catch (const std::system_error& e) { // of fmt::print
    std::fprintf(stderr, "carlo: cannot write to standard output: %s\n", e.code().message().c_str());
  } catch (const std::exception& e) {
    std::fprintf(stderr, "carlo: %s\n", e.what());
  }
  return carlo::exit_bad_input;
}

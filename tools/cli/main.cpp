/// carlo: the command line. The only file that includes CLI11.

#include <options/files.h>
#include <options/help.h>
#include <options/memory_option.h>
#include <options/subcommand.h>
#include <terminal/columns.h>
#include <terminal/interrupt.h>
#include <terminal/message.h>
#include <terminal/ranks.h>
#include <terminal/version.h>

#include <mc/core/error.h>
#include <mc/core/memory.h>
#include <mc/core/text.h>

#include <CLI/CLI.hpp>

#include <fcntl.h>
#include <malloc.h>
#include <poll.h>
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
#include <optional>
#include <string_view>
#include <system_error>

namespace {

using carlo::Exclusion, carlo::Option, carlo::Subcommand;

// Rewrites a count as digits, 1e6 too. Returns the error message, or "".
template <std::integral T> std::string whole_number(std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || *end != 0 || value != std::floor(value) || std::isinf(value))
    return fmt::format("'{}' is not a whole number", text);
  if (std::is_unsigned_v<T> && text.starts_with('-')) return text + " must be >= 0";
  // Digits beyond the precision of a double stay as they are.
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
  return mc::parse_double(text) ? std::string() : fmt::format("'{}' is not a number", text);
}

// Refuses --plugin "$MINE" where MINE is not set, and -o=a.png, which would name a file '=a.png'.
std::string nonempty_word(const std::string& text) {
  if (text.empty()) return "'' is empty; give a value or leave it out";
  return text.starts_with('=') ? fmt::format("'{}' begins with =; leave that out", text) : std::string();
}

CLI::Option* add(CLI::App& app, const Option& o, bool* flag) { return app.add_flag(o.names, *flag); }

CLI::Option* add(CLI::App& app, const Option& o, std::vector<std::string>* list) {
  CLI::Option* option = app.add_option(o.names, *list);
  if (o.names.starts_with('-')) option->allow_extra_args(false); // each time it is given adds one
  return option;
}

CLI::Option* add(CLI::App& app, const Option& o, std::optional<std::string>* text) {
  const auto fill = [text](const std::vector<std::string>& words) {
    *text = words.empty() ? std::string() : words.front();
    return true;
  };
  return app.add_option(o.names, fill)->expected(0, 1);
}

template <class T> CLI::Option* add(CLI::App& app, const Option& o, T* destination) {
  CLI::Option* option = app.add_option(o.names, *destination);
  if constexpr (std::integral<T>) option->transform(CLI::Validator(whole_number<T>, ""));
  if constexpr (std::same_as<T, std::optional<int>>) option->transform(CLI::Validator(whole_number<int>, ""));
  if constexpr (std::same_as<T, double> || std::same_as<T, std::optional<double>>) option->check(number);
  if constexpr (std::same_as<T, std::string>) option->check(nonempty_word);
  return option;
}

void add(CLI::App& app, const Subcommand& subcommand) {
  CLI::App* c = app.add_subcommand(subcommand.about.name);
  for (const std::string& alias : subcommand.about.aliases) c->alias(alias);
  if (subcommand.about.hidden) c->group("");
  for (const Option& o : subcommand.options) {
    CLI::Option* option = std::visit([&](auto* destination) { return add(*c, o, destination); }, o.destination);
    if (!o.value.empty()) option->type_name(o.value);
    option->required(o.required);
  }
}

// "--output" of "-o,--output".
std::string long_name(const Option& o) { return o.names.substr(o.names.find(',') + 1); }

// Throws Error where two options are given that exclude each other.
void require_compatible(const CLI::App& app, const Subcommand& subcommand) {
  const std::string& name = subcommand.about.name;
  const CLI::App* given = app.get_subcommand(name);
  for (const Option& o : subcommand.options)
    for (const Exclusion& e : o.excludes)
      mc::require(given->count(long_name(o)) == 0 || given->count(e.option) == 0,
                  "{} and {} exclude each other: {}; leave one out (see carlo {} --help)", e.option, long_name(o),
                  e.reason, name);
}

std::string quoted(const std::string& word) {
  const bool plain = !word.empty() && word.find_first_of(" \t\n'\"\\$`&|;<>()*?[]#~{}!") == std::string::npos;
  if (plain) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

// The message of a parse error, with the name that may have been meant.
std::string message_of(const CLI::App& app, const CLI::ParseError& e) {
  const std::vector<CLI::App*> given = app.get_subcommands();
  const CLI::App& asked = given.empty() ? app : *given.front();
  const std::string help = fmt::format("see carlo {}--help", given.empty() ? "" : asked.get_name() + " ");
  for (const CLI::Option* o : asked.get_options())
    if (o->get_expected_max() == 1 && o->count() > 1)
      return fmt::format("{} is given {} times; give it once ({})", o->get_name(), o->count(), help);
  const std::vector<std::string> unknown = app.remaining(true);
  const std::string what = e.what();
  constexpr std::string_view lacks = ": 1 required ", missing = " missing";
  if (const std::size_t at = what.find(lacks); at != what.npos && what.ends_with(missing)) {
    const std::size_t value = at + lacks.size();
    return fmt::format("{0} needs a value: {0} {1} ({2})", what.substr(0, at),
                       what.substr(value, what.size() - missing.size() - value), help);
  }
  if (unknown.empty()) return fmt::format("{} ({})", what, help);
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

// Runs a subcommand. The message of missing memory names the limit, and the option that sets another.
int run_within_memory(const Subcommand& subcommand, const std::string& command) {
  const char* remedy =
      carlo::has_memory_option(subcommand) ? "--memory sets another limit" : "ulimit -v sets another limit";
  try {
    return subcommand.run(command);
  } catch (const mc::MemoryError& e) {
    throw mc::MemoryError(fmt::format("{}; {}", e.what(), remedy));
  } catch (const std::bad_alloc&) {
    throw mc::MemoryError(
        fmt::format("out of memory; {:.3g} GiB are allowed; {}", mc::allowed_memory() / 0x1p30, remedy));
  }
}

int run(int argc, char** argv) {
  CLI::App app(carlo::carlo_summary);
  app.set_version_flag("--version", fmt::format("carlo {} ({})", carlo::version, carlo::commit));
  app.require_subcommand(1);
  const std::vector<Subcommand> all = carlo::subcommands();
  for (const Subcommand& c : all) add(app, c);
  const auto given = [&] {
    return std::find_if(all.begin(), all.end(), [&](const Subcommand& c) { return app.got_subcommand(c.about.name); });
  };
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    const std::size_t columns = carlo::terminal_columns(STDOUT_FILENO);
    fmt::print("{}", given() == all.end() ? help_of(all, columns) : help_of(*given(), columns));
    return carlo::exit_ok;
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e); // --version
    throw mc::Error(message_of(app, e));
  }

  require_compatible(app, *given());
  carlo::require_distinct_files(carlo::files_of(given()->options));
  std::string command = "carlo";
  for (int i = 1; i < argc; ++i)
    if (std::string(argv[i]) == "--merged-part") ++i; // not the user's: see cli/merge.cpp
    else command += " " + quoted(argv[i]);
  const int code = run_within_memory(*given(), command);
  const int signal = carlo::Interrupt::signal();
  return code == carlo::exit_interrupted && signal != 0 ? 128 + signal : code;
}

// Opens a stream that was closed before carlo began: the next file that is opened would get its descriptor.
void occupy_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0) open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

// Keeps freed memory for the next case of validate. The system clears every page that it hands out, which takes time.
void keep_memory() {
  mallopt(M_MMAP_THRESHOLD, 1 << 25); // bytes; the largest that is allowed
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
}

// Whether a stream is a pipe that nothing reads any more.
bool is_closed_pipe(int stream) {
  pollfd state{stream, 0, 0};
  return poll(&state, 1, 0) == 1 && (state.revents & POLLERR) != 0;
}

// Ends as a program does that a signal of a closed pipe kills: without a message, a shell reports 141.
[[noreturn]] void end_by_closed_pipe() {
  std::signal(SIGPIPE, SIG_DFL);
  std::raise(SIGPIPE);
  std::_Exit(carlo::exit_closed_pipe); // where the signal is blocked
}

// Writes what is still in the buffers: a full disk or a closed pipe may show only here.
int finish(int code) {
  const bool flushed = std::fflush(stdout) == 0;
  const int failure = flushed ? 0 : errno;
  const bool complete = flushed && std::ferror(stdout) == 0 && std::cout.flush().good();
  if (!complete && is_closed_pipe(STDOUT_FILENO)) end_by_closed_pipe();
  mc::require(complete, "cannot write to standard output: {}",
              failure != 0 ? std::strerror(failure) : "an earlier write failed");
  return code;
}

void fail(const std::string& reason) {
  carlo::print_message(reason);
  carlo::Ranks::report_failure(reason);
}

// The exit code of carlo. Prints one line on standard error where it fails.
int run_and_finish(int argc, char** argv) {
  try {
    const int code = finish(run(argc, argv));
    return carlo::rank() == 0 ? code : int(carlo::exit_ok);
  } catch (const mc::EndOfRanks&) {
    return carlo::exit_ok;
  } catch (const mc::LostRank& e) {
    carlo::print_message(e.what());
    return carlo::exit_failed;
  } catch (const std::bad_alloc&) {
    fail("out of memory");
  } catch (const std::filesystem::filesystem_error& e) {
    fail(fmt::format("cannot use '{}': {}", e.path1().string(), e.code().message()));
  } catch (const std::system_error& e) { // of fmt::print and ResultFile
    if (e.code() == std::errc::broken_pipe) end_by_closed_pipe();
    fail("cannot write to standard output: " + e.code().message());
  } catch (const std::exception& e) {
    fail(e.what());
  }
  return carlo::rank() == 0 ? carlo::exit_bad_input : carlo::exit_ok;
}

} // namespace

int main(int argc, char** argv) {
  occupy_standard_streams();
  keep_memory();
  // A write to a closed pipe, or beyond a limit of the file size, fails instead of ending carlo.
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
  const bool is_worker = argc > 1 && std::string_view(argv[1]) == "worker"; // of a rank, and no rank itself
  try {
    const std::optional<carlo::Ranks> ranks = is_worker ? std::nullopt : std::optional<carlo::Ranks>(std::in_place);
    return run_and_finish(argc, argv);
  } catch (const std::exception& e) {
    carlo::print_message(e.what());
  }
  return carlo::exit_bad_input;
}

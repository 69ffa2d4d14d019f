#pragma once
/// A subcommand of carlo as data: its words, its options as rows, and the function that runs it.
///
/// A new subcommand is one file in cli/, CMake's line for it, and a row in subcommands.cpp. The file defines
///   Subcommand NAME_subcommand() { return make_subcommand<Options>("NAME", "What it does", rows, run); }
/// where Options is a struct of its own, rows(Options&) lists the options with the fields that they fill, and
/// run(const Options&) prints its result on stdout and progress on stderr, returns the exit code, and throws mc::Error
/// on bad input.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace carlo {

/// What carlo returns to the shell.
enum ExitCode : int {
  exit_ok = 0,            ///< done, and every check passed
  exit_failed = 1,        ///< done, but a check failed: a sampler broke a law, two images differ
  exit_bad_input = 2,     ///< bad usage, file or value; one line on stderr says what to do
  exit_interrupted = 130, ///< Ctrl-C; what was found so far is written, or said, and marked as such
  exit_terminated = 143   ///< the same by SIGTERM; subcommands return exit_interrupted
};

/// One option, or an argument that has a place and no name.
struct Option {
  using Target = std::variant<bool*, int*, std::uint64_t*, double*, std::string*, std::vector<std::string>*,
                              std::optional<int>*, std::optional<double>*>;

  std::string names; ///< "-o,--output"; "SCENE" of an argument by place
  std::string value; ///< what stands behind it, for --help: "SECONDS", "FILE"; empty for a flag
  Target target;     ///< filled when the option is given; what it holds before is the default that --help shows
  std::string help;  ///< one line; a default that the field cannot show stands at its end in [brackets]
  bool required = false;
  std::vector<std::string> excludes = {}; ///< names of options of rows above that cannot be given beside it
};

struct Subcommand {
  std::string name, help;
  std::vector<Option> options;
  std::function<int(const std::string& command_line)> run;
  std::string footer = {}; ///< of its --help
  bool hidden = false;     ///< not for users: --help does not name it
};

/// The subcommand of an Options struct and its functions. Where Options has a field `command` it gets the command line.
template <class Options>
Subcommand make_subcommand(std::string name, std::string help, std::vector<Option> (*rows)(Options&),
                           int (*run)(const Options&), std::string footer = {}) {
  const auto options = std::make_shared<Options>();
  Subcommand c{std::move(name), std::move(help), rows(*options), {}, std::move(footer)};
  c.run = [options, run]([[maybe_unused]] const std::string& command_line) {
    if constexpr (requires { options->command; }) options->command = command_line;
    return run(*options);
  };
  return c;
}

/// All of them, in the order of --help.
std::vector<Subcommand> subcommands();

} // namespace carlo

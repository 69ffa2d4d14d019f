#pragma once
/// A subcommand of carlo as data: its texts, its options as rows, and the function that runs it.
///
/// A new subcommand is one file in cli/, its line in CMakeLists.txt, and a row in subcommands.cpp. The file defines
///   Subcommand NAME_subcommand() { return make_subcommand<Options>(about, rows, run); }
/// and these four names.
///   Options : a struct of its own.
///   about   : the texts of the subcommand.
///   rows    : rows(Options&) lists the options and binds them to fields.
///   run     : run(const Options&) prints its result on stdout and progress on stderr, and returns the exit code. It
///             throws mc::Error on bad input.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace carlo {

/// Exit codes of carlo.
enum ExitCode : int {
  exit_ok = 0,            ///< done, and every check passed
  exit_failed = 1,        ///< done, but a check failed or a wanted error was not reached
  exit_bad_input = 2,     ///< bad usage, file or value; one line on stderr names the remedy
  exit_interrupted = 130, ///< Ctrl-C; the results so far are written, or printed, and marked as such. After another
                          ///< signal of Interrupt, main ends with 128 + its number, such as 143 for SIGTERM.
  exit_closed_pipe = 141  ///< nothing reads standard output any more, as behind `| head`
};

/// Another option that cannot be given with this one.
struct Exclusion {
  std::string option; ///< "--spp"
  std::string reason; ///< "--time chooses the number of samples": the end of a message
};

/// Use of the file or folder that an option names. A state is read and replaced, as a checkpoint is.
enum class FileUse { none, input, output, output_folder, state };

/// One option, or a positional argument without a name.
struct Option {
  using Destination = std::variant<bool*, int*, std::uint64_t*, double*, std::string*, std::vector<std::string>*,
                                   std::optional<int>*, std::optional<double>*, std::optional<std::string>*>;

  std::string names;       ///< "-o,--output"; "SCENE" for a positional argument
  std::string value;       ///< metavariable for --help: "SECONDS", "FILE"; empty for a flag
  Destination destination; ///< filled when the option is given; its initial value is the default that --help shows.
                           ///< An optional text is "" where the option is given without its value.
  std::string help;        ///< one or two sentences; a default that the field cannot show stands at the end
  bool required = false;
  std::vector<Exclusion> excludes = {};
  std::string group = {}; ///< heading in --help, see in_groups
  FileUse use = FileUse::none;
  bool hidden = false;                 ///< not for users: --help does not name it
  std::vector<std::string> files = {}; ///< fixed names of files that are written into an output folder
};

/// The option of a file that is read.
Option input_file(Option o);
/// The option of a file that is written; "-" is standard output.
Option output_file(Option o);
/// The option of a file from which a run goes on, and which it replaces.
Option state_file(Option o);
/// The option of a folder into which files are written. List the names that are fixed; the subcommand checks the others
/// by require_distinct_files() as soon as it can name them.
Option output_folder(Option o, std::vector<std::string> files);

/// Options under one heading of --help.
struct OptionGroup {
  std::string title;
  std::vector<Option> options;
};

inline constexpr const char* common_options = "Common options"; ///< the first group
inline constexpr const char* expert_options = "Expert options"; ///< the last group

/// The options of all groups, in order.
std::vector<Option> in_groups(std::vector<OptionGroup> groups);

/// A term with its explanation; a paragraph where the term is empty.
struct HelpEntry {
  std::string term, text;
};

/// A part of --help below the options.
struct HelpSection {
  std::string title;
  std::vector<HelpEntry> entries;
};

/// The texts of a subcommand.
struct About {
  std::string name;
  std::string summary;                    ///< one sentence without a full stop
  std::vector<HelpEntry> examples;        ///< command lines with their effects
  std::string failure = {};               ///< meaning of exit code 1; empty where it does not occur
  std::vector<HelpSection> sections = {}; ///< further explanation
  std::vector<std::string> aliases = {};  ///< former names, which --help does not show
  bool hidden = false;                    ///< not for users: --help does not name it
};

struct Subcommand {
  About about;
  std::vector<Option> options;
  std::function<int(const std::string& command_line)> run;
};

/// Combines an Options struct with its functions. If Options has a field `command`, it receives the command line.
template <class Options>
Subcommand make_subcommand(About about, std::vector<Option> (*rows)(Options&), int (*run)(const Options&)) {
  const auto options = std::make_shared<Options>();
  Subcommand c{std::move(about), rows(*options), {}};
  c.run = [options, run]([[maybe_unused]] const std::string& command_line) {
    if constexpr (requires { options->command; }) options->command = command_line;
    return run(*options);
  };
  return c;
}

/// All subcommands, in the order of --help.
std::vector<Subcommand> subcommands();

} // namespace carlo

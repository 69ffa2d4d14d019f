#pragma once
/// The options --checkpoint, --every and --resume of subcommands that run for long.

#include <options/subcommand.h>

#include <mc/run/checkpoint.h>

#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

struct CheckpointFiles {
  std::string checkpoint = {};          ///< file to write; empty: `resume`
  std::string every = "60s";            ///< time between two checkpoints
  std::string resume = {};              ///< file to go on from; empty: a new run
  std::string part = {};                ///< "3/100": this share of the units; empty: all of them
  std::vector<std::string> merged = {}; ///< files of all parts, for carlo merge

  /// Whether the run computes a part, and has no other results.
  bool is_part() const { return !part.empty(); }
};

/// The rows of --checkpoint, --every and --part.
///   clock : options by which a clock decides on the work; a part cannot have them.
std::vector<Option> checkpoint_rows(CheckpointFiles& files, const std::vector<std::string>& clock = {});
/// The row of --resume FILE.
Option resume_row(CheckpointFiles& files);

/// Seconds of "90", "90s", "1.5min", "2h" or "500ms".
///   throws : Error that names the option, for any other text, and outside [0, 1e9] s.
double parse_duration(std::string_view option, const std::string& text);

/// The given options with their values, and the build. The content of an input file counts, not its name. Output files
/// and folders do not count.
///   ignored : options on which no result depends, by their long names.
mc::RunIdentity run_identity(const std::vector<Option>& options, const std::set<std::string>& ignored);

/// The checkpoints of a run; null without --checkpoint and --resume. A checkpoint that cannot be written gives a
/// warning.
///   throws : Error for a file to go on from that is missing, damaged or of another run, and for a file that cannot be
///            written.
std::unique_ptr<mc::Checkpoint> open_checkpoint(const CheckpointFiles& files, mc::RunIdentity identity);

/// Says on standard error how an interrupted run goes on, if it has checkpoints.
void print_how_to_resume(const CheckpointFiles& files);

} // namespace carlo

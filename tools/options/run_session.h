#pragma once
/// How the jobs of a subcommand run: with checkpoints, as one of several parts, or on the ranks of MPI.

#include <converge/measure.h>
#include <options/checkpoint_options.h>

#include <mc/run/part_run.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace carlo {

/// One run of a subcommand with jobs.
///   part   : --part K/N computes a share of the units, and writes it to the file of -o. A part has no other results.
///   merge  : the files of --merged-part are the parts; the run writes the results from them.
///   MPI    : where carlo runs on several ranks, these compute the units together.
class RunSession {
 public:
  /// Opens the files.
  ///   identity : everything that the results depend on, see run_identity().
  ///   output   : the file of -o.
  ///   command  : the command line, for carlo merge.
  ///   throws   : Error for files that are missing, damaged or of another run, and for those that cannot be written.
  RunSession(const CheckpointFiles& files, const mc::RunIdentity& identity, const std::string& output,
             const std::string& command);

  /// Saves and restores the state of the run; null for parts and without files.
  mc::Checkpoint* checkpoint() const { return part_ ? nullptr : checkpoint_.get(); }
  /// Who computes the units of jobs.
  mc::Executor executor() const;
  /// Who computes the pieces of measurements; null where all are computed by executor(). It must not outlive this.
  const PartExecutors* parts() const { return part_ ? &parts_ : nullptr; }
  /// Whether other processes, or a later run, compute or need some of the units.
  bool is_shared() const { return part_ || checkpoint_ || executor(); }
  /// Called before results are written: a part ends here.
  void before_results() const;
  /// Calls work() and returns its exit code. Where a part ends, saves it and prints what comes next.
  int run(const std::function<int()>& work);

 private:
  int end_part();

  CheckpointFiles files_;
  std::string output_;
  std::unique_ptr<mc::Checkpoint> checkpoint_;
  std::unique_ptr<mc::PartRun> part_;
  PartExecutors parts_;
};

/// "3/100" of --part. Throws Error for other texts.
mc::Part parse_part(const std::string& text);

/// The words of a command line whose words are quoted as in a shell.
std::vector<std::string> words_of(const std::string& command);

/// The words without an option and its value: "-o a", "-oa", "--output a", "--output=a".
///   names : "-o" and "--output", or one of them.
std::vector<std::string> without_option(const std::vector<std::string>& words, const std::vector<std::string>& names);

} // namespace carlo

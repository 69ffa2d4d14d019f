#pragma once
/// Jobs that a program has finished, so that a resumed program does not repeat them.

#include <mc/run/executor.h>

#include <deque>
#include <string>

namespace mc {

/// An executor that saves the states of finished jobs, as a section of a checkpoint. A resumed program runs the same
/// jobs in the same order, since each decision follows from earlier results: it gets finished jobs from the log, and
/// goes on within the job that was under way.
class JobLog {
 public:
  /// The checkpoint must outlive this; null: none is saved.
  ///   executor : who computes the units; empty: threads.
  explicit JobLog(Checkpoint* checkpoint, Executor executor = {});
  JobLog(const JobLog&) = delete;
  JobLog& operator=(const JobLog&) = delete;

  /// The executor. It must not outlive this.
  ///   throws : Error where a job has another name than in the log.
  Executor executor();
  /// Saves the log at the end of the program.
  void save();

 private:
  struct Entry {
    std::string name, state;
    template <class Archive> void archive(Archive& a) { a(name, state); }
  };
  bool run(const AnyJob& job, RunOptions options);

  Checkpoint* checkpoint_;
  Executor executor_;
  std::deque<Entry> entries_;
  std::size_t next_ = 0; ///< First entry that was not asked for yet.
  Checkpoint::Section section_;
};

} // namespace mc

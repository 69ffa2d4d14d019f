#pragma once
/// Replicates that a run has finished, so that a resumed run does not repeat them.

#include <converge/integral_target.h>

#include <chrono>
#include <deque>
#include <string>

namespace carlo {

/// The results of a sequence of tasks, as a section of a checkpoint. A resumed program issues the same tasks in the
/// same order, since each decision follows from earlier results: it gets the results of finished tasks from the log.
/// The memory is that of the replicates, which the curves keep, too. Without a checkpoint nothing is kept.
class ReplicateLog {
 public:
  /// A null checkpoint has no effect.
  ///   executor : who computes the replicates; empty: threads.
  explicit ReplicateLog(mc::Checkpoint* checkpoint, mc::Executor executor = {});

  /// Changes who computes the replicates of later tasks.
  void use(mc::Executor executor) { executor_ = std::move(executor); }

  /// The replicates of a task, from the log or computed. Throws the errors of the target, also from the log.
  Replicates run(const IntegralTarget& target, ReplicateTask task);

  /// Seconds from the begin of the first run to the end of the last task, without the time between two runs. While
  /// results are from the log, it is their time, so that decisions by time are repeated; on all ranks it is equal.
  double elapsed() const { return earlier_; }

  /// Saves the log.
  void save();

 private:
  struct Entry {
    std::string task;
    Replicates replicates;
    std::string error; ///< of a task that failed; empty: none
    double elapsed = 0;
    template <class Archive> void archive(Archive& a) { a(task, replicates, error, elapsed); }
  };
  using Clock = std::chrono::steady_clock;

  Replicates compute(const IntegralTarget& target, ReplicateTask task, const std::string& name) const;
  Replicates result_of(Entry entry); ///< the replicates of the task that is asked for, or its error

  mc::Checkpoint* checkpoint_;
  mc::Executor executor_;
  std::deque<Entry> entries_;
  std::size_t next_ = 0; ///< first entry that was not asked for yet
  double earlier_ = 0;   ///< seconds at the end of the last task, which was at `start_`
  Clock::time_point start_ = Clock::now();
  mc::Checkpoint::Section section_;
};

} // namespace carlo

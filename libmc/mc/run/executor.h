#pragma once
/// Who computes the units of a job: threads of this process, or an executor that a program hands to run_job().

#include <mc/core/error.h>
#include <mc/run/checkpoint.h>

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace mc {

/// Result of a unit, of the type of its job.
using AnyResult = std::shared_ptr<void>;

/// A job without its type; the functions are those of Job.
struct AnyJob {
  std::string name;                                   ///< RunOptions::name.
  std::function<std::size_t()> next_stage;            ///< Begins a stage.
  std::function<AnyResult(std::size_t)> compute;      ///< Result of a unit; null where it gave up.
  std::function<void(std::size_t, AnyResult)> absorb; ///< Adds a result.
  std::function<bool()> may_start;                    ///< Whether further units of the stage may start.
  std::function<void(std::size_t)> skip;              ///< Goes on without a result; empty: not possible.
  std::function<bool()> needs_results;                ///< Whether the next stage depends on results.
  std::function<void(ArchiveWriter&, const AnyResult&)> write_result; ///< Archive of a result.
  std::function<AnyResult(ArchiveReader&)> read_result;               ///< Result of an archive.
  std::function<void(ArchiveWriter&)> write;                          ///< Archive of the state.
  std::function<void(ArchiveReader&)> read;                           ///< State of an archive.
  std::function<void(ArchiveWriter&)> write_stage;                    ///< Archive of everything that compute() reads.
  std::function<void(ArchiveReader&)> read_stage;                     ///< The same from an archive.
};

/// Thrown on other ranks of MPI than 0 where rank 0 ends the program. No Error: nothing failed.
struct EndOfRanks {};

/// Thrown on rank 0 of MPI where another rank died or does not answer. What is done is in the checkpoint.
struct LostRank : Error {
  using Error::Error;
};

struct RunOptions;

/// Runs a job to its end, or until it is cancelled; returns whether it is done. See run_job() for the contract:
/// results are absorbed in order, so that the state of the job has the same bits for every executor.
using Executor = std::function<bool(const AnyJob& job, const RunOptions& options)>;

/// How a job is run.
struct RunOptions {
  int threads = 0;                           ///< Number of units that are computed at a time; 0: hardware threads.
  const std::atomic<bool>* cancel = nullptr; ///< No unit starts once it is true.
  Checkpoint* checkpoint = nullptr;          ///< Saves and restores the state; null: neither.
  Executor executor = {};                    ///< Who computes the units; empty: run_on_threads().
  std::string name = "job";                  ///< Tells the jobs of a program apart; equal names are counted.
};

/// Largest number of results that wait in memory for the result of an earlier unit, with this RunOptions::threads in
/// one process.
std::size_t max_waiting_results(int threads);

/// Computes the units on threads of this process.
bool run_on_threads(const AnyJob& job, const RunOptions& options);

namespace detail {

/// Units of a job for several workers. They take units and deliver results; the job absorbs these in order.
class UnitQueue {
 public:
  /// The job and the options must outlive this.
  UnitQueue(const AnyJob& job, const RunOptions& options) : job_(job), options_(options) {}

  /// Begins the next stage. False where the job is done.
  bool begin_stage();
  /// Number of units that are not absorbed.
  std::size_t left() const { return units_ - absorbed_; }
  /// Whether the job is done.
  bool is_done() const { return units_ == 0; }
  /// Whether no further unit of the stage may start, though some are left.
  bool is_cut_short() const { return !job_.may_start(); }
  /// Whether the run is cancelled, or a worker gave up.
  bool is_cancelled() const { return gave_up_ || (options_.cancel && options_.cancel->load()); }
  /// Opens the stage to workers, who take its units in order.
  ///   most_ahead : largest number of units given out from the first unit that is not absorbed on. It bounds the
  ///                results that wait in memory. No worker should wait for a unit unless that takes as long as many
  ///                others.
  void open(std::size_t most_ahead);
  /// Gives out no further unit.
  void close();

  /// Waits until a unit may start. Nothing where none may.
  std::optional<std::size_t> take();
  /// The same without waiting.
  std::optional<std::size_t> try_take();
  /// Whether no further unit will be given out.
  bool is_over();
  /// Whether the job has failed to absorb a result: its state is not defined.
  bool has_failed() const { return has_failed_; }
  /// Result of a unit; null where its worker gave up. Ignored once the job has failed to absorb one.
  void deliver(std::size_t unit, AnyResult result);
  /// Absorbs results behind a unit that is missing; the job can only end.
  void absorb_all();

  /// The state of the run, see mc/run/archive.h.
  void write(ArchiveWriter& a);
  /// The same for a reader.
  void read(ArchiveReader& a);

 private:
  void absorb_results();
  bool find_next();

  const AnyJob& job_;
  const RunOptions& options_;
  std::mutex mutex_; // of everything below, and of the job's state
  std::condition_variable absorbed_more_;
  std::size_t units_ = 0,                    ///< of this stage
      absorbed_ = 0,                         ///< the first units, whose results the job has
      next_ = 0,                             ///< the first unit that is not started
      most_ahead_ = 1;                       ///< of open()
  std::map<std::size_t, AnyResult> results_; ///< of units behind one that is still computed
  std::atomic<bool> gave_up_ = false, has_failed_ = false;
};

/// Runs all stages of a job with its checkpoint. run_stage(queue) opens the queue to its workers, and returns when
/// these have delivered what they took.
bool run_stages(const AnyJob& job, const RunOptions& options, const std::function<void(UnitQueue&)>& run_stage);

/// Number of threads of a run.
int threads_of(const RunOptions& options);

} // namespace detail

} // namespace mc

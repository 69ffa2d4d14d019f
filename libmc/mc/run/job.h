#pragma once
/// Work in units, with the same bits for any number of threads.

#include <mc/core/parallel.h>
#include <mc/run/checkpoint.h>

#include <algorithm>
#include <atomic>
#include <concepts>
#include <condition_variable>
#include <cstddef>
#include <map>
#include <mutex>
#include <optional>

namespace mc {

/// A sequence of stages. A stage is a number of units. A stage begins after all results of the stage before it were
/// absorbed, so it may depend on them, as a sampling plan depends on a pilot.
///   next_stage() : begins a stage and returns its number of units; 0 where the job is done, also if called again.
///   compute(i)   : result of unit i: a pure function of the job's input, the stage and i. Several threads call it at a
///                  time, so it reads nothing that absorb() changes. Returns nullopt only where it gave up because the
///                  run is cancelled.
///   absorb(i, r) : adds the result of unit i to the state. Called for i = 0, 1, 2, ... and by one thread at a time.
///                  Therefore the state has the same bits for any number of threads.
///   archive(a)   : the state between two calls of absorb(). See archive.h; results have an archive, too.
///   may_start()  : optional; false where no further unit of the stage may start, as after a time limit. The units that
///                  were started are absorbed, and the next stage begins.
template <class J>
concept Job = requires(J& job, const J& fixed, std::size_t unit, typename J::Result result, ArchiveWriter& writer,
                       ArchiveReader& reader) {
  { job.next_stage() } -> std::convertible_to<std::size_t>;
  { fixed.compute(unit) } -> std::convertible_to<std::optional<typename J::Result>>;
  job.absorb(unit, std::move(result));
  job.archive(writer);
  job.archive(reader);
};

/// How a job is run.
struct RunOptions {
  int threads = 0;                           ///< Number of units that are computed at a time; 0: hardware threads.
  const std::atomic<bool>* cancel = nullptr; ///< No unit starts once it is true.
  Checkpoint* checkpoint = nullptr;          ///< Saves and restores the state; null: neither.
};

namespace detail {

// A run of a job; see run_job().
template <Job J> class JobRun {
 public:
  JobRun(J& job, const RunOptions& options) : job_(job), options_(options) {}

  bool run() {
    const Checkpoint::Section section(options_.checkpoint, "job",
                                      [this](auto& a) { a(units_, absorbed_, results_, job_); });
    if (absorbed_ == units_) begin_stage();
    while (units_ > 0 && !is_cancelled()) {
      run_stage();
      if (absorbed_ == units_ || !may_start()) begin_stage();
    }
    const bool is_done = units_ == 0;
    if (options_.checkpoint && (!is_done || section.is_outermost())) options_.checkpoint->save_and_wait();
    for (auto& [unit, result] : results_) job_.absorb(unit, std::move(result));
    return is_done;
  }

 private:
  // Largest number of units of a thread from the first unit that is not absorbed. It bounds the results that wait in
  // memory. It is so large that no thread waits for a unit unless that takes as long as many others.
  static constexpr std::size_t max_ahead = 64;

  bool is_cancelled() const { return options_.cancel && options_.cancel->load(std::memory_order_relaxed); }
  bool may_start() const {
    if constexpr (requires { job_.may_start(); }) return job_.may_start();
    else return true;
  }

  void begin_stage() {
    units_ = job_.next_stage();
    absorbed_ = 0;
    results_.clear(); // where no further unit might start, results of a checkpoint may lack one before them
  }

  void run_stage() {
    next_ = absorbed_;
    const int threads = options_.threads != 0 ? options_.threads : hardware_threads();
    workers_ = std::min(static_cast<std::size_t>(threads), units_ - absorbed_);
    parallel_for(workers_, options_.threads, [this](std::size_t) { work(); });
  }

  // Computes one unit after the other, until none is left.
  void work() {
    std::unique_lock lock(mutex_);
    try {
      while (const std::optional<std::size_t> unit = take_unit(lock)) {
        lock.unlock();
        std::optional<typename J::Result> result = job_.compute(*unit);
        lock.lock();
        if (!result) break;
        results_.emplace(*unit, std::move(*result));
        absorb_results();
      }
    } catch (...) {
      if (!lock.owns_lock()) lock.lock();
      end_stage();
      throw;
    }
    end_stage();
  }

  // Waits until a unit may start. Returns nullopt where none may.
  std::optional<std::size_t> take_unit(std::unique_lock<std::mutex>& lock) {
    for (;;) {
      next_ = std::max(next_, absorbed_);
      while (results_.contains(next_)) ++next_; // of a checkpoint
      if (next_ >= units_ || is_cancelled() || !may_start()) return {};
      if (next_ < absorbed_ + max_ahead * workers_) return next_++;
      absorbed_more_.wait(lock);
    }
  }

  // After the last unit, a failure or a cancellation.
  void end_stage() {
    next_ = units_;
    absorbed_more_.notify_all();
  }

  void absorb_results() {
    for (auto first = results_.begin(); first != results_.end() && first->first == absorbed_;
         first = results_.erase(first), ++absorbed_)
      job_.absorb(absorbed_, std::move(first->second));
    absorbed_more_.notify_all();
    if (options_.checkpoint && options_.checkpoint->is_due()) options_.checkpoint->save();
  }

  J& job_;
  const RunOptions& options_;
  std::mutex mutex_; // of everything below, and of the job's state
  std::condition_variable absorbed_more_;
  std::size_t units_ = 0,                             ///< of this stage
      absorbed_ = 0,                                  ///< the first units, whose results the job has
      next_ = 0,                                      ///< the first unit that is not started
      workers_ = 0;                                   ///< threads of this stage
  std::map<std::size_t, typename J::Result> results_; ///< of units behind one that is still computed
};

} // namespace detail

/// Runs a job to its end, or until it is cancelled. With a checkpoint, goes on from the state of the file; saves the
/// state when it is due, at a cancellation, and at the end of a run that is not within another section. Returns whether
/// the job is done. When cancelled, the job has absorbed every result, in order, but some in between may be missing.
///   throws : the first exception of the job.
template <Job J> bool run_job(J& job, const RunOptions& options) { return detail::JobRun<J>(job, options).run(); }

} // namespace mc

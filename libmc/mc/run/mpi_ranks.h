#pragma once
/// The ranks of an MPI communicator as an executor. Only in builds with MC_MPI; link mc::mpi.

#include <mc/run/executor.h>

#include <mpi.h>

#include <memory>

namespace mc {

namespace detail {
class MpiLinks;
}

/// Several ranks that run the same program and compute the units of its jobs together.
///   jobs  : every rank calls run_job() for the same jobs in the same order. Rank 0 gives units to ranks that ask for
///           them, absorbs results in order, and saves checkpoints. After a job, all ranks have its state, with the
///           bits of a run of one rank. So all ranks take the same decisions, unless a clock makes them: see
///           shared_value().
///   end   : finish() on every rank. Where rank 0 ends its program early, run_job() throws EndOfRanks on the others.
///   errors: an exception of a unit is thrown as Error on every rank. Where a rank dies, LostRank is thrown on rank 0,
///           after a checkpoint of what is done.
///   MPI   : needs MPI_THREAD_SERIALIZED. One thread at a time calls MPI.
class MpiRanks {
 public:
  /// Collective. The communicator must outlive this.
  explicit MpiRanks(MPI_Comm communicator);
  ~MpiRanks();
  MpiRanks(const MpiRanks&) = delete;
  MpiRanks& operator=(const MpiRanks&) = delete;

  /// Number of this process in the communicator.
  int rank() const;
  /// Number of processes.
  int size() const;
  /// The ranks as an executor. It must not outlive this.
  Executor executor();

  /// Tells rank 0 why this rank cannot go on; on rank 0 without effect.
  void report_failure(const std::string& reason);
  /// Ends the work of all ranks. Returns false on rank 0 where a rank died or did not answer within 10 s: then
  /// MPI_Finalize would wait for ever, and MPI_Abort is left.
  bool finish();

 private:
  class First;
  class Other;

  std::unique_ptr<detail::MpiLinks> links_;
};

} // namespace mc

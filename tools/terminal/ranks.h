#pragma once
/// The ranks of MPI on which carlo runs.

#include <mc/run/executor.h>

#include <string>

namespace carlo {

/// During its lifetime, the processes that mpirun started are ranks of one run. Rank 0 prints and writes; the others
/// print nothing. Without mpirun it does nothing.
///   throws : Error under mpirun where carlo was built without MPI.
class Ranks {
 public:
  Ranks();
  /// Ends all ranks.
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  /// Tells rank 0 why this rank cannot go on.
  static void report_failure(const std::string& reason);
};

/// Number of this process among the ranks; 0 without MPI.
int rank();
/// Number of ranks; 1 without MPI.
int rank_count();
/// The ranks together as an executor; empty where there is one.
mc::Executor ranks_executor();

} // namespace carlo

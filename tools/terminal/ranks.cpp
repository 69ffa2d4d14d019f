#include <terminal/ranks.h>

#include <mc/core/error.h>
#ifdef CARLO_MPI
#include <mc/run/mpi_ranks.h>
#endif

#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <memory>

namespace carlo {

namespace {

// Number of processes that a launcher of MPI started; 1 without one.
int launched() {
  for (const char* variable : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"})
    if (const char* text = std::getenv(variable)) {
      const bool is_mpi = std::string(variable) != "SLURM_STEP_NUM_TASKS" || std::getenv("PMIX_NAMESPACE");
      if (const int count = std::atoi(text); is_mpi && count > 0) return count;
    }
  return 1;
}

} // namespace

#ifdef CARLO_MPI

namespace {

std::unique_ptr<mc::MpiRanks> all_ranks; // of the program, from MPI_Init to MPI_Finalize

void print_nothing() {
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  close(nowhere);
}

} // namespace

Ranks::Ranks() {
  if (launched() == 1) return;
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
  all_ranks = std::make_unique<mc::MpiRanks>(MPI_COMM_WORLD);
  if (rank() != 0) print_nothing();
}

Ranks::~Ranks() {
  if (!all_ranks) return;
  std::fflush(nullptr);
  if (!all_ranks->finish()) MPI_Abort(MPI_COMM_WORLD, 1); // MPI_Finalize would wait for a rank that died
  all_ranks.reset();
  MPI_Finalize();
}

void Ranks::report_failure(const std::string& reason) {
  if (all_ranks) all_ranks->report_failure(reason);
}

int rank() { return all_ranks ? all_ranks->rank() : 0; }
int rank_count() { return all_ranks ? all_ranks->size() : 1; }
mc::Executor ranks_executor() { return rank_count() > 1 ? all_ranks->executor() : mc::Executor(); }

#else

Ranks::Ranks() {
  const int count = launched();
  mc::require(count == 1,
              "this carlo was built without MPI, and {} processes were started: each would do the whole work; "
              "build it with -DMC_MPI=ON, or start one",
              count);
}
Ranks::~Ranks() = default;
void Ranks::report_failure(const std::string&) {}

int rank() { return 0; }
int rank_count() { return 1; }
mc::Executor ranks_executor() { return {}; }

#endif

} // namespace carlo

// A job whose units sleep, on the ranks of MPI: what the messages of many ranks cost, on a machine of few processors.
//   mpirun --oversubscribe -n RANKS bench_mc_run_sleeping_ranks UNITS SECONDS BYTES STAGES
// prints: ranks, units of a stage, seconds of a unit, bytes of a result, stages, wall-clock seconds, CPU seconds of
// rank 0.

#include <mc/core/cpu_time.h>
#include <mc/run/job.h>
#include <mc/run/mpi_ranks.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>

namespace {

using Clock = std::chrono::steady_clock;

struct SleepingJob {
  using Result = std::string;

  std::size_t units, bytes;
  double seconds;
  std::uint64_t stages;
  std::uint64_t sum = 0;

  std::size_t next_stage() {
    if (stages == 0) return 0;
    --stages;
    return units;
  }
  std::optional<Result> compute(std::size_t unit) const {
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    return Result(bytes, static_cast<char>(unit));
  }
  void absorb(std::size_t unit, const Result& result) {
    for (const char c : result) sum += static_cast<unsigned char>(c) + unit;
  }
  template <class Archive> void archive(Archive& a) { a(stages, sum); }
};

} // namespace

int main(int argc, char** argv) {
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_SERIALIZED, &provided);
  auto ranks = std::make_unique<mc::MpiRanks>(MPI_COMM_WORLD);
  if (argc == 5) {
    SleepingJob job{std::strtoull(argv[1], nullptr, 10), std::strtoull(argv[3], nullptr, 10), std::atof(argv[2]),
                    std::strtoull(argv[4], nullptr, 10)};
    SleepingJob first{1, 1, 0, 1}; // until all ranks have started
    mc::run_job(first, {.threads = 1, .executor = ranks->executor()});
    const Clock::time_point start = Clock::now();
    const double cpu = mc::clock_seconds(CLOCK_PROCESS_CPUTIME_ID);
    mc::run_job(job, {.threads = 1, .executor = ranks->executor()});
    if (ranks->rank() == 0)
      std::printf("%d,%zu,%g,%zu,%s,%.4f,%.4f\n", ranks->size(), job.units, job.seconds, job.bytes, argv[4],
                  std::chrono::duration<double>(Clock::now() - start).count(),
                  mc::clock_seconds(CLOCK_PROCESS_CPUTIME_ID) - cpu);
  } else if (ranks->rank() == 0)
    std::fprintf(stderr, "usage: bench_mc_run_sleeping_ranks UNITS SECONDS BYTES STAGES\n");
  ranks->finish();
  ranks.reset();
  MPI_Finalize();
}

#pragma once
// Tests with ranks of MPI: a test starts its own executable by mpirun, as one of the programs that the test files
// register. Only in builds with MC_MPI.

#include <support/files.h>
#include <support/run.h>

#include <mpi.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

namespace support {

/// Programs of ranks by their names. A program returns the exit code; MPI is initialised.
inline std::map<std::string, std::function<int()>>& mpi_programs() {
  static std::map<std::string, std::function<int()>> all;
  return all;
}

/// Registers a program.
inline bool add_mpi_program(const std::string& name, std::function<int()> program) {
  return mpi_programs().emplace(name, std::move(program)).second;
}

/// Runs the program that run_mpi() named, and ends the process; returns where it named none.
inline void run_named_mpi_program() {
  const char* name = std::getenv("MC_TEST_PROGRAM");
  if (!name || !std::getenv("OMPI_COMM_WORLD_SIZE")) return;
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
  const int code = mpi_programs().at(name)();
  std::fflush(nullptr);
  MPI_Finalize();
  std::_Exit(code);
}

/// Runs a named program in place of the tests.
struct MpiEnvironment : testing::Environment {
  void SetUp() override { run_named_mpi_program(); }
};
inline testing::Environment* const mpi_environment = testing::AddGlobalTestEnvironment(new MpiEnvironment);

struct MpiTest : ScratchTest {
  /// Runs a program on ranks; MC_TEST_FOLDER is the folder of the test.
  ProcessResult run_mpi(const std::string& program, int ranks, const std::string& options = "") const {
    return run(
        fmt::format("MC_TEST_FOLDER='{}' MC_TEST_PROGRAM='{}' mpirun --oversubscribe --allow-run-as-root {} -n {} "
                    "'{}'",
                    path(""), program, options, ranks, std::filesystem::read_symlink("/proc/self/exe").string()));
  }
};

} // namespace support

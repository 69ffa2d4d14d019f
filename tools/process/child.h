#pragma once
/// Starts other programs without a shell.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace carlo {

struct LaunchOptions {
  std::vector<std::string> arguments; ///< the program first; without a slash it is searched in PATH
  std::string folder = {};            ///< working directory; empty: the current one
  std::string output_file = {};       ///< file for both output streams; empty: output() is a pipe
  int shared = -1;                    ///< a file that the program receives as descriptor 3; -1: none
};

/// A running program in its own process group. The destructor ends the whole group. Standard input and output are pipes
/// unless the output goes to a file. Signal handlers and masks are reset to their defaults.
class ChildProcess {
 public:
  /// throws : Error if the program cannot be started, "cannot start 'gnuplot': No such file or directory"
  explicit ChildProcess(const LaunchOptions& launch);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  int input() const { return input_; }   ///< write end of the program's standard input
  int output() const { return output_; } ///< read end of the program's standard output; -1 if the output goes to a file
  void close_input();
  /// Waits for output or for the end of the pipe. Returns false if the program has ended without further output, even
  /// if a process that it started still holds the pipe open.
  bool has_output() const;
  /// Whether the program itself has ended. Processes that it started may still run.
  bool has_ended() const;
  /// Number of output bytes that can be read without waiting.
  std::size_t available_bytes() const;
  /// Waits for the end of the program. Returns its exit code, or 128 + the number of the signal that ended it.
  int wait();
  /// Peak memory of the program and of any process that it waited for [bytes]: the largest single one. 0 before wait().
  double peak_memory() const { return peak_; }

 private:
  pid_t id_ = -1;
  double peak_ = 0;
  int input_ = -1, output_ = -1;
};

/// Runs the program to its end with an empty input. Returns its exit code, or nothing if the program does not exist.
std::optional<int> run_program(const LaunchOptions& launch);

/// Writes all bytes. Returns false if the read end is closed.
bool write_all(int file, const void* bytes, std::size_t size);

} // namespace carlo

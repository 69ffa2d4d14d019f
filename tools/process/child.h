#pragma once
/// Other programs, started without a shell.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace carlo {

struct LaunchOptions {
  std::vector<std::string> arguments; ///< the program first; without a slash it is looked for in PATH
  std::string folder = {};            ///< to work in; empty: ours
  std::string output_file = {};       ///< what the program prints on either stream goes there; empty: to our streams
};

/// A running program in a process group of its own, which ends with the object. Its input and output are pipes to us
/// unless the output goes to a file; signals are as at the start of a program.
class ChildProcess {
 public:
  /// throws : Error when the program cannot be started, "cannot start 'gnuplot': No such file or directory"
  explicit ChildProcess(const LaunchOptions& launch);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  int input() const { return input_; }   ///< what we write to
  int output() const { return output_; } ///< what we read from; -1 where the output goes to a file
  void close_input();
  /// Waits until there is something to read or nobody is left to write it. Returns false when the program itself has
  /// ended and left nothing, though a process that it started may still hold its end of the pipe.
  bool has_output() const;
  /// Bytes of its output that can be read without waiting.
  std::size_t available_bytes() const;
  /// Its exit code once it has ended; 128 + the number of the signal that ended it.
  int wait();
  /// The most memory that it, or any that it waited for, held at once [bytes]; 0 until wait() has returned.
  double peak_memory() const { return peak_; }

 private:
  pid_t id_ = -1;
  double peak_ = 0;
  int input_ = -1, output_ = -1;
};

/// Runs the program to its end with an empty input. Returns its exit code; nothing when there is no such program.
std::optional<int> run_program(const LaunchOptions& launch);

/// Writes all of it. Returns false when nobody reads any more.
bool write_all(int file, const void* bytes, std::size_t size);

} // namespace carlo

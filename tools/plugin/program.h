#pragma once
/// A program that answers questions over pipes.
///
/// Protocol: carlo writes questions to the program's standard input, each a line "WHAT N K\n" followed by N K numbers.
/// It reads the answer from the program's standard output, which contains N C numbers only, without a line. Numbers are
/// IEEE doubles of 8 bytes, least significant byte first. The program answers each question before it reads the next,
/// flushes, and ends at the end of its input. Equal questions have equal answers.

#include <plugin/run_isolated.h>
#include <process/child.h>

#include <mc/core/cpu_time.h>

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace carlo {

/// A running program. The monitor records each question.
class Program {
 public:
  static constexpr std::size_t most_rows = 4096; ///< of one question

  /// throws : Error if the shell cannot be started
  Program(const std::string& command, CallMonitor& monitor);

  /// Asks `what` about rows of `width` numbers, and fills `answer` with the same number of rows.
  ///   argument : the name of a row in messages, "u" or "x".
  ///   throws   : Error if the program ends, closes its output, or writes more numbers than the answer.
  void ask(const char* what, const char* argument, std::span<const double> rows, std::size_t width,
           std::span<double> answer);

  /// CPU seconds so far of the program and of the processes that it started, as far as they ran long enough to be seen.
  /// It never falls.
  double cpu_seconds();

 private:
  void exchange(const char* what, const std::string& question, std::span<double> answer);
  void require_silence();
  [[noreturn]] void ended(const char* what);

  ChildProcess child_;
  CallMonitor& monitor_;
  std::vector<pid_t> processes_;
  std::map<pid_t, double> seconds_;                   ///< of all processes seen so far
  double start_ = mc::clock_seconds(CLOCK_MONOTONIC); ///< steady seconds at which the program was started
  double next_look_ = 0;                              ///< steady seconds at which processes_ is read again
};

} // namespace carlo

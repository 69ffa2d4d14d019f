#pragma once
/// A program that is asked about few points at a time if it is slow.

#include <plugin/program.h>

#include <mc/core/cpu_time.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>

namespace carlo {

/// Asks questions that take at most about a second, so that a limit for one question suits fast and slow programs.
class PacedProgram {
 public:
  /// throws : Error if the shell cannot be started
  PacedProgram(const std::string& command, CallMonitor& monitor) : program_(command, monitor) {}

  /// See Program::ask.
  void ask(const char* what, const char* argument, std::span<const double> rows, std::size_t width,
           std::span<double> answer) {
    const std::size_t count = rows.size() / width, answer_width = answer.size() / count;
    for (std::size_t first = 0, n = 0; first < count; first += n) {
      n = std::min(rows_, count - first);
      const double start = mc::clock_seconds(CLOCK_MONOTONIC);
      program_.ask(what, argument, rows.subspan(first * width, n * width), width,
                   answer.subspan(first * answer_width, n * answer_width));
      const double seconds = mc::clock_seconds(CLOCK_MONOTONIC) - start;
      if (seconds > 0.5) rows_ = std::max<std::size_t>(n / 2, 1);
      else if (n == rows_ && seconds < 0.1) rows_ = std::min(2 * rows_, Program::most_rows);
    }
  }

  /// See Program::cpu_seconds.
  double cpu_seconds() { return program_.cpu_seconds(); }

 private:
  Program program_;
  std::size_t rows_ = 1;
};

} // namespace carlo

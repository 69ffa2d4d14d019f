#pragma once
/// A progress line on a terminal.

#include <chrono>
#include <string>

namespace carlo {

/// Redraws one line on stderr, at most ten times a second, and only when stderr is a terminal; the line is erased at
/// the end.
class Progress {
 public:
  Progress();
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `fraction` of the work in [0,1] is done; `text` says more (a rate, an error). The remaining time is extrapolated.
  void show(double fraction, const std::string& text);
  bool shows() const { return enabled_; } ///< else nobody need find out what to show
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  bool enabled_, drawn_ = false;
  Clock::time_point start_, last_;
};

/// "850 ms", "12.3 s", "4 min 05 s".
std::string format_seconds(double seconds);

/// "950", "12.3 k", "4.56 M", "1.20 G".
std::string format_count(double count);

} // namespace carlo

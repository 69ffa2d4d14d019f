#pragma once
/// A progress line on a terminal.

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

namespace carlo {

/// Redraws one line on stderr, at most ten times a second, and only when stderr is a terminal. Erases the line at the
/// end.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Redraws the line.
  ///   fraction : finished share of the work, in [0,1]; the remaining time is extrapolated from it.
  ///   text     : parts separated by two blanks, the most important one first, see progress_line.
  void show(double fraction, const std::string& text);
  bool is_visible() const { return enabled_; } ///< whether show() has an effect
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  bool enabled_, drawn_ = false;
  Clock::time_point start_, last_;
};

/// A line of at most `columns` columns: a bar, percent, the remaining time, and the parts of the text. The bar shrinks
/// first; then whole parts are left out from the end, and the words of the first part. No number is cut.
std::string progress_line(double fraction, const std::string& remaining, std::string_view text, std::size_t columns);

/// "850 ms", "12.3 s", "4 min 05 s", "13 h 53 min", "11 d 14 h", "31688 years".
std::string format_seconds(double seconds);

/// "950", "12.3 k", "4.56 M", "1.20 G".
std::string format_count(double count);

} // namespace carlo

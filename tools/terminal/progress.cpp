#include <terminal/columns.h>
#include <terminal/progress.h>

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace carlo {

ProgressLine::ProgressLine() : enabled_(isatty(STDERR_FILENO) != 0), start_(Clock::now()), last_(start_) {}

void ProgressLine::show(double fraction, const std::string& text) {
  const auto now = Clock::now();
  if (!enabled_ || now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const std::string remaining = fraction > 0 ? format_seconds(elapsed / fraction * (1 - fraction)) + " left" : "";
  const std::string line = progress_line(fraction, remaining, text, terminal_columns(STDERR_FILENO) - 1);
  std::fprintf(stderr, "\r\033[K%s", line.c_str());
  std::fflush(stderr);
  drawn_ = true;
}

std::string progress_line(double fraction, const std::string& remaining, std::string_view text, std::size_t columns) {
  constexpr std::size_t widest_bar = 24, narrowest_bar = 4;
  fraction = std::clamp(fraction, 0.0, 1.0);
  const std::string numbers = fmt::format("{:3.0f} %  {}", 100 * fraction, remaining);
  const std::size_t fixed = columns_of(numbers) + 5; // with the brackets of the bar and the blanks between the parts
  // Without room for the narrowest bar, shorten the text at the last gap that fits: between parts, else between words.
  const std::size_t room = columns - std::min(columns, fixed + narrowest_bar);
  for (const std::string_view gap : {"  ", " "})
    while (columns_of(text) > room && text.find(gap) != text.npos) text = text.substr(0, text.rfind(gap));
  if (columns_of(text) > room) text = {};
  const std::size_t used = fixed + columns_of(text);
  const std::size_t width = std::clamp(columns - std::min(columns, used), narrowest_bar, widest_bar);
  const auto filled = static_cast<std::size_t>(std::lround(fraction * static_cast<double>(width)));
  return fmt::format("[{:=<{}}{: <{}}] {}  {}", "", filled, "", width - filled, numbers, text);
}

void ProgressLine::clear() {
  if (drawn_) std::fprintf(stderr, "\r\033[K");
  drawn_ = false;
}

std::string format_seconds(double seconds) {
  if (seconds < 0.9995) return fmt::format("{:.0f} ms", 1000 * seconds);
  if (seconds < 59.95) return fmt::format("{:.1f} s", seconds);
  constexpr double hour = 3600, day = 24 * hour, year = 365.25 * day;
  if (seconds >= 1000 * day) return fmt::format("{:.0f} years", seconds / year);
  const long whole = std::lround(seconds), minutes = std::lround(seconds / 60), hours = std::lround(seconds / hour);
  if (hours >= 48) return fmt::format("{} d {:02} h", hours / 24, hours % 24);
  if (whole >= 3600) return fmt::format("{} h {:02} min", minutes / 60, minutes % 60);
  return fmt::format("{} min {:02} s", whole / 60, whole % 60);
}

std::string format_count(double count) {
  if (count < 999.5) return fmt::format("{:.0f}", count);
  constexpr const char* units[] = {"k", "M", "G", "T"};
  int unit = -1;
  while (count >= 999.5 && unit < 3) {
    count /= 1000;
    ++unit;
  }
  return fmt::format("{:.3g} {}", count, units[unit]);
}

} // namespace carlo

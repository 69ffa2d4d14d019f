#include <terminal/progress.h>

#include <fmt/format.h>

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace carlo {

Progress::Progress() : enabled_(isatty(STDERR_FILENO) != 0), start_(Clock::now()), last_(start_) {}

void Progress::show(double fraction, const std::string& text) {
  const auto now = Clock::now();
  if (!enabled_ || now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  fraction = std::clamp(fraction, 0.0, 1.0);
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const std::string remaining = fraction > 0 ? format_seconds(elapsed / fraction * (1 - fraction)) + " left" : "";
  constexpr int width = 24;
  const int filled = static_cast<int>(std::lround(fraction * width));
  std::string line = fmt::format("[{:=<{}}{: <{}}] {:3.0f} %  {}  {}", "", filled, "", width - filled, 100 * fraction,
                                 remaining, text);
  winsize window{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 1 && line.size() >= window.ws_col)
    line.resize(window.ws_col - 1u);
  std::fprintf(stderr, "\r\033[K%s", line.c_str());
  std::fflush(stderr);
  drawn_ = true;
}

void Progress::clear() {
  if (drawn_) std::fprintf(stderr, "\r\033[K");
  drawn_ = false;
}

std::string format_seconds(double seconds) {
  if (seconds < 0.9995) return fmt::format("{:.0f} ms", 1000 * seconds);
  if (seconds < 59.95) return fmt::format("{:.1f} s", seconds);
  const long whole = std::lround(seconds);
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

#include <plugin/program.h>
#include <process/tree.h>

#include <mc/core/error.h>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <csignal>

namespace carlo {

namespace {

// For a program that may have run out of memory: "; it held 0.97 GiB of memory of the 1 that --memory allows".
std::string near_limit(double peak) {
  rlimit memory{};
  if (getrlimit(RLIMIT_AS, &memory) != 0 || memory.rlim_cur == RLIM_INFINITY) return {};
  const double most = static_cast<double>(memory.rlim_cur);
  if (!(peak >= 0.9 * most)) return {};
  return fmt::format("; it held {:.3g} GiB of memory of the {:g} that --memory allows", peak / 0x1p30, most / 0x1p30);
}

} // namespace

Program::Program(const std::string& command, CallMonitor& monitor)
    : child_({{"/bin/sh", "-c", command}}), monitor_(monitor) {
  std::signal(SIGPIPE, SIG_IGN); // a write to a program that has ended then returns an error
  fcntl(child_.input(), F_SETFL, O_NONBLOCK);
}

void Program::ask(const char* what, const char* argument, std::span<const double> rows, std::size_t width,
                  std::span<double> answer) {
  static_assert(std::endian::native == std::endian::little);
  const std::size_t count = rows.size() / width, answer_width = answer.size() / std::max<std::size_t>(count, 1);
  for (std::size_t first = 0; first < count; first += most_rows) {
    const std::size_t n = std::min(most_rows, count - first);
    const std::span<const double> in = rows.subspan(first * width, n * width);
    require_silence(); // extra bytes would be read as part of the next answer
    monitor_.enter(what, argument, in.data(),
                   static_cast<int>(std::min<std::size_t>(width, CallMonitor::max_arguments)));
    // A single write: for single points, system calls dominate the cost.
    std::string question = fmt::format("{} {} {}\n", what, n, width);
    question.append(reinterpret_cast<const char*>(in.data()), in.size_bytes());
    exchange(what, question, answer.subspan(first * answer_width, n * answer_width));
    monitor_.leave();
    require_silence();
  }
}

void Program::require_silence() {
  const std::size_t more = child_.available_bytes();
  mc::require(more == 0, "it wrote {} bytes more than the answer; it must write nothing else to standard output", more);
}

// Reads while it writes: a program may answer a long question row by row.
void Program::exchange(const char* what, const std::string& question, std::span<double> answer) {
  char* const to = reinterpret_cast<char*>(answer.data());
  std::size_t sent = 0, got = 0;
  constexpr int interval = 50; // ms between two checks of the program
  while (sent < question.size() || got < answer.size_bytes()) {
    const bool reads = got < answer.size_bytes(), writes = sent < question.size();
    pollfd p[] = {{reads ? child_.output() : -1, POLLIN, 0}, {writes ? child_.input() : -1, POLLOUT, 0}};
    const int ready = poll(p, 2, interval);
    // A process that the program started may keep the pipe open.
    if (ready == 0 && child_.has_ended() && poll(p, 1, 0) == 0) ended(what);
    if (ready <= 0) continue;
    if (p[1].revents != 0) {
      const ssize_t n = write(child_.input(), question.data() + sent, question.size() - sent);
      if (n < 0 && errno != EAGAIN && errno != EINTR) ended(what);
      if (n > 0) sent += static_cast<std::size_t>(n);
    }
    if (p[0].revents != 0) {
      const ssize_t n = read(child_.output(), to + got, answer.size_bytes() - got);
      if (n == 0 || (n < 0 && errno != EINTR)) ended(what);
      if (n > 0) got += static_cast<std::size_t>(n);
      monitor_.answered(got / sizeof(double), answer.size());
    }
  }
}

void Program::ended(const char* what) {
  monitor_.leave();
  for (int i = 0; i < 100 && !child_.has_ended(); ++i) poll(nullptr, 0, 10); // ms
  mc::require(child_.has_ended(), "the program closed a pipe instead of answering '{}'", what);
  const int code = child_.wait();
  throw mc::Error(fmt::format("the program ended with code {} instead of answering '{}'{}", code, what,
                              near_limit(child_.peak_memory())));
}

double Program::cpu_seconds() {
  // Reading the list of processes takes milliseconds. A young program may still start processes.
  const double now = mc::clock_seconds(CLOCK_MONOTONIC);
  if (now >= next_look_) {
    processes_ = descendants(getpid());
    next_look_ = now + std::clamp(now - start_, 0.01, 1.0);
  }
  for (const pid_t id : processes_) {
    clockid_t clock{};
    if (clock_getcpuclockid(id, &clock) == 0) seconds_[id] = std::max(seconds_[id], mc::clock_seconds(clock));
  }
  double sum = 0;
  for (const auto& [id, seconds] : seconds_) sum += seconds;
  return sum;
}

} // namespace carlo

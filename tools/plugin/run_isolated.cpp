#include <plugin/run_isolated.h>
#include <process/tree.h>

#include <mc/core/error.h>

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <thread>
#include <vector>

namespace carlo {

namespace {

using Clock = std::chrono::steady_clock;

struct Unmap {
  void operator()(CallMonitor* w) const { munmap(w, sizeof(CallMonitor)); }
};

// The first byte of the child's message, which describes how the work ended. The length of the text follows, to detect
// a truncated message, and then the text: the result or the error.
enum Ending : char { returned = 'r', refused = 'e', threw = 't', exhausted = 'm' };

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

void limit(int resource, double most) {
  const auto value = static_cast<rlim_t>(most);
  const rlimit both{value, value};
  setrlimit(static_cast<__rlimit_resource_t>(resource), &both);
}

// Replaces the standard streams, and closes every other descriptor. Otherwise this child would keep the pipes of
// concurrent children open. Programs that the child starts inherit none of the descriptors above 2.
void set_descriptors(int pipe, bool stays) {
  constexpr int high = 10; // above every descriptor that is assigned below
  const int result = fcntl(pipe, F_DUPFD, high), input = fcntl(STDIN_FILENO, F_DUPFD, high),
            output = fcntl(STDOUT_FILENO, F_DUPFD, high), memory = stays ? fcntl(3, F_DUPFD, high) : -1;
  dup2(STDERR_FILENO, STDOUT_FILENO);
  dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
  dup3(result, 3, O_CLOEXEC);
  if (stays) {
    dup3(input, session_input, O_CLOEXEC);
    dup3(output, session_output, O_CLOEXEC);
    dup3(memory, session_memory, O_CLOEXEC);
  }
  close_range(stays ? session_memory + 1 : 4, ~0u, 0);
}

[[noreturn]] void run_child(int pipe, const ResourceLimits& limits, CallMonitor& monitor,
                            const std::function<std::string(CallMonitor&)>& work, bool stays) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_NOFILE, limits.files);
  if (!sanitized) limit(RLIMIT_AS, limits.gigabytes * 0x1p30);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTERM, SIGPIPE}) std::signal(signal, SIG_DFL);
  set_descriptors(pipe, stays);

  std::string text;
  char ending = returned;
  try {
    text = work(monitor);
  } catch (const std::bad_alloc&) {
    ending = exhausted;
  } catch (const std::exception& e) {
    ending = monitor.inside() ? threw : refused;
    text = e.what();
  } catch (...) {
    ending = threw;
    text = "something that is no std::exception";
  }
  const std::uint64_t size = text.size();
  std::string message(1, ending);
  message.append(reinterpret_cast<const char*>(&size), sizeof size).append(text);
  for (std::size_t sent = 0; sent < message.size();) {
    const ssize_t n = write(3, message.data() + sent, message.size() - sent);
    if (n < 0 && errno != EINTR) _exit(1);
    if (n > 0) sent += static_cast<std::size_t>(n);
  }
  _exit(0);
}

// Orphans of the work become children of this process (PR_SET_CHILD_SUBREAPER). When they are killed, their children
// follow in turn.
void end_descendants() {
  for (;;) {
    for (const pid_t one : children(getpid())) kill(one, SIGKILL);
    if (waitpid(-1, nullptr, 0) < 0 && errno == ECHILD) return;
  }
}

bool hung_up(int descriptor) {
  pollfd p{descriptor, 0, 0};
  return poll(&p, 1, 0) > 0 && (p.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0;
}

bool whole(const std::string& message) {
  std::uint64_t size = 0;
  if (message.size() < 1 + sizeof size) return false;
  std::memcpy(&size, message.data() + 1, sizeof size);
  return message.size() == 1 + sizeof size + size;
}

} // namespace

std::string CallMonitor::where() const {
  const char* function = function_.load(std::memory_order_relaxed);
  if (!function) return fmt::format(" after {} calls", calls());
  std::string text = fmt::format(" in {}", function);
  for (int i = 0; i < n_; ++i)
    text += i == 0 ? fmt::format(" at {} = ({:.17g}", argument_, values_[0]) : fmt::format(", {:.17g}", values_[i]);
  if (n_ > 0) text += ")";
  if (wanted_ > 0) text += fmt::format(", where {} of {} numbers have come (doubles of 8 bytes)", answered_, wanted_);
  return text;
}

ResourceLimits resource_limits(std::optional<double> timeout, std::optional<double> memory, bool has_foreign_code) {
  mc::require(has_foreign_code || !(timeout || memory), "{} is for foreign code: a --plugin or a --command",
              timeout ? "--timeout" : "--memory");
  ResourceLimits limits;
  limits.seconds = timeout.value_or(limits.seconds);
  limits.gigabytes = memory.value_or(limits.gigabytes);
  mc::require(limits.seconds > 0 && limits.seconds <= 1e6, "--timeout {} must lie in (0, 1e6] seconds", limits.seconds);
  mc::require(limits.gigabytes >= 0.25 && limits.gigabytes <= 1e6, "--memory {} must lie in [0.25, 1e6] GiB",
              limits.gigabytes);
  return limits;
}

namespace {

// Checks the total memory of the child and of all processes that it started: each of them may use up to the limit of a
// single process.
class MemoryOfAll {
 public:
  explicit MemoryOfAll(const ResourceLimits& limits) : most_(limits.gigabytes * 0x1p30) {}

  // Whether the total exceeds the limit. Pages that several processes share count once, so a fork does not double them.
  bool is_beyond() {
    const auto start = Clock::now();
    if (sanitized || start < next_) return false;
    const std::vector<pid_t> all = descendants(getpid());
    const bool beyond = resident_bytes(all) > most_ && proportional_bytes(all) > most_;
    const auto end = Clock::now();
    // With thousands of processes a check takes milliseconds. Checks use at most about a twentieth of the time.
    next_ = end + std::max<Clock::duration>(std::chrono::milliseconds(100), 20 * (end - start));
    return beyond;
  }

 private:
  double most_;
  Clock::time_point next_{};
};

// State of the child when the parent stopped waiting.
struct Ended {
  std::string message;
  bool dead = false; // ended by itself
  bool given_up = false;
  bool exhausted = false; // exceeded the memory limit
  int status = 0;
  double active = 0;  // seconds since the first call began
  double stalled = 0; // seconds since the call count last increased
};

Ended wait_for(pid_t child, int pipe, const CallMonitor& monitor, const ResourceLimits& limits, int hangup,
               bool stays) {
  const double timeout = limits.seconds;
  auto start = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  Ended e;
  std::uint64_t calls = 0;
  std::optional<double> began; // time of the first call: on a busy machine it may start late
  double moved = 0;
  bool open = true;
  MemoryOfAll memory(limits);
  while (!e.dead && !whole(e.message) && elapsed() < timeout && !e.given_up && !e.exhausted) {
    if (open) {
      pollfd p{pipe, POLLIN, 0};
      if (poll(&p, 1, static_cast<int>(std::clamp(1000 * (timeout - elapsed()), 1.0, 50.0))) > 0) {
        char buffer[1 << 16];
        const ssize_t n = read(pipe, buffer, sizeof buffer);
        if (n > 0) e.message.append(buffer, static_cast<std::size_t>(n));
        else if (n == 0) open = false;
      }
    } else {
      e.dead = waitpid(child, &e.status, WNOHANG) == child;
      if (!e.dead) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (stays && (monitor.is_idle() || monitor.calls() != calls)) {
      start = Clock::now();
      began = moved = 0;
      calls = monitor.calls();
    }
    if (!began && (monitor.inside() || monitor.calls() > 0)) began = moved = elapsed();
    if (monitor.calls() != calls) {
      calls = monitor.calls();
      moved = elapsed();
    }
    e.given_up = hung_up(hangup);
    e.exhausted = memory.is_beyond();
  }
  e.active = began ? elapsed() - *began : 0;
  e.stalled = elapsed() - moved;
  if (!e.dead) {
    kill(child, SIGKILL);
    while (waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  return e;
}

mc::Error too_much_memory(const std::string& who, const ResourceLimits& limits, const CallMonitor& monitor) {
  return mc::Error(
      fmt::format("{}: it needs more than {:g} GiB of memory{} (--memory)", who, limits.gigabytes, monitor.where()));
}

[[noreturn]] void complain(const std::string& who, const ResourceLimits& limits, const CallMonitor& monitor,
                           const Ended& e) {
  if (e.given_up) throw mc::Error(fmt::format("{}: interrupted", who));
  if (e.exhausted) throw too_much_memory(who, limits, monitor);
  if (!e.dead && monitor.inside() && e.stalled > 0.5 * e.active)
    throw mc::Error(
        fmt::format("{}: it hangs{}: no answer in {:g} s (--timeout)", who, monitor.where(), limits.seconds));
  if (!e.dead)
    throw mc::Error(fmt::format("{}: not done in {:g} s,{}; raise --timeout or lower {}", who, limits.seconds,
                                monitor.where(), limits.reduce_option));
  if (WIFSIGNALED(e.status))
    throw mc::Error(fmt::format("{}: it crashed{}: {} (signal {})", who, monitor.where(), strsignal(WTERMSIG(e.status)),
                                WTERMSIG(e.status)));
  throw mc::Error(fmt::format("{}: it ended the process{} with exit code {}; it must return", who, monitor.where(),
                              WEXITSTATUS(e.status)));
}

} // namespace

std::string run_isolated(const std::string& who, const ResourceLimits& limits, int hangup,
                         const std::function<std::string(CallMonitor&)>& work, bool stays) {
  const auto system_error = [&](const char* what) {
    return mc::Error(fmt::format("{}: {}: {}", who, what, std::strerror(errno)));
  };
  void* memory = mmap(nullptr, sizeof(CallMonitor), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw system_error("no shared memory");
  const std::unique_ptr<CallMonitor, Unmap> monitor(new (memory) CallMonitor);
  int ends[2];
  if (pipe(ends) != 0) throw system_error("no pipe");
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  const pid_t child = fork();
  if (child < 0) throw system_error("no child process");
  if (child == 0) run_child(ends[1], limits, *monitor, work, stays);
  close(ends[1]);
  const Ended ended = wait_for(child, ends[0], *monitor, limits, hangup, stays);
  close(ends[0]);
  end_descendants();

  if (ended.exhausted || !whole(ended.message)) complain(who, limits, *monitor, ended);
  std::string text = ended.message.substr(1 + sizeof(std::uint64_t));
  switch (ended.message[0]) {
  case returned: return text;
  case threw: throw mc::Error(fmt::format("{}: it threw{}: {}", who, monitor->where(), text));
  case exhausted: throw too_much_memory(who, limits, *monitor);
  default: throw mc::Error(fmt::format("{}: {}", who, text));
  }
}

} // namespace carlo

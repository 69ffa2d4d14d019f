#include <plugin/isolated.h>

#include <mc/core/error.h>

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
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <thread>

namespace carlo {

namespace {

using Clock = std::chrono::steady_clock;

struct Unmap {
  void operator()(Watch* w) const { munmap(w, sizeof(Watch)); }
};

// What the child sends: how the work ended, then its result or the error's text. Length first, so that a cut message
//                       shows.
enum Ending : char { returned = 'r', refused = 'e', threw = 't' };

[[noreturn]] void run_child(int pipe, Watch& watch, const std::function<std::string(Watch&)>& work) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTERM, SIGPIPE}) std::signal(signal, SIG_DFL);
  dup2(STDERR_FILENO, STDOUT_FILENO);
  // The pipes of children beside this one would keep their ends open.
  if (pipe != 3) dup2(pipe, 3);
  close_range(4, ~0u, 0);

  std::string text;
  char ending = returned;
  try {
    text = work(watch);
  } catch (const std::exception& e) {
    ending = watch.inside() ? threw : refused;
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

bool whole(const std::string& message) {
  std::uint64_t size = 0;
  if (message.size() < 1 + sizeof size) return false;
  std::memcpy(&size, message.data() + 1, sizeof size);
  return message.size() == 1 + sizeof size + size;
}

} // namespace

std::string Watch::where() const {
  const char* function = function_.load(std::memory_order_relaxed);
  if (!function) return fmt::format(" after {} calls", calls());
  std::string text = fmt::format(" in {}", function);
  for (int i = 0; i < n_; ++i)
    text += i == 0 ? fmt::format(" at {} = ({:.17g}", argument_, values_[0]) : fmt::format(", {:.17g}", values_[i]);
  return n_ > 0 ? text + ")" : text;
}

std::string run_isolated(const std::string& who, double timeout, const std::function<std::string(Watch&)>& work) {
  const auto system_error = [&](const char* what) {
    return mc::Error(fmt::format("{}: {}: {}", who, what, std::strerror(errno)));
  };
  void* memory = mmap(nullptr, sizeof(Watch), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw system_error("no shared memory");
  const std::unique_ptr<Watch, Unmap> watch(new (memory) Watch);
  int ends[2];
  if (pipe(ends) != 0) throw system_error("no pipe");
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) {
    close(ends[0]), close(ends[1]);
    throw system_error("no child process");
  }
  if (child == 0) run_child(ends[1], *watch, work);
  close(ends[1]);

  const auto start = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  std::string message;
  std::uint64_t calls = 0;
  double moved = 0; // when the count of calls was last seen to grow
  bool open = true, dead = false;
  int status = 0;
  while (!dead && !whole(message) && elapsed() < timeout) {
    if (open) {
      pollfd p{ends[0], POLLIN, 0};
      if (poll(&p, 1, static_cast<int>(std::clamp(1000 * (timeout - elapsed()), 1.0, 50.0))) > 0) {
        char buffer[1 << 16];
        const ssize_t n = read(ends[0], buffer, sizeof buffer);
        if (n > 0) message.append(buffer, static_cast<std::size_t>(n));
        else if (n == 0) open = false;
      }
      if (watch->calls() != calls) calls = watch->calls(), moved = elapsed();
    } else {
      dead = waitpid(child, &status, WNOHANG) == child;
      if (!dead) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  if (!dead) {
    kill(child, SIGKILL);
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
  }
  close(ends[0]);

  if (!whole(message)) {
    if (!dead && watch->inside() && elapsed() - moved > 0.5 * timeout)
      throw mc::Error(fmt::format("{}: it hangs{}: no answer in {:g} s (--timeout)", who, watch->where(), timeout));
    if (!dead)
      throw mc::Error(
          fmt::format("{}: not done in {:g} s,{}; raise --timeout or lower --samples", who, timeout, watch->where()));
    if (WIFSIGNALED(status))
      throw mc::Error(fmt::format("{}: it crashed{}: {} (signal {})", who, watch->where(), strsignal(WTERMSIG(status)),
                                  WTERMSIG(status)));
    throw mc::Error(fmt::format("{}: it ended the process{} with exit code {}; it must return", who, watch->where(),
                                WEXITSTATUS(status)));
  }
  std::string text = message.substr(1 + sizeof(std::uint64_t));
  if (message[0] == returned) return text;
  if (message[0] == threw) throw mc::Error(fmt::format("{}: it threw{}: {}", who, watch->where(), text));
  throw mc::Error(fmt::format("{}: {}", who, text));
}

} // namespace carlo

#include <terminal/interrupt.h>

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>

namespace carlo {

namespace {

constexpr std::array signals = {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGXCPU};

// Sends output to /dev/null where it is a terminal. Calls only functions that a signal handler may call.
void leave_terminal() {
  const int saved = errno;
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
    if (isatty(stream) == 0 && errno != EIO) continue; // EIO: a terminal that is gone
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    dup2(nowhere, stream);
    close(nowhere);
  }
  errno = saved;
}

// Asks without changing the handler: a signal that arrives meanwhile stays ignored.
bool is_ignored(int signal) {
  struct sigaction now {};
  return sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;
}

} // namespace

Interrupt::Interrupt() {
  raised = false;
  first_signal = 0;
  for (const int signal : signals)
    if (!is_ignored(signal)) std::signal(signal, raise);
}

Interrupt::~Interrupt() {
  for (const int signal : signals)
    if (!is_ignored(signal)) std::signal(signal, SIG_DFL);
}

void Interrupt::raise(int signal) {
  if (signal == SIGHUP) leave_terminal();
  int none = 0;
  first_signal.compare_exchange_strong(none, signal);
  raised = true;
  // A shell starts background programs with SIGINT ignored: then it stays so.
  if (!is_ignored(SIGINT)) std::signal(SIGINT, SIG_DFL);
}

} // namespace carlo

#pragma once
// Sends Ctrl-C on a terminal, or another signal, without a fixed delay.

#include <tools/run_carlo.h>

#include <pty.h>
#include <unistd.h>

#include <csignal>

namespace support {

/// Runs carlo on its own terminal and types Ctrl-C as soon as the output contains `sign`, by default a progress line.
/// Any other `signal` is sent directly.
inline ProcessResult interrupt_carlo(const std::string& arguments, const std::string& sign = "\033[K",
                                     int signal = SIGINT) {
  int terminal = -1;
  const std::string command = "exec '" CARLO_PATH "' " + arguments;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child == 0) {
    execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    _exit(127);
  }
  if (child < 0) return {-1, "cannot start " + command};
  std::string output;
  bool typed = false;
  std::array<char, 4096> buffer;
  // The read fails when the child ends.
  for (ssize_t n; (n = read(terminal, buffer.data(), buffer.size())) > 0;) {
    output.append(buffer.data(), static_cast<std::size_t>(n));
    if (typed || output.find(sign) == std::string::npos) continue;
    typed = signal == SIGINT ? write(terminal, "\003", 1) == 1 : kill(child, signal) == 0;
  }
  int status = 0;
  waitpid(child, &status, 0);
  close(terminal);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, output};
}

} // namespace support

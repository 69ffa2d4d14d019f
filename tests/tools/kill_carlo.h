#pragma once
// Kills carlo after it wrote a checkpoint, without a fixed delay.

#include <tools/run_carlo.h>

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <optional>

namespace support {

/// Runs carlo with its output in the file `log`. Kills it by SIGKILL as soon as its checkpoint was written `times`
/// times. Any moment is right: the number only makes it likely that the run is under way. Returns the exit code, or
/// nothing where it was killed.
inline std::optional<int> kill_carlo(const std::string& arguments, const std::string& checkpoint, int times,
                                     const std::string& log) {
  const auto inode = [&] {
    struct stat s {};
    return stat(checkpoint.c_str(), &s) == 0 ? s.st_ino : 0;
  };
  const std::string command = "exec '" CARLO_PATH "' " + arguments + " >'" + log + "' 2>&1";
  auto last = inode();
  const pid_t child = fork();
  if (child == 0) {
    execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    _exit(127);
  }
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (const auto now = inode(); now != last) {
      last = now;
      if (--times <= 0) kill(child, SIGKILL);
    }
    usleep(200);
  }
  if (WIFSIGNALED(status)) return {};
  return WEXITSTATUS(status);
}

} // namespace support

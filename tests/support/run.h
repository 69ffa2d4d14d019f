#pragma once
// Runs a command by the shell.

#include <array>
#include <cstdio>
#include <string>

#include <sys/wait.h>

namespace support {

struct ProcessResult {
  int exit_code;
  std::string output; ///< stdout and stderr
};

inline ProcessResult run(const std::string& command) {
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (!pipe) return {-1, "cannot start " + command};
  std::string output;
  std::array<char, 4096> buffer;
  for (std::size_t n; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) output.append(buffer.data(), n);
  const int status = pclose(pipe);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, output};
}

} // namespace support

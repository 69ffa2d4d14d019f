#pragma once
// Runs the carlo binary as a user does.

#include <array>
#include <cstdio>
#include <string>

#include <sys/wait.h>

namespace support {

struct Run {
  int exit_code;
  std::string output; ///< stdout and stderr
};

inline Run run_carlo(const std::string& arguments) {
  FILE* pipe = popen(("'" CARLO_PATH "' " + arguments + " 2>&1").c_str(), "r");
  if (!pipe) return {-1, "cannot start carlo"};
  std::string output;
  std::array<char, 4096> buffer;
  for (std::size_t n; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) output.append(buffer.data(), n);
  const int status = pclose(pipe);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, output};
}

} // namespace support

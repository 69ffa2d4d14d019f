#include <terminal/result_file.h>

#include <mc/core/error.h>
#include <mc/core/file.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <utility>

namespace carlo {

ResultFile::ResultFile(std::string name) : name_(std::move(name)) {
  if (!name_.empty() && name_ != "-") mc::require_writable(name_);
  if (name_ != "-") return;
  std::fflush(stdout);
  output_ = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1); // close-on-exec, so that child processes do not
                                                                      // inherit it
  mc::require(output_ >= 0 && dup2(STDERR_FILENO, STDOUT_FILENO) >= 0, "cannot write to standard output: {}",
              std::strerror(errno));
}

ResultFile::~ResultFile() {
  if (output_ < 0) return;
  std::fflush(stdout);
  dup2(output_, STDOUT_FILENO);
  close(output_);
}

void ResultFile::write(ResultWriter& results, bool is_partial, std::string_view bytes) const {
  if (output_ < 0) {
    results.write(name_, is_partial, bytes);
    return;
  }
  while (!bytes.empty()) {
    const ssize_t n = ::write(output_, bytes.data(), bytes.size());
    if (n < 0 && errno != EINTR) throw std::system_error(errno, std::generic_category(), "standard output");
    if (n > 0) bytes.remove_prefix(static_cast<std::size_t>(n));
  }
}

} // namespace carlo

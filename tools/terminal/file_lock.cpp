#include <terminal/file_lock.h>
#include <terminal/ranks.h>

#include <mc/core/error.h>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace carlo {

FileLock::FileLock(const std::string& path) {
  if (rank() != 0) return; // rank 0 locks it for all
  // Another process may replace the file between open() and flock(): then the lock is of the old file.
  for (bool is_current = false; !is_current;) {
    if (descriptor_ >= 0) close(descriptor_);
    descriptor_ = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    mc::require(descriptor_ >= 0, "cannot read '{}': {}", path, std::strerror(errno));
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      close(descriptor_);
      throw mc::Error(fmt::format("another run is working on '{}'; wait for its end", path));
    }
    struct stat locked {
    }, named{};
    is_current = fstat(descriptor_, &locked) != 0 || stat(path.c_str(), &named) != 0 ||
                 (locked.st_dev == named.st_dev && locked.st_ino == named.st_ino);
  }
}

FileLock::~FileLock() { close(descriptor_); }

} // namespace carlo

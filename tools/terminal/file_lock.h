#pragma once
/// Exclusive use of a file by one process.

#include <string>

namespace carlo {

/// Locks an existing file until its destruction, against other FileLocks of any process on this machine. Where the file
/// system has no locks, it does nothing.
class FileLock {
 public:
  /// throws : Error where another process holds the lock, or where the file cannot be read.
  explicit FileLock(const std::string& path);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int descriptor_ = -1;
};

} // namespace carlo

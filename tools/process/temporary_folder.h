#pragma once
/// A private folder for files that do not last.

#include <filesystem>
#include <string>
#include <vector>

namespace carlo {

/// $TMPDIR, if it is set, /tmp and /var/tmp.
std::vector<std::filesystem::path> temporary_parents();

/// A new folder in the first of temporary_parents() that can take one. The destructor removes it with its files.
class TemporaryFolder {
 public:
  /// throws : Error where no folder can be made.
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

} // namespace carlo

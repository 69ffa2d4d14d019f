#include <process/temporary_folder.h>

#include <mc/core/error.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

namespace carlo {

namespace fs = std::filesystem;

std::vector<fs::path> temporary_parents() {
  std::vector<fs::path> all = {"/tmp", "/var/tmp"};
  const char* chosen = std::getenv("TMPDIR"); // NOLINT(concurrency-mt-unsafe): nothing sets the environment
  if (chosen) all.insert(all.begin(), chosen);
  return all;
}

TemporaryFolder::TemporaryFolder() {
  for (const fs::path& parent : temporary_parents()) {
    std::string name = (parent / "carlo.XXXXXX").string();
    if (!mkdtemp(name.data())) continue;
    path_ = name;
    return;
  }
  throw mc::Error(
      fmt::format("cannot make a temporary folder: {}; set TMPDIR to a writable folder", std::strerror(errno)));
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code error;
  fs::remove_all(path_, error);
}

} // namespace carlo

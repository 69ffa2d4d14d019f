#include <mc/core/error.h>
#include <mc/core/file.h>

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>

namespace mc {

namespace fs = std::filesystem;

namespace {

fs::path folder_of(const fs::path& target) { return target.has_parent_path() ? target.parent_path() : fs::path("."); }

} // namespace

void require_writable(const std::string& path) {
  const fs::path target(path), folder = folder_of(target);
  std::error_code error;
  require(!target.filename().empty() && !fs::is_directory(target, error),
          "cannot write '{}': it is a folder; name a file in it", path);
  require(fs::is_directory(folder, error), "cannot write '{}': the folder '{}' does not exist; create it first", path,
          folder.string());
  require(access(folder.c_str(), W_OK) == 0, "cannot write '{}': the folder '{}' is not writable", path,
          folder.string());
}

void replace_file(const std::string& path, const std::function<void(const std::string&)>& write) {
  require_writable(path);
  const fs::path target(path), folder = folder_of(target);
  std::error_code error;
  const std::string temporary =
      (folder / fmt::format(".{}.{}.tmp{}", target.stem().string(), getpid(), target.extension().string())).string();
  try {
    write(temporary);
    fs::rename(temporary, target, error);
    require(!error, "cannot write '{}': {}", path, error.message());
  } catch (...) {
    fs::remove(temporary, error);
    throw;
  }
}

void write_file(const std::string& path, std::string_view bytes) {
  replace_file(path, [&](const std::string& temporary) {
    std::FILE* file = std::fopen(temporary.c_str(), "wb");
    require(file != nullptr, "cannot write '{}': {}", path, std::strerror(errno));
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
    const int write_error = errno;
    const bool closed = std::fclose(file) == 0; // a full disk may show only here
    require(written && closed, "cannot write '{}': {}", path, std::strerror(written ? errno : write_error));
  });
}

std::string read_file(const std::string& path) {
  std::error_code error;
  require(fs::exists(path, error), "cannot read '{}': no such file", path);
  require(!fs::is_directory(path, error), "cannot read '{}': it is a folder", path);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  require(file != nullptr, "cannot read '{}': {}", path, std::strerror(errno));
  std::string bytes;
  char buffer[1 << 16];
  for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, file.get())) > 0;) bytes.append(buffer, n);
  require(!std::ferror(file.get()), "cannot read '{}': {}", path, std::strerror(errno));
  return bytes;
}

} // namespace mc

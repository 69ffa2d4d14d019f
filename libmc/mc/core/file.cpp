#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/memory.h>

#include <fcntl.h>
#include <linux/magic.h>
#include <poll.h>
#include <sys/stat.h>
#include <sys/statfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

namespace mc {

namespace fs = std::filesystem;

namespace {

// Waits until a program has opened a named pipe for writing, and lets reads wait for bytes. Does nothing for an
// unnamed pipe, which has its writer from the start, and for other files. Returns the bytes that it read, one or none.
//   throws : Error where no program opens it in time.
std::string await_writer(int descriptor, const std::string& path) {
  constexpr int patience = 5000, step = 20; // ms
  struct stat status {};
  struct statfs system {};
  const bool is_named_pipe = fstat(descriptor, &status) == 0 && S_ISFIFO(status.st_mode) &&
                             fstatfs(descriptor, &system) == 0 && system.f_type != PIPEFS_MAGIC;
  std::string first;
  // A read of no writer gives 0 bytes at once; with a writer it gives EAGAIN or bytes, which poll() announces.
  for (int waited = 0; is_named_pipe; waited += step) {
    pollfd state{descriptor, POLLIN, 0};
    if (poll(&state, 1, 0) > 0) break;
    char byte = 0;
    const ssize_t n = read(descriptor, &byte, 1);
    if (n > 0) first = byte;
    if (n != 0) break;
    require(waited < patience, "cannot read '{}': it is a pipe, and no program wrote to it within {} s", path,
            patience / 1000);
    poll(nullptr, 0, step);
  }
  fcntl(descriptor, F_SETFL, fcntl(descriptor, F_GETFL) & ~O_NONBLOCK);
  return first;
}

} // namespace

std::string lowercase_extension(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

std::string read_file(const std::string& path) {
  std::error_code error;
  require(fs::exists(path, error), "cannot read '{}': no such file", path);
  require(!fs::is_directory(path, error), "cannot read '{}': it is a folder", path);
  require(!fs::is_character_file(path, error) && !fs::is_block_file(path, error),
          "cannot read '{}': it is a device, which may have no end; name a file or a pipe", path);
  const int descriptor = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
  require(descriptor >= 0, "cannot read '{}': {}", path, std::strerror(errno));
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(fdopen(descriptor, "rb"), &std::fclose);
  std::string bytes = await_writer(descriptor, path);
  const double size = double(fs::file_size(path, error)); // of a pipe: none
  if (!error) {
    require_memory(size, fmt::format("cannot read '{}': its bytes", path));
    bytes.reserve(static_cast<std::size_t>(size) + 1);
  }
  char buffer[1 << 16];
  for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, file.get())) > 0;) {
    if (bytes.size() + n > bytes.capacity())
      require_memory(2 * double(bytes.size() + n), fmt::format("cannot read '{}': its bytes", path));
    bytes.append(buffer, n);
  }
  require(!std::ferror(file.get()), "cannot read '{}': {}", path, std::strerror(errno));
  return bytes;
}

std::string read_text(const std::string& path) {
  std::string text = read_file(path);
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  return text;
}

} // namespace mc

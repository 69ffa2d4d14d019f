#include <mc/core/error.h>
#include <mc/core/file.h>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

namespace mc {

namespace fs = std::filesystem;

namespace {

fs::path folder_of(const fs::path& target) { return target.has_parent_path() ? target.parent_path() : fs::path("."); }

// Destination of the bytes.
struct OutputTarget {
  fs::path target; // not a symbolic link
  // set for a descriptor of this process, because /dev/stdout is a link into /proc/self/fd
  std::optional<int> descriptor;
  fs::file_type type = fs::file_type::not_found;

  bool is_replaced() const {
    return !descriptor && (type == fs::file_type::regular || type == fs::file_type::not_found);
  }
};

OutputTarget resolve_links(const std::string& path) {
  OutputTarget place{path, {}};
  for (int links = 0; links < 40; ++links) {
    std::error_code error;
    const fs::path folder = folder_of(place.target);
    if (fs::canonical(folder, error) == fs::path("/proc") / std::to_string(getpid()) / "fd") {
      const std::string name = place.target.filename().string();
      int descriptor = -1;
      std::from_chars(name.data(), name.data() + name.size(), descriptor);
      require(fcntl(descriptor, F_GETFD) != -1, "cannot write '{}': descriptor {} is not open", path, name);
      place.descriptor = descriptor;
      return place;
    }
    place.type = fs::symlink_status(place.target, error).type();
    require(error != std::errc::filename_too_long, "cannot write '{}': {}", path, error.message());
    if (place.type != fs::file_type::symlink) return place;
    const fs::path next = fs::read_symlink(place.target, error);
    place.target = next.is_absolute() ? next : folder / next;
  }
  throw Error(fmt::format("cannot write '{}': its links lead in a circle", path));
}

OutputTarget require_writable_target(const std::string& path) {
  const OutputTarget place = resolve_links(path);
  if (place.descriptor) return place;
  const fs::path folder = folder_of(place.target);
  std::error_code error;
  require(!place.target.filename().empty() && place.type != fs::file_type::directory,
          "cannot write '{}': it is a folder; name a file in it", path);
  require(fs::is_directory(folder, error), "cannot write '{}': the folder '{}' does not exist; create it first", path,
          folder.string());
  require(place.type != fs::file_type::socket, "cannot write '{}': it is a socket", path);
  require(place.type == fs::file_type::not_found || access(place.target.c_str(), W_OK) == 0,
          "cannot write '{}': it is not writable", path);
  require(!place.is_replaced() || access(folder.c_str(), W_OK) == 0,
          "cannot write '{}': the folder '{}' is not writable", path, folder.string());
  return place;
}

// Throws Error for an earlier or a new failure of a stream, and closes it.
void close_stream(std::FILE* stream, const std::string& path) {
  int failure = std::ferror(stream) != 0 ? EIO : 0;
  if (std::fflush(stream) != 0) failure = errno; // a full disk may be reported only here
  if (failure == 0 && fsync(fileno(stream)) != 0 && errno != EINVAL) failure = errno;
  if (std::fclose(stream) != 0 && failure == 0) failure = errno;
  require(failure == 0, "cannot write '{}': {}", path, std::strerror(failure));
}

// Makes the rename durable, as far as the file system can.
void sync_folder(const fs::path& folder) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

/// A new file beside the target, with a name that nobody can predict. The destructor removes it unless it became the
/// target.
class TemporaryFile {
 public:
  TemporaryFile(const OutputTarget& place, const std::string& path) : place_(place), path_(path) {
    const fs::path folder = folder_of(place.target);
    int descriptor = -1;
    do {
      std::uint64_t random = 0;
      const bool is_random = getentropy(&random, sizeof random) == 0;
      require(is_random, "cannot write '{}': no random name: {}", path, std::strerror(errno));
      name_ = (folder / fmt::format(".mc-{:016x}.tmp", random)).string();
      descriptor = open(name_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    } while (descriptor < 0 && errno == EEXIST);
    require(descriptor >= 0, "cannot write '{}': no file can be made in the folder '{}': {}", path, folder.string(),
            std::strerror(errno));
    struct stat old {};
    if (place.type == fs::file_type::regular && stat(place.target.c_str(), &old) == 0)
      fchmod(descriptor, old.st_mode & 07777);
    stream_ = fdopen(descriptor, "wb");
  }
  ~TemporaryFile() {
    if (stream_) std::fclose(stream_);
    if (!name_.empty()) unlink(name_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  std::FILE* stream() const { return stream_; }

  void move_to_target() {
    close_stream(std::exchange(stream_, nullptr), path_);
    const bool is_moved = rename(name_.c_str(), place_.target.c_str()) == 0;
    require(is_moved, "cannot write '{}': {}", path_, std::strerror(errno));
    name_.clear();
    sync_folder(folder_of(place_.target));
  }

 private:
  const OutputTarget& place_;
  const std::string& path_;
  std::string name_;
  std::FILE* stream_ = nullptr;
};

void write_through(const OutputTarget& place, const std::string& path, std::string_view bytes) {
  std::fflush(stdout); // keeps earlier output of this process before the bytes
  const int file =
      place.descriptor ? dup(*place.descriptor) : open(place.target.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
  require(file >= 0, "cannot write '{}': {}", path, std::strerror(errno));
  int failure = 0;
  while (!bytes.empty() && failure == 0) {
    const ssize_t n = write(file, bytes.data(), bytes.size());
    if (n >= 0) bytes.remove_prefix(static_cast<std::size_t>(n));
    else if (errno != EINTR) failure = errno;
  }
  if (close(file) != 0 && failure == 0) failure = errno;
  require(failure == 0, "cannot write '{}': {}", path, std::strerror(failure));
}

// The bytes that `write` writes to a stream in memory.
std::string bytes_of(const std::string& path, const std::function<void(std::FILE*)>& write) {
  const int descriptor = memfd_create("mc", MFD_CLOEXEC);
  require(descriptor >= 0, "cannot write '{}': {}", path, std::strerror(errno));
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(fdopen(descriptor, "w+b"), &std::fclose);
  write(stream.get());
  std::rewind(stream.get()); // flushes
  std::string bytes;
  char buffer[1 << 16];
  for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, stream.get())) > 0;) bytes.append(buffer, n);
  require(!std::ferror(stream.get()), "cannot write '{}': out of memory", path);
  return bytes;
}

} // namespace

void require_writable(const std::string& path) {
  const OutputTarget place = require_writable_target(path);
  if (place.is_replaced()) const TemporaryFile trial(place, path);
}

fs::path make_output_folder(const std::string& name, const std::string& first_file) {
  std::error_code failed;
  fs::create_directories(name, failed);
  std::error_code unknown;
  require(!failed && fs::is_directory(name, unknown), "'{}' is no folder and cannot be made one ({}); name another",
          name, failed ? failed.message() : "it is a file");
  const fs::path folder = name;
  require_writable((folder / first_file).string());
  return folder;
}

bool is_same_path(const std::string& a, const std::string& b) {
  struct stat of_a {
  }, of_b{};
  const auto is_same_file = [&] { return of_a.st_dev == of_b.st_dev && of_a.st_ino == of_b.st_ino; };
  const bool has_a = stat(a.c_str(), &of_a) == 0, has_b = stat(b.c_str(), &of_b) == 0;
  if (has_a || has_b) return has_a && has_b && is_same_file();
  try {
    const fs::path new_a = resolve_links(a).target, new_b = resolve_links(b).target;
    return stat(folder_of(new_a).c_str(), &of_a) == 0 && stat(folder_of(new_b).c_str(), &of_b) == 0 && is_same_file() &&
           new_a.filename() == new_b.filename();
  } catch (const Error&) { // neither can be written
    return false;
  }
}

void write_bytes(std::FILE* stream, std::string_view bytes) {
  const bool complete = std::fwrite(bytes.data(), 1, bytes.size(), stream) == bytes.size();
  require(complete, "{}", std::strerror(errno));
}

void replace_file(const std::string& path, const std::function<void(std::FILE*)>& write) {
  const OutputTarget place = require_writable_target(path);
  const auto write_to = [&](std::FILE* stream) {
    with_context(fmt::format("cannot write '{}'", path), [&] { write(stream); });
  };
  if (!place.is_replaced()) return write_through(place, path, bytes_of(path, write_to));
  TemporaryFile temporary(place, path);
  write_to(temporary.stream());
  temporary.move_to_target();
}

void write_file(const std::string& path, std::string_view bytes) {
  const OutputTarget place = require_writable_target(path);
  if (!place.is_replaced()) return write_through(place, path, bytes);
  replace_file(path, [&](std::FILE* stream) { write_bytes(stream, bytes); });
}

} // namespace mc

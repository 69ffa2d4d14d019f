#include <mc/core/error.h>
#include <mc/core/file.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <system_error>

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

std::string temporary_name(const fs::path& folder, const fs::path& path) {
  return (folder / fmt::format(".{}.{}.tmp{}", path.stem().string(), getpid(), path.extension().string())).string();
}

void replace(const OutputTarget& place, const std::string& path, const std::function<void(const std::string&)>& write) {
  const std::string temporary = temporary_name(folder_of(place.target), path);
  std::error_code error;
  try {
    write(temporary);
    if (place.type == fs::file_type::regular)
      fs::permissions(temporary, fs::status(place.target, error).permissions(), error);
    fs::rename(temporary, place.target, error);
    require(!error, "cannot write '{}': {}", path, error.message());
  } catch (...) {
    fs::remove(temporary, error);
    throw;
  }
}

// Writes through a file in a private temporary folder, because not every writer can write to a stream.
void write_via_temporary(const OutputTarget& place, const std::string& path,
                         const std::function<void(const std::string&)>& write) {
  std::string folder = (fs::temp_directory_path() / "mc.XXXXXX").string();
  require(mkdtemp(folder.data()) != nullptr, "cannot make a temporary folder '{}': {}", folder, std::strerror(errno));
  std::error_code error;
  try {
    const std::string temporary = temporary_name(folder, path);
    write(temporary);
    write_through(place, path, read_file(temporary));
  } catch (...) {
    fs::remove_all(folder, error);
    throw;
  }
  fs::remove_all(folder, error);
}

void write_new(const std::string& file, const std::string& path, std::string_view bytes) {
  std::FILE* out = std::fopen(file.c_str(), "wb");
  require(out != nullptr, "cannot write '{}': {}", path, std::strerror(errno));
  int failure = 0;
  if (std::fwrite(bytes.data(), 1, bytes.size(), out) != bytes.size()) failure = errno;
  if (std::fclose(out) != 0 && failure == 0) failure = errno; // a full disk may be reported only here
  require(failure == 0, "cannot write '{}': {}", path, std::strerror(failure));
}

} // namespace

void require_writable(const std::string& path) { require_writable_target(path); }

fs::path make_output_folder(const std::string& name, const std::string& first_file) {
  std::error_code failed;
  fs::create_directories(name, failed);
  require(!failed && fs::is_directory(name), "'{}' is no folder and cannot be made one ({}); name another", name,
          failed ? failed.message() : "it is a file");
  const fs::path folder = name;
  require_writable((folder / first_file).string());
  return folder;
}

void replace_file(const std::string& path, const std::function<void(const std::string&)>& write) {
  const OutputTarget place = require_writable_target(path);
  if (place.is_replaced()) replace(place, path, write);
  else write_via_temporary(place, path, write);
}

void write_file(const std::string& path, std::string_view bytes) {
  const OutputTarget place = require_writable_target(path);
  if (place.is_replaced()) replace(place, path, [&](const std::string& file) { write_new(file, path, bytes); });
  else write_through(place, path, bytes);
}

bool is_same_path(const std::string& a, const std::string& b) {
  const auto place = [](const std::string& path) { return fs::weakly_canonical(fs::absolute(path)); };
  return place(a) == place(b);
}

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
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  require(file != nullptr, "cannot read '{}': {}", path, std::strerror(errno));
  std::string bytes;
  char buffer[1 << 16];
  for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, file.get())) > 0;) bytes.append(buffer, n);
  require(!std::ferror(file.get()), "cannot read '{}': {}", path, std::strerror(errno));
  return bytes;
}

std::string read_text(const std::string& path) {
  std::string text = read_file(path);
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  return text;
}

} // namespace mc

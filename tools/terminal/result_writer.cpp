#include <process/temporary_folder.h>
#include <terminal/message.h>
#include <terminal/ranks.h>
#include <terminal/result_writer.h>

#include <mc/core/error.h>
#include <mc/core/file.h>

#include <fmt/format.h>

#include <cstdlib>
#include <optional>
#include <system_error>

namespace carlo {

namespace fs = std::filesystem;

namespace {

// The message of an Error, or of an error of the file system; nothing if f succeeds.
std::optional<std::string> failure_of(const std::function<void()>& f) {
  try {
    f();
    return {};
  } catch (const mc::Error& e) {
    return e.what();
  } catch (const fs::filesystem_error& e) {
    return fmt::format("cannot write '{}': {}", e.path1().string(), e.code().message());
  }
}

// Writes into a new folder elsewhere. Returns the name of the file, or "" where no folder takes it.
std::string save_elsewhere(const std::string& path, const std::function<void(const std::string&)>& write) {
  std::vector<fs::path> parents = temporary_parents();
  parents.push_back(".");
  for (const fs::path& parent : parents) {
    std::string folder = (parent / "carlo.XXXXXX").string();
    if (!mkdtemp(folder.data())) continue;
    const std::string file = (fs::path(folder) / fs::path(path).filename()).string();
    if (!failure_of([&] { write(file); })) return file;
    std::error_code none; // ignored: an empty folder would stay
    fs::remove(folder, none);
  }
  return {};
}

} // namespace

std::string partial_path(const std::string& path) {
  const fs::path name = path;
  return (name.parent_path() / (name.stem().string() + ".partial" + name.extension().string())).string();
}

fs::path result_folder(const fs::path& folder, const std::string& file, bool is_partial) {
  std::error_code error;
  if (!is_partial || !fs::exists(folder / file, error)) return folder;
  fs::create_directory(folder / "partial", error); // where it fails, so do the writes
  print_message(fmt::format("'{}' stays as it was; this partial result is in '{}'", (folder / file).string(),
                            (folder / "partial").string()));
  return folder / "partial";
}

std::string ResultWriter::write(const std::string& path, bool is_partial,
                                const std::function<void(const std::string&)>& write) {
  if (rank() != 0) return path;
  std::error_code error;
  const fs::file_type old = fs::status(path, error).type();
  const bool is_beside = is_partial && old == fs::file_type::regular;
  std::string file = is_beside ? partial_path(path) : path;
  if (const auto failure = failure_of([&] { write(file); })) {
    const bool has_name =
        old == fs::file_type::regular || old == fs::file_type::not_found || old == fs::file_type::none;
    const std::string saved = has_name ? save_elsewhere(file, write) : std::string();
    failures_.push_back(saved.empty() ? *failure : fmt::format("{}; the result is in '{}'", *failure, saved));
    return saved.empty() ? path : saved;
  }
  if (is_beside) print_message(fmt::format("'{}' stays as it was; this partial result is '{}'", path, file));
  return file;
}

std::string ResultWriter::write(const std::string& path, bool is_partial, std::string_view bytes) {
  return write(path, is_partial, [&](const std::string& file) { mc::write_file(file, bytes); });
}

void ResultWriter::attempt(const std::function<void()>& draw) {
  if (rank() != 0) return;
  if (const auto failure = failure_of(draw)) failures_.push_back(*failure);
}

void ResultWriter::finish() const { mc::require(failures_.empty(), "{}", fmt::join(failures_, "\n")); }

} // namespace carlo

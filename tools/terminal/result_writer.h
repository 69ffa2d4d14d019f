#pragma once
/// Writes results after the work, so that none is lost.

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// "a.partial.exr" for "a.exr".
std::string partial_path(const std::string& path);

/// The folder for the files of a result: `folder` itself. For a partial result where `folder` contains `file`, its
/// subfolder "partial", which is made.
std::filesystem::path result_folder(const std::filesystem::path& folder, const std::string& file, bool is_partial);

/// The writes of one run, by rank 0 alone.
///   partial : a partial result replaces no file. Where the file exists, the result goes to partial_path(), which it
///             replaces; a line on standard error says so.
///   failure : a result that cannot be written goes to a new folder under $TMPDIR, /tmp, /var/tmp or the current
///             folder. Later results are still written. finish() reports all failures.
class ResultWriter {
 public:
  /// Calls write(file) with the name of the file for the result. Returns this name; `path` where no file was written.
  std::string write(const std::string& path, bool is_partial,
                    const std::function<void(const std::string& file)>& write);
  /// Writes bytes in the same way.
  std::string write(const std::string& path, bool is_partial, std::string_view bytes);
  /// Calls draw() for a result that can be made again from the others, such as a plot: keeps its Error for finish().
  void attempt(const std::function<void()>& draw);
  /// Throws Error with a line for each failure and the place of the saved result.
  void finish() const;

 private:
  std::vector<std::string> failures_;
};

} // namespace carlo

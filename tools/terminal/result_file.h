#pragma once
/// The output file of an option like --json, which may be standard output.

#include <terminal/result_writer.h>

#include <string>
#include <string_view>

namespace carlo {

/// The destination of a result. The name "-" stands for standard output, which then contains the result and nothing
/// else: during the lifetime of this object, all other prints go to standard error.
class ResultFile {
 public:
  /// An empty name: no result is wanted. Throws Error where the file cannot be written, before any work is done.
  explicit ResultFile(std::string name);
  ~ResultFile();
  ResultFile(const ResultFile&) = delete;
  ResultFile& operator=(const ResultFile&) = delete;

  bool is_wanted() const { return !name_.empty(); }
  /// Writes the result to its file with `results`, or to standard output: throws std::system_error where that fails.
  void write(ResultWriter& results, bool is_partial, std::string_view bytes) const;

 private:
  std::string name_;
  int output_ = -1; // a duplicate of standard output, where the name is "-"
};

} // namespace carlo

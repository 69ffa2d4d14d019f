#pragma once
/// The file that an option like --json names, which may be standard output.

#include <string>
#include <string_view>

namespace carlo {

/// The place of a result. Of the name "-" it is standard output, which then holds the result and nothing else: while
/// this lives, what is printed goes to standard error.
class ResultFile {
 public:
  /// Empty: none is wanted. Throws Error where it cannot be written, before the work for it is done.
  explicit ResultFile(std::string name);
  ~ResultFile();
  ResultFile(const ResultFile&) = delete;
  ResultFile& operator=(const ResultFile&) = delete;

  bool is_wanted() const { return !name_.empty(); }
  /// Whole or not at all where it is a file. Throws Error where it cannot be written.
  void write(std::string_view bytes) const;

 private:
  std::string name_;
  int output_ = -1; // standard output as it was, where it is the place
};

} // namespace carlo

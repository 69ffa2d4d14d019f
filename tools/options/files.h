#pragma once
/// One check that no output replaces an input or another output.

#include <options/subcommand.h>

#include <string>
#include <vector>

namespace carlo {

/// A file that a subcommand reads or writes.
struct UsedFile {
  std::string path;
  std::string
      origin; ///< of an output: its option, "--json"; of an input: "the file of --plugin", "a file of the scene"
  bool is_output = false;
  bool is_state = false; ///< an output that may be the same file as another state
};

/// The files that options name, in their order. An output folder gives its fixed files.
std::vector<UsedFile> files_of(const std::vector<Option>& options);

/// Throws Error where an output and another output or an existing input are the same file, by mc::is_same_path.
/// Devices, pipes and sockets may be used several times; standard output as "-" only once.
void require_distinct_files(const std::vector<UsedFile>& files);

} // namespace carlo

#pragma once
/// Hashes of the content of files.

#include <set>
#include <string>

namespace carlo {

/// A hash of the files' bytes as 16 digits, independent of their folders and names; "" where one is no regular file.
///   throws : Error where a file cannot be read.
std::string hash_of_files(const std::set<std::string>& files);

} // namespace carlo

#pragma once
/// Where the files are that a scene names.

#include <render/io/xml.h>

#include <filesystem>
#include <string>
#include <vector>

namespace render::mitsuba {

/// The folder of the scene file and those of its <path> elements, searched from the last to the first.
class FileResolver {
 public:
  explicit FileResolver(const XmlElement& root) : folders_{std::filesystem::path(root.file).parent_path()} {}

  /// The folder that a <path> names, relative to the file in which it stands, or else to one of those so far.
  ///   throws : Error where there is no such folder
  void add(const XmlElement& path);

  /// The path of a file; where it is in none of the folders, that in the scene file's.
  std::string find(const std::string& name) const;

 private:
  std::vector<std::filesystem::path> folders_;
};

/// Puts in the place of every <include filename="base.xml"/> of the scene what the <scene> of that file holds.
///   throws : Error for a file that cannot be read, for one that is no <scene>, and for files that include each other
void include_files(XmlElement& root);

} // namespace render::mitsuba

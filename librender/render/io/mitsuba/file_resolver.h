#pragma once
/// Search for the files that a scene refers to.

#include <render/io/xml.h>

#include <filesystem>
#include <string>
#include <vector>

namespace render::mitsuba {

/// The folders of a scene: the folder of the scene file and the folders of its <path> elements, searched from last to
/// first.
class FileResolver {
 public:
  /// Starts with the folder of the scene file.
  explicit FileResolver(const XmlElement& root) : folders_{std::filesystem::path(root.file).parent_path()} {}

  /// Adds the folder of a <path>, relative to its file, or else to one of the folders so far.
  ///   throws : Error if there is no such folder.
  void add(const XmlElement& path);

  /// Path of a file. If no folder contains it, its path in the folder of the scene file.
  std::string find(const std::string& name) const;

 private:
  std::vector<std::filesystem::path> folders_;
};

/// Replaces every <include filename="base.xml"/> of the scene by the content of the <scene> in that file.
///   throws : Error for a file that cannot be read or contains no <scene>, and for circular includes.
void include_files(XmlElement& root);

} // namespace render::mitsuba

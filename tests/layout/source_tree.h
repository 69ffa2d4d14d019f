#pragma once
// Access to the sources of the project for the layout tests.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace layout {

namespace fs = std::filesystem;

inline const fs::path root = MC_SOURCE_DIR;

struct Include {
  std::string file, header;
  int line;
};

inline std::vector<fs::path> sources(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".h" || extension == ".cpp") files.push_back(fs::relative(entry.path(), root));
  }
  std::sort(files.begin(), files.end());
  return files;
}

inline std::vector<fs::path> sources(const std::vector<const char*>& folders) {
  std::vector<fs::path> files;
  for (const char* folder : folders) {
    const std::vector<fs::path> found = sources(fs::path(folder));
    files.insert(files.end(), found.begin(), found.end());
  }
  return files;
}

inline std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream in(root / file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

inline std::string text_of(const fs::path& file) {
  std::ifstream in(root / file);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline std::vector<Include> includes(const fs::path& folder) {
  static const std::regex pattern(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<Include> found;
  for (const fs::path& file : sources(folder)) {
    const std::vector<std::string> lines = lines_of(file);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      std::smatch match;
      if (lines[i].find("#include") != std::string::npos && std::regex_search(lines[i], match, pattern))
        found.push_back({file.string(), match[1], static_cast<int>(i) + 1});
    }
  }
  return found;
}

// Number of columns of a UTF-8 line: continuation bytes have no width.
inline std::size_t columns(const std::string& line) {
  return static_cast<std::size_t>(
      std::count_if(line.begin(), line.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

} // namespace layout

#include <render/io/mitsuba/context.h>
#include <render/io/mitsuba/file_resolver.h>

#include <mc/core/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace render::mitsuba {

void FileResolver::add(const XmlElement& path) {
  path.mark_used();
  const std::string& name = path.attribute("value");
  std::filesystem::path folder = std::filesystem::path(path.file).parent_path() / name;
  if (!std::filesystem::is_directory(folder)) folder = find(name);
  if (!std::filesystem::is_directory(folder)) path.fail(fmt::format("there is no folder '{}'", folder.string()));
  folders_.push_back(std::move(folder));
}

std::string FileResolver::find(const std::string& name) const {
  const auto found = std::find_if(folders_.rbegin(), folders_.rend(), [&](const std::filesystem::path& folder) {
    return std::filesystem::exists(folder / name);
  });
  return ((found == folders_.rend() ? folders_.front() : *found) / name).string();
}

namespace {

constexpr int most_levels = 16;  // of nested includes
constexpr int most_files = 1000; // a file counts once per inclusion

// Children of a <scene> with includes resolved. `level` is the nesting depth; `files` counts all inclusions.
std::vector<XmlElement> with_included(const XmlElement& root, std::vector<XmlElement> children, int level, int& files) {
  std::vector<XmlElement> all, paths;
  for (XmlElement& child : children) {
    if (child.tag == "path") paths.push_back(child);
    if (child.tag != "include") {
      all.push_back(std::move(child));
      continue;
    }
    child.mark_used();
    FileResolver folders(root);
    for (const XmlElement& path : paths) folders.add(path);
    const std::string& name = child.attribute("filename");
    child.require_all_used();
    XmlElement included = mc::with_context(child.where(), [&] { return read_xml(folders.find(name)); });
    if (included.tag != "scene") included.fail("the document must be a <scene>");
    if (included.has("version") && is_mitsuba_2_scene(included) != is_mitsuba_2_scene(root))
      included.fail(
          fmt::format("version \"{}\" beside \"{}\" of '{}', which includes it; colours mean different things "
                      "in them: give both the same",
                      included.attribute("version"), root.attribute_or("version", "0.6.0"), root.file));
    if (level == most_levels)
      child.fail(fmt::format("includes are nested more than {} deep; does a file include itself?", most_levels));
    if (++files > most_files) child.fail(fmt::format("more than {} files are included; include each once", most_files));
    std::vector<XmlElement> more = with_included(root, std::move(included.children), level + 1, files);
    included.mark_used();
    included.children.clear(); // checked in their new place
    included.require_all_used();
    std::move(more.begin(), more.end(), std::back_inserter(all));
  }
  return all;
}

} // namespace

void include_files(XmlElement& root) {
  int files = 0;
  root.children = with_included(root, std::move(root.children), 0, files);
}

} // namespace render::mitsuba

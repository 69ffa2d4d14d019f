#include <gallery/features.h>

#include <render/integrator/strategy.h>
#include <render/io/mitsuba/plugins.h>
#include <render/io/xml.h>

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace carlo {

namespace {

namespace mitsuba = render::mitsuba;

/// A plugin as a scene file names it.
struct PluginName {
  std::string kind, plugin;
  auto operator<=>(const PluginName&) const = default;
};

struct FeatureRow {
  Feature feature;
  std::set<PluginName> names;
};

std::vector<FeatureRow> rows() {
  std::vector<FeatureRow> all;
  for (const mitsuba::Kind& kind : mitsuba::all_plugins()) {
    const std::string tag = kind.tag.substr(0, kind.tag.find(' ')); // without the rest of "emitter in a shape"
    const bool alike = std::all_of(kind.rows.begin(), kind.rows.end(),
                                   [&](const auto& plugin) { return plugin.meaning == kind.rows.front().meaning; });
    const std::string* meaning = nullptr; // neighbours with one meaning are one feature
    for (const mitsuba::PluginText& plugin : kind.rows) {
      if (!meaning || plugin.meaning != *meaning)
        all.push_back({alike && kind.rows.size() > 1 ? tag : tag + " " + plugin.name, {}});
      meaning = &plugin.meaning;
      all.back().names.insert({tag, plugin.name});
    }
  }
  for (const render::Strategy& s : render::strategies)
    all.push_back({fmt::format("strategy {}", s.name), {{"strategy", std::string(s.name)}}});
  return all;
}

void collect(const render::XmlElement& e, std::set<PluginName>& found) {
  if (e.has("type")) found.insert({e.tag, e.attribute("type")});
  for (const render::XmlElement& child : e.children) collect(child, found);
}

/// A feature with the names of the scenes that require it.
struct FeatureUse {
  Feature feature;
  std::vector<std::string_view> by;
};

std::vector<FeatureUse> required_features() {
  std::vector<FeatureUse> all;
  for (const Feature& feature : all_features()) all.push_back({feature, {}});
  for (const GalleryScene& scene : gallery()) {
    const std::vector<Feature> features = features_of(scene);
    for (FeatureUse& r : all)
      if (std::find(features.begin(), features.end(), r.feature) != features.end()) r.by.push_back(scene.name);
  }
  return all;
}

constexpr const char* introduction = R"(# The gallery

![The scenes of the gallery](../../notebooks-data/pictures/gallery.png)

`carlo gallery -o DIR` renders these scenes and writes a page. `carlo gallery NAME -o DIR` and `carlo render NAME`
render a single scene. The strategy is `mis+lt` unless the table names another. `carlo gallery --table` prints this
text.

)";

} // namespace

std::vector<Feature> all_features() {
  std::vector<Feature> all;
  for (const FeatureRow& row : rows()) all.push_back(row.feature);
  return all;
}

std::vector<Feature> features_of(const GalleryScene& scene) {
  std::set<PluginName> found;
  collect(render::read_xml(scene_file(scene)), found);
  found.insert({"strategy", scene.strategy.empty() ? "mis+lt" : std::string(scene.strategy)});
  std::vector<Feature> features;
  for (const FeatureRow& row : rows())
    for (const PluginName& name : row.names)
      if (found.contains(name)) {
        features.push_back(row.feature);
        break;
      }
  return features;
}

std::string gallery_text() {
  std::string text = introduction;
  text += "| scene | picture | strategy | source |\n|---|---|---|---|\n";
  for (const GalleryScene& scene : gallery())
    text += fmt::format("| [{}]({}.xml) | {} | {} | {} |\n", scene.name, scene.file.empty() ? scene.name : scene.file,
                        scene.title, scene.strategy, scene.source);
  text += "\n## Which scene requires which feature\n\nlibrender supports a feature only if a scene requires it.\n\n"
          "| feature | required by |\n|---|---|\n";
  for (auto& [feature, by] : required_features()) {
    constexpr std::size_t shown = 6;
    const std::size_t more = by.size() > shown ? by.size() - shown : 0;
    by.resize(by.size() - more);
    text +=
        fmt::format("| {} | {}{} |\n", feature, fmt::join(by, ", "), more > 0 ? fmt::format(" and {} more", more) : "");
  }
  return text;
}

} // namespace carlo

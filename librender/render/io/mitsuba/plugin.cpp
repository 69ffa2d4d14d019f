#include <render/io/mitsuba/plugin.h>
#include <render/io/mitsuba/unsupported.h>

#include <mc/core/text.h>

#include <algorithm>

namespace render::mitsuba::detail {

namespace {

// Throws Error for a <ref> that is no named parameter and references none of the plugins that may stand there.
void require_reference(const XmlElement& ref, const PluginText& row, const Context& context) {
  std::vector<std::string> tags;
  for (const Declaration& d : row.parameters) {
    if (!d.nested() && d.matches(ref, context)) return;
    for (const std::string& tag : d.tags)
      if (d.nested() && std::find(tags.begin(), tags.end(), tag) == tags.end()) tags.push_back(tag);
  }
  if (!tags.empty()) context.resolve(ref, tags);
}

} // namespace

void require_known_children(const XmlElement& e, const PluginText& row, const Context& context) {
  for (const XmlElement& child : e.children) {
    if (child.tag == "ref") require_reference(child, row, context);
    const auto known = std::find_if(row.parameters.begin(), row.parameters.end(),
                                    [&](const Declaration& d) { return d.matches(child, context); });
    const std::string name = child.attribute_or("name", "");
    if (known == row.parameters.end()) {
      std::vector<std::string> names;
      for (const Declaration& d : row.parameters) names.push_back(d.name);
      const std::string what = name.empty() ? fmt::format("<{}>", child.tag) : name;
      child.fail(fmt::format("{} has no '{}'{}; {}", row.name, what, mc::did_you_mean(what, names),
                             names.empty() ? "it has no parameters: remove it"
                                           : fmt::format("its parameters are {}", fmt::join(names, ", "))));
    }
    if (!known->has_effect) {
      known->find(e, context);
      child.attribute_or("value", "");
    } else if (known->only && boolean_of(*known->find(e, context)) != *known->only) {
      child.fail(fmt::format("{} = {} is not supported ({}); remove it", name, !*known->only, known->meaning));
    }
  }
}

void fail_unknown_type(const XmlElement& e, const std::vector<std::string_view>& known) {
  const std::string& type = e.attribute("type");
  if (const std::string_view reason = why_unsupported(e.tag, type); !reason.empty())
    e.fail(fmt::format("type '{}': {}", type, reason));
  e.fail(
      fmt::format("unknown type '{}'{}; use one of {}", type, mc::did_you_mean(type, known), fmt::join(known, ", ")));
}

} // namespace render::mitsuba::detail

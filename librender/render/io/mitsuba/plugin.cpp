#include <render/io/mitsuba/plugin.h>
#include <render/io/mitsuba/unsupported.h>

#include <mc/core/text.h>

#include <algorithm>

namespace render::mitsuba::detail {

void require_known_children(const XmlElement& e, const PluginText& row) {
  for (const XmlElement& child : e.children) {
    const auto known = std::find_if(row.parameters.begin(), row.parameters.end(),
                                    [&](const Declaration& d) { return d.matches(child); });
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
      known->find(e);
      child.attribute_or("value", "");
    } else if (known->only && boolean_of(*known->find(e)) != *known->only) {
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

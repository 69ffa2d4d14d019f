#include <render/io/mitsuba/variables.h>

#include <mc/core/text.h>

#include <map>
#include <vector>

namespace render::mitsuba {

namespace {

using Variables = std::map<std::string, std::string>;

const Variables::value_type* longest_at(const Variables& variables, std::string_view text) {
  const Variables::value_type* best = nullptr;
  for (const auto& variable : variables)
    if (text.starts_with(variable.first) && (!best || variable.first.size() > best->first.size())) best = &variable;
  return best;
}

std::string substituted(const XmlElement& e, const std::string& text, const Variables& variables) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t dollar = std::min(text.find('$', at), text.size());
    result += text.substr(at, dollar - at);
    if (dollar == text.size()) break;
    const std::string_view rest = std::string_view(text).substr(dollar + 1);
    const auto* variable = longest_at(variables, rest);
    if (!variable) {
      std::vector<std::string_view> known;
      for (const auto& [name, value] : variables) known.push_back(name);
      e.fail(fmt::format("no <default> above defines ${}{}", rest, mc::did_you_mean(rest, known)));
    }
    result += variable->second;
    at = dollar + 1 + variable->first.size();
  }
  return result;
}

void substitute(XmlElement& e, Variables& variables) {
  e.replace_values([&](const std::string& value) { return substituted(e, value, variables); });
  if (e.tag == "default") {
    e.mark();
    const std::string& name = e.attribute("name");
    if (name.empty()) e.fail("the name must not be empty");
    variables.try_emplace(name, e.attribute("value"));
  }
  for (XmlElement& child : e.children) substitute(child, variables);
}

} // namespace

void substitute_variables(XmlElement& root) {
  Variables variables;
  substitute(root, variables);
}

} // namespace render::mitsuba

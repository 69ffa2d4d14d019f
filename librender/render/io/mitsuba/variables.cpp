#include <render/io/mitsuba/variables.h>

#include <mc/core/text.h>

#include <mc/core/error.h>

#include <map>
#include <set>
#include <vector>

namespace render::mitsuba {

namespace {

struct Names {
  Variables values;
  std::set<std::string> used = {};
};

const Variables::value_type* longest_at(const Variables& variables, std::string_view text) {
  const Variables::value_type* best = nullptr;
  for (const auto& variable : variables)
    if (text.starts_with(variable.first) && (!best || variable.first.size() > best->first.size())) best = &variable;
  return best;
}

constexpr std::size_t longest = 1 << 20; // characters of a value

std::string substituted(const XmlElement& e, const std::string& text, Names& names) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t dollar = std::min(text.find('$', at), text.size());
    result += text.substr(at, dollar - at);
    if (dollar == text.size()) break;
    const std::string_view rest = std::string_view(text).substr(dollar + 1);
    const auto* variable = longest_at(names.values, rest);
    if (!variable) {
      std::vector<std::string_view> known;
      for (const auto& [name, value] : names.values) known.push_back(name);
      e.fail(fmt::format("no <default> above defines ${}{}, nor is it given (carlo render -D NAME=VALUE)", rest,
                         mc::did_you_mean(rest, known)));
    }
    names.used.insert(variable->first);
    result += variable->second;
    if (result.size() > longest)
      e.fail(fmt::format("with its variables a value is longer than {} characters; does a <default> repeat another "
                         "over and over?",
                         longest));
    at = dollar + 1 + variable->first.size();
  }
  return result;
}

void substitute(XmlElement& e, Names& names) {
  e.replace_values([&](const std::string& value) { return substituted(e, value, names); });
  if (e.tag == "default") {
    e.mark_used();
    const std::string& name = e.attribute("name");
    if (name.empty()) e.fail("the name must not be empty");
    names.values.try_emplace(name, e.attribute("value"));
    names.used.insert(name);
  }
  for (XmlElement& child : e.children) substitute(child, names);
}

} // namespace

void substitute_variables(XmlElement& root, const Variables& given) {
  Names names{given};
  substitute(root, names);
  for (const auto& [name, value] : given)
    mc::require(names.used.contains(name), "{}: the scene has no ${} that could be {}", root.file, name, value);
}

} // namespace render::mitsuba

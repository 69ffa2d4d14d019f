#include <render/io/mitsuba/parameter.h>

#include <mc/core/text.h>

#include <algorithm>

namespace render::mitsuba {

namespace {

constexpr const char* share_of_light = "share of light";

std::string text_of(const Vec3d& v) { return fmt::format("{}, {}, {}", v[0], v[1], v[2]); }
std::string text_of(const Spectrum& s) {
  // Colours are decimals: prints the shortest decimal that rounds to this float.
  if (s[0] == s[1] && s[1] == s[2]) return fmt::format("{}", s[0]);
  return fmt::format("{}, {}, {}", s[0], s[1], s[2]);
}

std::shared_ptr<const Texels> picture_of(const XmlElement& e, Context& context) {
  const std::string path = context.file(e.attribute("value"));
  return mc::with_context(e.where(), [&] { return context.picture(path); });
}

std::size_t word_of(const XmlElement& e, const std::vector<std::string>& words) {
  const std::string& word = e.attribute("value");
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end())
    e.fail(
        fmt::format("'{}' is not known{}; use one of {}", word, mc::did_you_mean(word, words), fmt::join(words, ", ")));
  return static_cast<std::size_t>(found - words.begin());
}

// Whether `word` is `name` in the spelling of Mitsuba 2 and 3 and lajolla: int_ior for intIOR.
bool is_in_snake_case(std::string_view word, std::string_view name) {
  std::string spelled;
  bool after_small = false;
  for (const char c : name) {
    const bool large = c >= 'A' && c <= 'Z';
    if (large && after_small) spelled += '_';
    spelled += large ? static_cast<char>(c - 'A' + 'a') : c;
    after_small = !large;
  }
  return word == spelled;
}

} // namespace

bool Declaration::matches(const XmlElement& child, const Context& context) const {
  const auto is_one_of = [](std::string_view word, const std::vector<std::string>& words) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  const std::string word = child.attribute_or("name", "");
  if (nested()) return is_one_of(context.tag_of(child), tags) && (roles.empty() || is_one_of(word, roles));
  return word == name || is_in_snake_case(word, name);
}

const XmlElement* Declaration::find(const XmlElement& plugin, const Context& context) const {
  const XmlElement* found = nullptr;
  for (const XmlElement& child : plugin.children) {
    if (!matches(child, context)) continue;
    if (found) child.fail(fmt::format("a second {}, after line {}; only one is allowed here", name, found->line));
    if (!nested() && std::find(tags.begin(), tags.end(), child.tag) == tags.end())
      child.fail(fmt::format("'{}' must be a <{}>", name, fmt::join(tags, "> or <")));
    child.mark_used();
    child.attribute_or("id", "");
    child.attribute_or("name", ""); // nested plugins may have a name too
    found = &child;
  }
  return found;
}

void Declaration::require_dialect(const XmlElement& given, Context& context) const {
  const bool is_lajolla = context.dialect() == Dialect::lajolla;
  if (!is_lajolla && !mitsuba_alternative.empty())
    given.fail(fmt::format("'{}' is lajolla's; say {}, or --dialect lajolla", name, mitsuba_alternative));
  if (is_lajolla && !lajolla_alternative.empty())
    context.warn(given,
                 fmt::format("lajolla leaves {} out, here it counts; say {} instead", name, lajolla_alternative));
}

Parameter<double> number(const std::string& name, const std::string& unit, const std::string& meaning) {
  return {{name, "number", unit, {"float", "integer"}, meaning},
          [](const XmlElement& e, Context&) { return number_of(e); }};
}
Parameter<double> number(const std::string& name, const std::string& unit, double fallback,
                         const std::string& meaning) {
  return number(name, unit, meaning).with_default(fallback, fmt::format("{}", fallback));
}

Parameter<int> integer(const std::string& name, const std::string& meaning, int fallback) {
  const Parameter<int> p{{name, "integer", "", {"integer"}, meaning},
                         [](const XmlElement& e, Context&) { return integer_of(e); }};
  return p.with_default(fallback, fmt::format("{}", fallback));
}

Parameter<bool> boolean(const std::string& name, const std::string& meaning, bool fallback) {
  const Parameter<bool> p{{name, "boolean", "", {"boolean"}, meaning},
                          [](const XmlElement& e, Context&) { return boolean_of(e); }};
  return p.with_default(fallback, fmt::format("{}", fallback));
}

Parameter<std::string> file(const std::string& name, const std::string& meaning) {
  return {{name, "file", "", {"string"}, meaning},
          [](const XmlElement& e, Context& context) { return context.file(e.attribute("value")); }};
}

Parameter<Vec3d> point(const std::string& name, const std::string& meaning, const Vec3d& fallback) {
  const Parameter<Vec3d> p{{name, "point", "", {"point", "vector"}, meaning},
                           [](const XmlElement& e, Context&) { return vector_of(e); }};
  return p.with_default(fallback, text_of(fallback));
}

Parameter<Spectrum> color(const std::string& name, const std::string& unit, const std::string& meaning) {
  return {{name, "colour", unit, {"rgb", "srgb", "spectrum", "float"}, meaning},
          [](const XmlElement& e, Context& context) { return color_of(e, context.extrapolation()); }};
}
Parameter<Spectrum> color(const std::string& name, const std::string& unit, const std::string& meaning,
                          const Spectrum& fallback) {
  return color(name, unit, meaning).with_default(fallback, text_of(fallback));
}

Parameter<Spectrum> reflectance(const std::string& name, const std::string& meaning, const Spectrum& fallback) {
  Parameter<Spectrum> p = color(name, share_of_light, meaning, fallback);
  p.parse = [](const XmlElement& e, Context& context) {
    return reflectance_of(e, context.illuminant(), context.extrapolation());
  };
  return p;
}

Parameter<Reflectance> reflectance_or_texture(const std::string& name, const std::string& meaning,
                                              const Spectrum& fallback) {
  return or_texture(reflectance(name, meaning, fallback));
}

Parameter<std::shared_ptr<const Texels>> picture(const std::string& name, const std::string& meaning) {
  return {{name, "file", "", {"string"}, meaning}, picture_of};
}

Parameter<PictureSource> encoded_picture(const std::string& name, const std::string& meaning) {
  const auto source = [](const XmlElement& e, Context& context) -> PictureSource {
    return [path = context.file(e.attribute("value")), &context](const std::optional<Transfer>& transfer) {
      return context.picture(path, transfer);
    };
  };
  return {{name, "file", "", {"string"}, meaning}, source};
}

Parameter<Transform> transform(const std::string& name, const std::string& meaning) {
  const Parameter<Transform> p{{name, "transform", "", {"transform"}, meaning},
                               [](const XmlElement& e, Context&) { return transform_of(e); }};
  return p.with_default({}, "identity");
}

Parameter<std::size_t> choice(const std::string& name, const std::vector<std::string>& words,
                              const std::string& meaning) {
  const Parameter<std::size_t> p{{name, fmt::format("one of {}", fmt::join(words, ", ")), "", {"string"}, meaning},
                                 [words](const XmlElement& e, Context&) { return word_of(e, words); }};
  return p;
}
Parameter<std::size_t> choice(const std::string& name, const std::vector<std::string>& words,
                              const std::string& meaning, std::size_t fallback) {
  return choice(name, words, meaning).with_default(fallback, words[fallback]);
}

Declaration no_effect(const std::string& name, const std::string& why) {
  Declaration d{name, "any", "", {"boolean", "float", "integer", "string"}, why};
  d.has_effect = false;
  return d;
}

Declaration only(bool value, const std::string& name, const std::string& meaning) {
  Declaration d{name, "boolean", "", {"boolean"}, meaning, fmt::format("{}", value)};
  d.only = value;
  return d;
}

} // namespace render::mitsuba

#pragma once
/// A parameter of a plugin, declared once: reading it, the errors about it and the reference all follow from that.

#include <render/io/mitsuba/context.h>
#include <render/io/mitsuba/values.h>

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace render::mitsuba {

/// How a parameter is written in a scene file, and what the reference says of it.
struct Declaration {
  std::string name;              ///< its name attribute, or "<film>" for a nested plugin, which needs no name
  std::string type, unit;        ///< as the reference calls them
  std::vector<std::string> tags; ///< the elements that it may be written as
  std::string meaning;
  std::string fallback = "-"; ///< where it is not given; "-": it must be
  std::string lajolla = {};   ///< the same in lajolla's dialect; empty: no difference
  bool has_effect = true;     ///< false: accepted, since it cannot change the picture
  std::optional<bool> only{}; ///< a switch that may only be given as what it is by default
  std::string departure = {}; ///< of the fallback from Mitsuba's own, as a warning; empty: none
  std::string mitsuba_alternative =
      {}; ///< of a parameter that lajolla alone has: what to say in Mitsuba; empty: no such one
  std::string lajolla_alternative =
      {}; ///< of one that lajolla leaves out, as a warning: what to say there; empty: no such one

  bool nested() const { return name.starts_with('<'); }
  /// Whether a child of a plugin is this parameter.
  bool matches(const XmlElement& child) const;
  /// The child of a plugin that is this parameter, or null.
  ///   throws : Error for a second one and for another kind of element
  const XmlElement* find(const XmlElement& plugin) const;
  /// Of what is given: warns where the dialect leaves it out.
  ///   throws : Error where the dialect does not have it
  void require_dialect(const XmlElement& given, Context& context) const;
};

/// What is read, in the coordinates of the scene: a transform leads to these, nothing else depends on them.
template <class T> T in_scene(T value, const Context&) { return value; }
inline Transform in_scene(Transform t, const Context& context) {
  t.translation -= context.origin();
  return t;
}

/// A parameter whose value is a T.
template <class T> struct Parameter {
  Declaration declared;
  std::function<T(const XmlElement& given, Context& context)> parse;
  std::optional<T> fallback, lajolla_fallback;

  /// This value where the parameter is not given; `text` is what the reference says of it.
  Parameter with_default(T value, const std::string& text) const {
    Parameter p = *this;
    p.fallback = std::move(value);
    p.declared.fallback = text;
    return p;
  }
  /// The value in lajolla's dialect where it is not given.
  Parameter with_lajolla_default(T value, const std::string& text) const {
    Parameter p = *this;
    p.lajolla_fallback = std::move(value);
    p.declared.lajolla = text;
    return p;
  }
  /// The same, refused but in lajolla's dialect; `instead` is what Mitsuba has.
  Parameter lajolla_only(const std::string& instead) const {
    Parameter p = *this;
    p.declared.mitsuba_alternative = instead;
    return p;
  }
  /// The same, with a warning in lajolla's dialect, that it counts here and not there; `instead` is what lajolla has.
  Parameter ignored_by_lajolla(const std::string& instead) const {
    Parameter p = *this;
    p.declared.lajolla_alternative = instead;
    return p;
  }

  /// Its value for a plugin.
  T read(const XmlElement& plugin, Context& context) const {
    if (const XmlElement* given = declared.find(plugin)) {
      declared.require_dialect(*given, context);
      return in_scene(parse(*given, context), context);
    }
    if (context.dialect() == Dialect::lajolla && lajolla_fallback) return in_scene(*lajolla_fallback, context);
    if (!fallback) plugin.fail(fmt::format("parameter '{}' is missing: {}", declared.name, declared.meaning));
    if (!declared.departure.empty() && context.dialect() == Dialect::mitsuba) context.warn(plugin, declared.departure);
    return in_scene(*fallback, context);
  }
};

/// Without a fallback a parameter must be given.
Parameter<double> number(const std::string& name, const std::string& unit, const std::string& meaning);
Parameter<double> number(const std::string& name, const std::string& unit, double fallback, const std::string& meaning);
Parameter<int> integer(const std::string& name, const std::string& meaning, int fallback);
Parameter<bool> boolean(const std::string& name, const std::string& meaning, bool fallback = false);
Parameter<std::string> file(const std::string& name, const std::string& meaning);
Parameter<Vec3d> point(const std::string& name, const std::string& meaning, const Vec3d& fallback);
Parameter<Spectrum> color(const std::string& name, const std::string& unit, const std::string& meaning);
Parameter<Spectrum> color(const std::string& name, const std::string& unit, const std::string& meaning,
                          const Spectrum& fallback);
/// The share of light that something does not keep.
Parameter<Spectrum> reflectance(const std::string& name, const std::string& meaning, const Spectrum& fallback);
/// A colour, or a texture where it varies.
using Reflectance = std::variant<Spectrum, Texture>;
Parameter<Reflectance> reflectance_or_texture(const std::string& name, const std::string& meaning,
                                              const Spectrum& fallback);
/// A file with a picture, relative to the scene file.
Parameter<std::shared_ptr<const Texels>> picture(const std::string& name, const std::string& meaning);
Parameter<Transform> transform(const std::string& name, const std::string& meaning);

/// One word of a list, as its place in the list.
Parameter<std::size_t> choice(const std::string& name, const std::vector<std::string>& words,
                              const std::string& meaning);
Parameter<std::size_t> choice(const std::string& name, const std::vector<std::string>& words,
                              const std::string& meaning, std::size_t fallback);

/// A parameter that may be left out, without a value of its own then.
template <class T> Parameter<std::optional<T>> optional(const Parameter<T>& p) {
  return Parameter<std::optional<T>>{p.declared, p.parse, {}, {}}.with_default(std::nullopt, "none");
}

/// Accepted without effect, since it cannot change the picture.
Declaration no_effect(const std::string& name, const std::string& why);
/// A switch of which only the default is supported.
Declaration only(bool value, const std::string& name, const std::string& meaning);

} // namespace render::mitsuba

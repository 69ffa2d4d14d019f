#pragma once
/// Declarations of plugin parameters. The declaration drives the parser, its errors and the reference.

#include <render/io/mitsuba/context.h>
#include <render/io/mitsuba/values.h>

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace render::mitsuba {

/// How a parameter is written in a scene file, and its description in the reference.
struct Declaration {
  std::string name;              ///< Name attribute, or "<film>" for a nested plugin, which needs no name.
  std::string type, unit;        ///< Names of type and unit in the reference.
  std::vector<std::string> tags; ///< Elements that may contain the parameter.
  std::string meaning;           ///< Description.
  std::string fallback = "-";    ///< Value if the parameter is omitted; "-": it is required.
  std::string lajolla = {};      ///< Fallback in the dialect lajolla; empty: the same.
  bool has_effect = true;        ///< False: accepted without effect on the image.
  std::optional<bool> only{};    ///< A switch that may only have this value, its default.
  std::string mitsuba_alternative =
      {}; ///< For a parameter that only lajolla has: the equivalent in Mitsuba; empty: Mitsuba has the parameter.
  std::string lajolla_alternative =
      {}; ///< For a parameter that lajolla ignores: the equivalent in lajolla, as a warning; empty: lajolla has it.
  std::vector<std::string> roles =
      {}; ///< Name attributes of a nested plugin, "" if it needs none; empty: the name does not matter.

  /// Whether the parameter is a nested plugin.
  bool nested() const { return name.starts_with('<'); }
  /// Whether a child of a plugin is this parameter. A nested plugin may also be a <ref> to one.
  bool matches(const XmlElement& child, const Context& context) const;
  /// The child of a plugin that is this parameter, or null.
  ///   throws : Error for a second such child, and for a child with another tag.
  const XmlElement* find(const XmlElement& plugin, const Context& context) const;
  /// Checks the dialect for a given parameter. Warns if the dialect ignores it.
  ///   throws : Error if the dialect does not have the parameter.
  void require_dialect(const XmlElement& given, Context& context) const;
};

/// Converts a value to the coordinates of the scene. Only transforms depend on the origin.
template <class T> T in_scene(T value, const Context&) { return value; }
/// Moves a transform to the origin of the scene.
inline Transform in_scene(Transform t, const Context& context) {
  t.translation -= context.origin();
  return t;
}

/// A parameter with values of type T.
template <class T> struct Parameter {
  Declaration declared;                                              ///< Declaration of the parameter.
  std::function<T(const XmlElement& given, Context& context)> parse; ///< Reads the value from an element.
  std::optional<T> fallback = {}, lajolla_fallback = {};             ///< Values if the parameter is omitted.

  /// The parameter with a fallback. `text` describes the fallback in the reference.
  Parameter with_default(T value, const std::string& text) const {
    Parameter p = *this;
    p.fallback = std::move(value);
    p.declared.fallback = text;
    return p;
  }
  /// The parameter with another fallback in the dialect lajolla.
  Parameter with_lajolla_default(T value, const std::string& text) const {
    Parameter p = *this;
    p.lajolla_fallback = std::move(value);
    p.declared.lajolla = text;
    return p;
  }
  /// The parameter, accepted in the dialect lajolla only. `instead` is the equivalent in Mitsuba.
  Parameter lajolla_only(const std::string& instead) const {
    Parameter p = *this;
    p.declared.mitsuba_alternative = instead;
    return p;
  }
  /// The parameter, with a warning in the dialect lajolla that lajolla itself ignores it. `instead` is the equivalent
  /// in lajolla.
  Parameter ignored_by_lajolla(const std::string& instead) const {
    Parameter p = *this;
    p.declared.lajolla_alternative = instead;
    return p;
  }

  /// The value of the parameter for a plugin.
  T read(const XmlElement& plugin, Context& context) const {
    if (const XmlElement* given = declared.find(plugin, context)) {
      declared.require_dialect(*given, context);
      return in_scene(parse(*given, context), context);
    }
    if (context.dialect() == Dialect::lajolla && lajolla_fallback) return in_scene(*lajolla_fallback, context);
    if (!fallback) plugin.fail(fmt::format("parameter '{}' is missing: {}", declared.name, declared.meaning));
    return in_scene(*fallback, context);
  }
};

/// A required number.
Parameter<double> number(const std::string& name, const std::string& unit, const std::string& meaning);
/// A number with a fallback.
Parameter<double> number(const std::string& name, const std::string& unit, double fallback, const std::string& meaning);
/// An integer.
Parameter<int> integer(const std::string& name, const std::string& meaning, int fallback);
/// A boolean.
Parameter<bool> boolean(const std::string& name, const std::string& meaning, bool fallback = false);
/// The path of a file, relative to the scene file.
Parameter<std::string> file(const std::string& name, const std::string& meaning);
/// A point or vector.
Parameter<Vec3d> point(const std::string& name, const std::string& meaning, const Vec3d& fallback);
/// A required colour.
Parameter<Spectrum> color(const std::string& name, const std::string& unit, const std::string& meaning);
/// A colour with a fallback.
Parameter<Spectrum> color(const std::string& name, const std::string& unit, const std::string& meaning,
                          const Spectrum& fallback);
/// A reflectance or transmittance in [0, 1].
Parameter<Spectrum> reflectance(const std::string& name, const std::string& meaning, const Spectrum& fallback);
/// The parameter, or a texture in its place.
template <class T> Parameter<std::variant<T, Texture>> or_texture(const Parameter<T>& p) {
  Parameter<std::variant<T, Texture>> either{p.declared, {}};
  either.declared.type += " or texture";
  either.declared.tags.insert(either.declared.tags.end(), {"texture", "ref"});
  either.parse = [parse = p.parse](const XmlElement& e, Context& context) -> std::variant<T, Texture> {
    if (e.tag == "texture" || e.tag == "ref") return context.texture(e);
    return parse(e, context);
  };
  if (p.fallback) either.fallback = *p.fallback;
  if (p.lajolla_fallback) either.lajolla_fallback = *p.lajolla_fallback;
  return either;
}
/// A constant colour or a texture.
using Reflectance = std::variant<Spectrum, Texture>;
/// A reflectance in [0, 1], constant or from a texture.
Parameter<Reflectance> reflectance_or_texture(const std::string& name, const std::string& meaning,
                                              const Spectrum& fallback);
/// Reads an image whose codes have the given meaning.
using PictureSource = std::function<std::shared_ptr<const Texels>(const std::optional<Transfer>& transfer)>;
/// An image file, relative to the scene file, with codes that other parameters may give a meaning.
Parameter<PictureSource> encoded_picture(const std::string& name, const std::string& meaning);
/// An image file, relative to the scene file.
Parameter<std::shared_ptr<const Texels>> picture(const std::string& name, const std::string& meaning);
/// A transform.
Parameter<Transform> transform(const std::string& name, const std::string& meaning);

/// A required word of a list, as its index in the list.
Parameter<std::size_t> choice(const std::string& name, const std::vector<std::string>& words,
                              const std::string& meaning);
/// A word of a list, as its index in the list, with a fallback.
Parameter<std::size_t> choice(const std::string& name, const std::vector<std::string>& words,
                              const std::string& meaning, std::size_t fallback);

/// The parameter without a fallback value: nullopt if it is omitted.
template <class T> Parameter<std::optional<T>> optional(const Parameter<T>& p) {
  return Parameter<std::optional<T>>{p.declared, p.parse}.with_default(std::nullopt, "none");
}

/// A parameter accepted without effect, because it cannot change the image.
Declaration no_effect(const std::string& name, const std::string& why);
/// A switch of which only the default value is supported.
Declaration only(bool value, const std::string& name, const std::string& meaning);

} // namespace render::mitsuba

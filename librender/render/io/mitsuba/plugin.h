#pragma once
/// A plugin of a scene file is one row of a table: name, description, parameters and factory function.

#include <render/io/mitsuba/parameter.h>

#include <mc/core/error.h>

#include <tuple>

namespace render::mitsuba {

/// The part of a row that does not depend on the type of the plugin.
struct PluginText {
  std::string name, meaning;           ///< Name and description.
  std::vector<Declaration> parameters; ///< Its parameters.
};

/// A row of the table of one kind of plugin; T is the C++ type of that kind.
template <class T> struct Plugin : PluginText {
  std::function<T(const XmlElement&, Context&)> read; ///< Makes the object that an element describes.
  /// The row with further parameters that are accepted but not read.
  Plugin accepting(const std::vector<Declaration>& more) && {
    parameters.insert(parameters.end(), more.begin(), more.end());
    return std::move(*this);
  }
};

/// The table of one kind of plugin.
template <class T> using Plugins = std::vector<Plugin<T>>;

namespace detail {

template <class T, class Make, class... V> struct Reading {
  Make make;
  std::tuple<Parameter<V>...> parameters;

  T operator()(const XmlElement& e, Context& context) const {
    // Braces evaluate in order, so errors name the first wrong parameter.
    std::tuple<V...> values =
        std::apply([&](const auto&... p) { return std::tuple<V...>{p.read(e, context)...}; }, parameters);
    return mc::with_context(fmt::format("{}: <{}>", e.where(), e.tag),
                            [&]() -> T { return std::apply(make, std::move(values)); });
  }
};

/// Throws Error unless every child is a parameter of the row, or a <ref> to one.
void require_known_children(const XmlElement& e, const PluginText& row, const Context& context);
/// Throws Error for an unknown type, with the most similar name.
[[noreturn]] void fail_unknown_type(const XmlElement& e, const std::vector<std::string_view>& known);

} // namespace detail

/// The row of a plugin; `make` is called with the values of the parameters, in their order.
template <class T, class Make, class... V>
Plugin<T> plugin(std::string name, std::string meaning, Make make, const Parameter<V>&... parameters) {
  return {{std::move(name), std::move(meaning), {parameters.declared...}},
          detail::Reading<T, Make, V...>{make, {parameters...}}};
}

/// Makes the object that an element describes, by the row of its type.
///   throws : Error "scene.xml:14: <bsdf>: ..." for an unknown type or child, with the most similar name, and for
///            invalid values.
template <class T> T read_plugin(const Plugins<T>& rows, const XmlElement& e, Context& context) {
  e.mark_used();
  e.attribute_or("id", "");
  e.attribute_or("name", "");
  const std::string& type = e.attribute("type");
  std::vector<std::string_view> known;
  for (const Plugin<T>& row : rows) {
    if (row.name == type) {
      detail::require_known_children(e, row, context);
      return row.read(e, context);
    }
    known.push_back(row.name);
  }
  detail::fail_unknown_type(e, known);
}

/// A nested plugin, or a <ref> to one, as a parameter of another plugin: <film> in <sensor>.
template <class T> Parameter<T> nested(std::string tag, std::string meaning, const Plugins<T>& (*rows)()) {
  return {{"<" + tag + ">", tag, "", {tag}, std::move(meaning)}, [rows, tag](const XmlElement& e, Context& context) {
            return read_plugin(rows(), context.resolve(e, {tag}), context);
          }};
}

} // namespace render::mitsuba

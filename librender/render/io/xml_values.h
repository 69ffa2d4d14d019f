#pragma once
/// Numbers, colours and transforms in Mitsuba's XML notation.

#include <render/core/transform.h>
#include <render/io/xml.h>

#include <optional>
#include <string>

namespace render {

/// Every function throws Error with file and line for a value that cannot be read.
double parse_number(const XmlElement& element, const std::string& text);
/// n numbers separated by commas or blanks.
std::vector<double> parse_numbers(const XmlElement& element, const std::string& text, std::size_t n);

/// The children of a plugin element by kind and name, e.g. <float name="fov" value="40"/>. A child that was found is
/// marked as seen; a child of the same name but another kind is an error.
class Parameters {
 public:
  explicit Parameters(const XmlElement& element) : element_(element) {}

  const XmlElement* find(std::string_view name) const;
  double number(std::string_view name, std::optional<double> fallback = {}) const;
  int integer(std::string_view name, std::optional<int> fallback = {}) const;
  bool boolean(std::string_view name, bool fallback) const;
  std::string string(std::string_view name, std::optional<std::string> fallback = {}) const;
  /// <point> or <vector>, as x, y, z attributes or as a value.
  Vec3d vector(std::string_view name, std::optional<Vec3d> fallback = {}) const;
  /// <spectrum>, <rgb> or <srgb>, as linear sRGB.
  Spectrum color(std::string_view name, std::optional<Spectrum> fallback = {}) const;
  /// <transform>: lookAt, translate, scale, rotate, matrix, applied in order; identity when absent.
  Transform transform(std::string_view name) const;
  /// Marks parameters that cannot change the picture.
  void accept(std::initializer_list<std::string_view> names) const;

 private:
  const XmlElement* value_of(std::string_view name, std::initializer_list<std::string_view> kinds) const;
  [[noreturn]] void missing(std::string_view name) const;
  const XmlElement& element_;
};

} // namespace render

#include <render/io/mitsuba/values.h>

#include <render/io/image/srgb.h>

#include <mc/core/error.h>
#include <mc/core/text.h>

#include <cmath>

namespace render::mitsuba {

namespace {

constexpr const char* separators = " ,\t\r\n";

Vec3d three(const XmlElement& e, const std::string& text) {
  const std::vector<double> v = parse_numbers(e, text);
  if (v.size() == 1) return Vec3d::Constant(v[0]);
  if (v.size() != 3) e.fail(fmt::format("'{}' has {} numbers; give 1 or 3", text, v.size()));
  return {v[0], v[1], v[2]};
}

Vec3d axes_of(const XmlElement& e, double missing) {
  if (e.has("value")) return three(e, e.attribute("value"));
  const auto axis = [&](const char* key) { return e.has(key) ? parse_number(e, e.attribute(key)) : missing; };
  return {axis("x"), axis("y"), axis("z")};
}

Transform look_at(const XmlElement& e) {
  const Vec3d origin = three(e, e.attribute("origin")), target = three(e, e.attribute("target")),
              up = three(e, e.attribute("up"));
  return mc::with_context(e.where(), [&] { return Transform::look_at(origin, target, up); });
}

Transform rotation(const XmlElement& e) {
  const Vec3d axis = axes_of(e, 0);
  const double degrees = parse_number(e, e.attribute("angle"));
  return mc::with_context(e.where(), [&] { return Transform::rotate(axis, degrees); });
}

Transform matrix(const XmlElement& e) {
  const std::vector<double> m = parse_numbers(e, e.attribute("value"));
  if (m.size() != 16) e.fail(fmt::format("the matrix has {} numbers; 16 are needed, row by row", m.size()));
  if (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1) e.fail("the last row of the matrix must be 0 0 0 1");
  return Transform::columns({m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}, {m[3], m[7], m[11]});
}

Transform step(const XmlElement& e) {
  if (e.tag == "lookAt" || e.tag == "lookat") return look_at(e);
  if (e.tag == "rotate") return rotation(e);
  if (e.tag == "translate") return Transform::translate(axes_of(e, 0));
  if (e.tag == "scale") return Transform::scale(axes_of(e, 1));
  if (e.tag == "matrix") return matrix(e);
  e.fail("unknown transformation; use lookAt, translate, scale, rotate or matrix");
}

Vec3d hexadecimal(const XmlElement& e, const std::string& text) {
  if (text.size() != 7 || text.find_first_not_of("0123456789abcdefABCDEF", 1) != std::string::npos)
    e.fail(fmt::format("'{}' is not #rrggbb", text));
  Vec3d v;
  for (int i = 0; i < 3; ++i)
    v[i] = std::stoi(text.substr(1 + 2 * static_cast<std::size_t>(i), 2), nullptr, 16) / 255.0;
  return v;
}

// Converts wavelength:value pairs, separated by commas or blanks. Blanks may surround the colons.
Spectrum tabulated(const XmlElement& e, const std::string& text, Illuminant illuminant, Extrapolation extrapolation) {
  std::vector<SpectralSample> samples;
  const auto place = [&](std::size_t i) { return std::min(i, text.size()); };
  for (std::size_t begin = 0; (begin = text.find_first_not_of(separators, begin)) != std::string::npos;) {
    const std::size_t colon = text.find(':', begin);
    const std::string wavelength(mc::trimmed(std::string_view(text).substr(begin, colon - begin)));
    if (colon == std::string::npos || wavelength.find_first_of(separators) != std::string::npos)
      e.fail(fmt::format("'{}' is not wavelength:value",
                         text.substr(begin, place(text.find_first_of(separators, begin)) - begin)));
    const std::size_t value = place(text.find_first_not_of(" \t\r\n", colon + 1)),
                      end = place(text.find_first_of(separators, value));
    samples.push_back({parse_number(e, wavelength), parse_number(e, text.substr(value, end - value))});
    if (samples.back().value < 0)
      e.fail(fmt::format("'{}' is below 0 at {} nm; say 0", samples.back().value, samples.back().wavelength));
    begin = end;
  }
  if (samples.size() > 1 && (samples.back().wavelength < 400 || samples[0].wavelength > 700))
    e.fail(fmt::format("its wavelengths, {} to {}, are not seen; give them in nanometres, some of them from 400 to 700",
                       samples[0].wavelength, samples.back().wavelength));
  const Spectrum rgb = mc::with_context(e.where(), [&] { return spectrum_to_rgb(samples, illuminant, extrapolation); });
  return extrapolation == Extrapolation::constant ? rgb : Spectrum(rgb.max(0));
}

bool is_tabulated(const XmlElement& e) {
  return e.tag == "spectrum" && e.attribute("value").find(':') != std::string::npos;
}

} // namespace

double parse_number(const XmlElement& element, const std::string& text) {
  const char *begin = text.data(), *end = begin + text.size();
  while (begin < end && std::isspace(static_cast<unsigned char>(*begin))) ++begin;
  while (end > begin && std::isspace(static_cast<unsigned char>(end[-1]))) --end;
  const std::optional<double> value = mc::parse_double({begin, end});
  if (!value || !std::isfinite(*value)) element.fail(fmt::format("'{}' is not a finite number", text));
  return *value;
}

std::vector<double> parse_numbers(const XmlElement& element, const std::string& text) {
  std::vector<double> values;
  for (std::size_t begin = 0; (begin = text.find_first_not_of(separators, begin)) != std::string::npos;) {
    const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
    values.push_back(parse_number(element, text.substr(begin, end - begin)));
    begin = end;
  }
  return values;
}

double number_of(const XmlElement& element) { return parse_number(element, element.attribute("value")); }

int integer_of(const XmlElement& element) {
  const double value = number_of(element);
  if (value != std::floor(value) || std::abs(value) > 1e9)
    element.fail(fmt::format("'{}' is not an integer up to 1e9", element.attribute("value")));
  return static_cast<int>(value);
}

bool boolean_of(const XmlElement& element) {
  const std::string& text = element.attribute("value");
  if (text != "true" && text != "false") element.fail(fmt::format("'{}' is neither true nor false", text));
  return text == "true";
}

Vec3d vector_of(const XmlElement& element) { return axes_of(element, 0); }

Spectrum color_of(const XmlElement& element, Extrapolation extrapolation) {
  const std::string& text = element.attribute("value");
  if (is_tabulated(element)) return tabulated(element, text, Illuminant::equal_energy, extrapolation);
  Vec3d v = text.starts_with('#') ? hexadecimal(element, text) : three(element, text);
  if (element.tag == "srgb")
    for (int i = 0; i < 3; ++i) v[i] = srgb_to_linear(v[i]);
  return v.cast<Float>().array();
}

Spectrum reflectance_of(const XmlElement& element, Illuminant illuminant, Extrapolation extrapolation) {
  if (illuminant == Illuminant::equal_energy || !is_tabulated(element)) return color_of(element, extrapolation);
  return tabulated(element, element.attribute("value"), illuminant, extrapolation).max(0).min(1);
}

Transform transform_of(const XmlElement& element) {
  Transform t;
  for (const XmlElement& child : element.children) {
    child.mark_used();
    t = step(child) * t;
  }
  return t;
}

} // namespace render::mitsuba

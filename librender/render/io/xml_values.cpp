#include <render/io/xml_values.h>

#include <render/io/spectrum.h>

#include <mc/core/error.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace render {

namespace {

Vec3d triple(const XmlElement& e, double fallback) {
  if (e.has("value")) {
    const std::string& text = e.attribute("value");
    if (text.find_first_of(" ,\t") == std::string::npos) return Vec3d::Constant(parse_number(e, text));
    const auto v = parse_numbers(e, text, 3);
    return {v[0], v[1], v[2]};
  }
  const auto axis = [&](const char* key) { return e.has(key) ? parse_number(e, e.attribute(key)) : fallback; };
  return {axis("x"), axis("y"), axis("z")};
}

Transform look_at(const XmlElement& e) {
  const auto point = [&](const char* key) {
    const auto v = parse_numbers(e, e.attribute(key), 3);
    return Vec3d(v[0], v[1], v[2]);
  };
  const Vec3d origin = point("origin"), target = point("target"), up = point("up");
  return mc::with_context(e.where(), [&] { return Transform::look_at(origin, target, up); });
}

Transform rotation(const XmlElement& e) {
  const Vec3d axis = triple(e, 0);
  const double degrees = parse_number(e, e.attribute("angle"));
  return mc::with_context(e.where(), [&] { return Transform::rotate(axis, degrees); });
}

Transform matrix(const XmlElement& e) {
  const auto m = parse_numbers(e, e.attribute("value"), 16);
  if (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1) e.fail("matrix: the last row must be 0 0 0 1");
  return Transform::columns({m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}, {m[3], m[7], m[11]});
}

Transform step(const XmlElement& e) {
  if (e.tag == "lookAt" || e.tag == "lookat") return look_at(e);
  if (e.tag == "rotate") return rotation(e);
  if (e.tag == "translate") return Transform::translate(triple(e, 0));
  if (e.tag == "scale") return Transform::scale(triple(e, 1));
  if (e.tag == "matrix") return matrix(e);
  e.fail("unknown transformation; use lookAt, translate, scale, rotate or matrix");
}

double srgb_to_linear(double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); }

} // namespace

double parse_number(const XmlElement& element, const std::string& text) {
  double value = 0;
  const char *begin = text.data(), *end = begin + text.size();
  while (begin < end && std::isspace(static_cast<unsigned char>(*begin))) ++begin;
  while (end > begin && std::isspace(static_cast<unsigned char>(end[-1]))) --end;
  const auto [after, error] = std::from_chars(begin, end, value);
  if (error != std::errc{} || after != end || !std::isfinite(value))
    element.fail(fmt::format("'{}' is not a finite number", text));
  return value;
}

std::vector<double> parse_numbers(const XmlElement& element, const std::string& text, std::size_t n) {
  std::vector<double> values;
  for (std::size_t begin = 0; (begin = text.find_first_not_of(" ,\t\r\n", begin)) != std::string::npos;) {
    const std::size_t end = std::min(text.find_first_of(" ,\t\r\n", begin), text.size());
    values.push_back(parse_number(element, text.substr(begin, end - begin)));
    begin = end;
  }
  if (values.size() != n) element.fail(fmt::format("'{}' has {} numbers; {} are needed", text, values.size(), n));
  return values;
}

const XmlElement* Parameters::find(std::string_view name) const {
  for (const XmlElement& child : element_.children)
    if (child.attribute_or("name", "") == name) {
      child.mark();
      return &child;
    }
  return nullptr;
}

const XmlElement* Parameters::value_of(std::string_view name, std::initializer_list<std::string_view> kinds) const {
  const XmlElement* e = find(name);
  if (e && std::find(kinds.begin(), kinds.end(), e->tag) == kinds.end())
    e->fail(fmt::format("'{}' must be a <{}>", name, fmt::join(kinds, "> or <")));
  return e;
}

void Parameters::missing(std::string_view name) const { element_.fail(fmt::format("parameter '{}' is missing", name)); }

double Parameters::number(std::string_view name, std::optional<double> fallback) const {
  if (const XmlElement* e = value_of(name, {"float", "integer"})) return parse_number(*e, e->attribute("value"));
  if (!fallback) missing(name);
  return *fallback;
}

int Parameters::integer(std::string_view name, std::optional<int> fallback) const {
  if (const XmlElement* e = value_of(name, {"integer"})) {
    const double value = parse_number(*e, e->attribute("value"));
    if (value != std::floor(value) || std::abs(value) > 1e9)
      e->fail(fmt::format("'{}' is not an integer", e->attribute("value")));
    return static_cast<int>(value);
  }
  if (!fallback) missing(name);
  return *fallback;
}

bool Parameters::boolean(std::string_view name, bool fallback) const {
  const XmlElement* e = value_of(name, {"boolean"});
  if (!e) return fallback;
  const std::string& text = e->attribute("value");
  if (text != "true" && text != "false") e->fail(fmt::format("'{}' is neither true nor false", text));
  return text == "true";
}

std::string Parameters::string(std::string_view name, std::optional<std::string> fallback) const {
  if (const XmlElement* e = value_of(name, {"string"})) return e->attribute("value");
  if (!fallback) missing(name);
  return *fallback;
}

Vec3d Parameters::vector(std::string_view name, std::optional<Vec3d> fallback) const {
  if (const XmlElement* e = value_of(name, {"point", "vector"})) return triple(*e, 0);
  if (!fallback) missing(name);
  return *fallback;
}

Spectrum Parameters::color(std::string_view name, std::optional<Spectrum> fallback) const {
  const XmlElement* e = value_of(name, {"spectrum", "rgb", "srgb"});
  if (!e) {
    if (!fallback) missing(name);
    return *fallback;
  }
  const std::string& text = e->attribute("value");
  if (e->tag == "spectrum" && text.find(':') != std::string::npos) {
    std::vector<SpectralSample> samples;
    for (std::size_t begin = 0; (begin = text.find_first_not_of(" ,\t\r\n", begin)) != std::string::npos;) {
      const std::size_t colon = text.find(':', begin), end = std::min(text.find(',', begin), text.size());
      if (colon == std::string::npos || colon > end)
        e->fail(fmt::format("'{}' is not wavelength:value", text.substr(begin, end - begin)));
      samples.push_back({parse_number(*e, text.substr(begin, colon - begin)),
                         parse_number(*e, text.substr(colon + 1, end - colon - 1))});
      begin = end;
    }
    return mc::with_context(e->where(), [&] { return spectrum_to_rgb(samples); });
  }
  std::vector<double> v;
  if (text.starts_with('#')) {
    if (text.size() != 7 || text.find_first_not_of("0123456789abcdefABCDEF", 1) != std::string::npos)
      e->fail(fmt::format("'{}' is not #rrggbb", text));
    for (std::size_t i = 1; i < 7; i += 2)
      v.push_back(srgb_to_linear(std::stoi(text.substr(i, 2), nullptr, 16) / 255.0));
  } else if (text.find_first_of(" ,\t") == std::string::npos) {
    v.assign(3, parse_number(*e, text));
  } else {
    v = parse_numbers(*e, text, 3);
  }
  if (e->tag == "srgb" && !text.starts_with('#'))
    for (double& x : v) x = srgb_to_linear(x);
  return Spectrum(Float(v[0]), Float(v[1]), Float(v[2]));
}

Transform Parameters::transform(std::string_view name) const {
  Transform t;
  if (const XmlElement* e = value_of(name, {"transform"}))
    for (const XmlElement& child : e->children) {
      child.mark();
      t = step(child) * t;
    }
  return t;
}

void Parameters::accept(std::initializer_list<std::string_view> names) const {
  for (const std::string_view name : names)
    if (const XmlElement* e = find(name)) e->attribute_or("value", "");
}

} // namespace render

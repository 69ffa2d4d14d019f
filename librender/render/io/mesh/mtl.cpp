#include <render/io/mesh/mtl.h>
#include <render/io/mesh/text_lines.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/text.h>

#include <array>
#include <charconv>

namespace render {

namespace {

double read_number(std::size_t line, std::string_view keyword, std::string_view& rest) {
  const std::string_view word = next_word(rest);
  const std::optional<double> value = mc::parse_double(word);
  mc::require(value && std::isfinite(*value), "line {}: {} needs a finite number, but has '{}'", line, keyword, word);
  return *value;
}

// Three numbers, or one for all channels.
Spectrum read_color(std::size_t line, std::string_view keyword, std::string_view rest) {
  std::array<double, 3> rgb = {};
  rgb[0] = read_number(line, keyword, rest);
  const bool is_gray = rest_of_line(rest).empty();
  for (std::size_t c = 1; c < 3; ++c) rgb[c] = is_gray ? rgb[0] : read_number(line, keyword, rest);
  mc::require(std::min({rgb[0], rgb[1], rgb[2]}) >= 0, "line {}: {} ({}, {}, {}) must be >= 0", line, keyword, rgb[0],
              rgb[1], rgb[2]);
  return {Float(rgb[0]), Float(rgb[1]), Float(rgb[2])};
}

void read_statement(std::size_t line, std::string_view keyword, std::string_view rest, MtlMaterial& material) {
  const auto number = [&](double least, double most, const char* range) {
    const double value = read_number(line, keyword, rest);
    mc::require(value >= least && value <= most, "line {}: {} {} must {}", line, keyword, value, range);
    return value;
  };
  const double infinity = mc::infinity<double>;
  if (keyword == "Kd") material.Kd = read_color(line, keyword, rest);
  else if (keyword == "Ks") material.Ks = read_color(line, keyword, rest);
  else if (keyword == "Ke") material.Ke = read_color(line, keyword, rest);
  else if (keyword == "Ns") material.Ns = number(0, infinity, "be >= 0");
  else if (keyword == "Ni") material.Ni = number(std::numeric_limits<double>::min(), infinity, "be > 0");
  else if (keyword == "d") material.d = number(0, 1, "lie in [0, 1]");
  else if (keyword == "Tr") material.d = 1 - number(0, 1, "lie in [0, 1]");
  else if (keyword == "illum") material.illum = static_cast<int>(number(0, 10, "lie in 0..10"));
  else if (keyword == "map_Kd") {
    // Options begin with a hyphen and have numbers or words; the name is the last word then.
    std::string_view name = rest_of_line(rest);
    if (name.starts_with('-')) name.remove_prefix(name.find_last_of(" \t") + 1);
    material.map_Kd = name;
  }
}

} // namespace

std::map<std::string, MtlMaterial, std::less<>> read_mtl(const std::string& path) {
  const std::string text = with_plain_ends(mc::read_text(path));
  std::map<std::string, MtlMaterial, std::less<>> materials;
  mc::with_context(path, [&] {
    MtlMaterial* material = nullptr;
    for_each_line(text, [&](std::size_t line, std::string_view keyword, std::string_view rest) {
      if (keyword == "newmtl") material = &(materials[std::string(rest_of_line(rest))] = MtlMaterial());
      else if (material) read_statement(line, keyword, rest, *material);
    });
  });
  return materials;
}

} // namespace render

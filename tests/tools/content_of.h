#pragma once
// Results of carlo without what may differ between two runs with the same bits.

#include <render/io/image/image_io.h>

#include <mc/core/file.h>
#include <mc/core/text.h>

#include <fmt/format.h>

#include <regex>
#include <string>
#include <string_view>
#include <vector>

namespace support {

// A CSV table without columns of CPU seconds.
inline std::string without_seconds(const std::string& csv) {
  std::string text;
  std::vector<bool> kept;
  for (const std::string_view line : mc::split(csv, '\n')) {
    const std::vector<std::string_view> cells = mc::split(line, ',');
    if (kept.empty())
      for (const std::string_view name : cells) kept.push_back(name.find("seconds") == name.npos);
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (i < kept.size() && kept[i]) text += std::string(cells[i]) + ",";
    text += "\n";
  }
  return text;
}

// What must not depend on interruptions: pictures without metadata, numbers without times.
inline std::string content_of(const std::string& file) {
  if (file.ends_with(".csv")) return without_seconds(mc::read_file(file));
  if (file.ends_with(".json"))
    return std::regex_replace(mc::read_file(file), std::regex("\"(seconds|ns_per_sample|command)\": [^\n]*"), "");
  const render::Image image = render::read_image(file);
  std::string text = fmt::format("{} {}\n", image.width, image.height);
  for (const auto* pixels : {&image.pixels, &image.variance})
    for (const render::Spectrum& p : *pixels) text += fmt::format("{} {} {}\n", p[0], p[1], p[2]);
  return text;
}

} // namespace support

#include <report/html.h>
#include <report/packed.h>
#include <report/page_template.h>
#include <report/view_page.h>
#include <view_page_parts.h>

#include <render/film/confidence_interval.h>

#include <mc/core/error.h>
#include <mc/core/memory.h>
#include <mc/core/text.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace carlo {

namespace {

using nlohmann::json;

constexpr std::size_t most_pixels = std::size_t{1} << 24;

// Three planes of numbers, one behind the other.
std::string packed_planes(const std::vector<render::Spectrum>& pixels) {
  std::vector<float> numbers;
  numbers.reserve(3 * pixels.size());
  for (int c = 0; c < 3; ++c)
    for (const render::Spectrum& p : pixels) numbers.push_back(static_cast<float>(p[c]));
  return packed("", numbers);
}

json picture_json(const std::string& name, const render::Image& image) {
  json layers = json::object(), metadata = json::object();
  for (const auto& [key, numbers] : image.layers) layers[mc::printable(key)] = packed("", numbers);
  for (const auto& [key, value] : image.metadata) metadata[mc::printable(key)] = mc::printable(value, 1000);
  const bool has_error = !image.variance.empty() && image.estimates >= 2;
  return {{"name", mc::printable(name)},
          {"radiance", packed_planes(image.pixels)},
          {"half_width", has_error ? json(packed_planes(render::interval_half_widths(image, 0.95).pixels)) : json()},
          {"layers", std::move(layers)},
          {"metadata", std::move(metadata)}};
}

} // namespace

std::string to_html(const ViewPage& page) {
  mc::require(page.pictures.size() == 1 || page.pictures.size() == 2, "a page has one picture or two, not {}",
              page.pictures.size());
  const render::Image& first = *page.pictures.front().second;
  json pictures = json::array();
  for (const auto& [name, image] : page.pictures) {
    mc::require(image->width == first.width && image->height == first.height,
                "'{}' has {}x{} pixels and '{}' has {}x{}: two pictures of a page have the same size",
                page.pictures.front().first, first.width, first.height, name, image->width, image->height);
    pictures.push_back(picture_json(name, *image));
  }
  json data = {{"tool", page.tool},
               {"title", mc::printable(page.title, 1000)},
               {"command", mc::printable(page.command, 4000)},
               {"verdict", page.verdict},
               {"width", first.width},
               {"height", first.height},
               {"x", page.x},
               {"y", page.y},
               {"exposure", page.exposure},
               {"pictures", std::move(pictures)},
               {"progress", nullptr}};
  if (const ViewProgress* p = page.progress)
    data["progress"] = {{"text", p->text}, {"fraction", p->fraction}, {"errors", p->errors}};
  const bool is_running = page.progress && page.progress->is_running;
  return filled(view_html, {{"@TITLE@", escape_html(page.title)},
                            {"@REFRESH@", is_running ? "<meta http-equiv=\"refresh\" content=\"2\">" : ""},
                            {"@CSS@", std::string(view_page_css) + view_css},
                            {"@DATA@", script_safe(data.dump(-1, ' ', false, json::error_handler_t::replace))},
                            {"@JS@", std::string(view_unpack_js) + view_js}});
}

void require_viewable(const std::string& name, const render::Image& image, const std::string& remedy) {
  mc::require(image.pixels.size() <= most_pixels, "'{}' has {}x{} pixels, and a page at most {}; {}", name, image.width,
              image.height, most_pixels, remedy);
  constexpr double per_pixel = 150; // numbers, their bytes, and these as text, in the page and in its data
  mc::require_memory(per_pixel * double(image.pixels.size()),
                     fmt::format("a page of {}x{} pixels", image.width, image.height), remedy);
}

} // namespace carlo

#include <render/pixel_points.h>

#include <mc/core/text.h>

#include <array>

namespace render {

namespace {

constexpr std::array<std::string_view, 3> sampler_names = {"independent", "stratified", "sobol"};

} // namespace

PixelSampler sampler_from(std::string_view word) {
  return static_cast<PixelSampler>(mc::index_of("sampler", word, sampler_names));
}

std::string_view name(PixelSampler sampler) { return sampler_names[static_cast<std::size_t>(sampler)]; }

} // namespace render

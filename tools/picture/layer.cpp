#include <picture/layer.h>

#include <mc/core/error.h>
#include <mc/core/text.h>
#include <mc/random/hash.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <string_view>

namespace carlo {

using render::Image, render::Spectrum, render::Float;

namespace {

using Plane = std::vector<float>;

std::string lowercase(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return lower;
}

// "albedo" of "albedo.R"; a name without a dot is a layer of one channel.
std::string layer_of(const std::string& channel) { return channel.substr(0, channel.rfind('.')); }

// "r" of "albedo.R".
std::string component_of(const std::string& channel) { return lowercase(channel.substr(channel.rfind('.') + 1)); }

struct Channels {
  std::vector<const Plane*> planes; ///< one for grey, else red, green and, unless there are two, blue
  LayerKind kind = LayerKind::data;
};

// The channels of a layer; none where it does not exist.
//   throws : Error where they are no picture.
Channels channels_of(const Image& image, const std::string& name, const std::string& file) {
  if (const auto one = image.layers.find(name); one != image.layers.end()) return {{&one->second}, LayerKind::data};
  std::map<std::string, const Plane*> found;
  std::vector<std::string> names;
  for (const auto& [channel, plane] : image.layers) {
    if (layer_of(channel) != name || channel == name) continue;
    found[component_of(channel)] = &plane;
    names.push_back(channel);
  }
  if (found.empty()) return {};
  using Components = std::vector<std::string>;
  for (const Components& components : {Components{"r", "g", "b"}, {"x", "y", "z"}, {"x", "y"}, {"u", "v"}})
    if (std::all_of(components.begin(), components.end(), [&](const auto& c) { return found.contains(c); })) {
      Channels channels{{}, components.front() == "r" ? LayerKind::colour : LayerKind::data};
      for (const std::string& c : components) channels.planes.push_back(found.at(c));
      return channels;
    }
  found.erase("a");
  mc::require(found.size() == 1, "--layer {}: the channels {} of '{}' are no picture; name one of them", name,
              fmt::join(names, ", "), file);
  return {{found.begin()->second}, LayerKind::data};
}

// A colour of an id; equal ids have equal colours.
Spectrum color_of(Float id) {
  if (id == 0) return Spectrum::Zero();
  std::uint32_t bits;
  const float value = static_cast<float>(id);
  std::memcpy(&bits, &value, sizeof bits);
  const std::uint64_t random = mc::hash(std::uint64_t{bits}, std::uint64_t{1});
  Spectrum color;
  for (int c = 0; c < 3; ++c) color[c] = Float(0.1) + Float(0.9) * Float((random >> (16 * c)) & 0xffff) / Float(0xffff);
  return color;
}

// Maps the finite values of a channel to [0, 1].
void scale_to_range(Image& image, int c) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Spectrum& p : image.pixels)
    if (const auto value = double(p[c]); std::isfinite(value)) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  for (Spectrum& p : image.pixels) {
    const auto value = double(p[c]);
    if (std::isfinite(value)) p[c] = Float(high > low ? (value - low) / (high - low) : std::clamp(value, 0.0, 1.0));
    else p[c] = Float(value > 0 ? 1 : 0);
  }
}

} // namespace

std::vector<std::string> layer_names(const Image& image) {
  std::vector<std::string> names;
  if (!image.variance.empty()) names.emplace_back("variance");
  for (const auto& [channel, plane] : image.layers)
    if (const std::string name = layer_of(channel); std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  return names;
}

PictureLayer select_layer(const Image& image, const std::string& name, const std::string& file) {
  PictureLayer layer{Image(image.width, image.height), LayerKind::variance};
  layer.image.metadata = image.metadata;
  if (name == "variance" && !image.variance.empty()) {
    layer.image.pixels = image.variance;
    return layer;
  }
  const Channels channels = channels_of(image, name, file);
  if (channels.planes.empty()) {
    const std::vector<std::string> names = layer_names(image);
    mc::require(!names.empty(), "--layer {}: '{}' has no layers; carlo render --layers writes them", name, file);
    throw mc::Error(fmt::format("--layer {}: '{}' has no such layer{}; use one of {}", name, file,
                                mc::did_you_mean(name, names), fmt::join(names, ", ")));
  }
  const auto count = channels.planes.size();
  for (std::size_t i = 0; i < layer.image.pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      if (count == 1 || c < count)
        layer.image.pixels[i][static_cast<int>(c)] = Float((*channels.planes[count == 1 ? 0 : c])[i]);
  layer.kind = channels.kind;
  return layer;
}

void show_layer(PictureLayer& layer, const std::string& name) {
  if (layer.kind != LayerKind::data) return;
  Image& image = layer.image;
  const std::string last = component_of(name);
  if (last == "id") {
    for (Spectrum& p : image.pixels) p = color_of(p[0]);
  } else if (last == "n" || last == "normal" || last == "normals") {
    for (Spectrum& p : image.pixels)
      if (!render::is_black(p)) p = (p + Float(1)) / Float(2);
  } else {
    for (int c = 0; c < 3; ++c) scale_to_range(image, c);
  }
}

} // namespace carlo

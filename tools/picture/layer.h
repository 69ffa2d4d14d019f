#pragma once
/// Layers of a picture, as pictures.

#include <render/film/image.h>

#include <string>
#include <vector>

namespace carlo {

/// Names of the layers that select_layer() accepts: "variance" where it is known; "albedo" of the channels albedo.R,
/// albedo.G and albedo.B; "Z" of the channel Z.
std::vector<std::string> layer_names(const render::Image& image);

/// What the values of a layer are.
enum class LayerKind {
  colour,   ///< channels R, G and B: light, or shares of it
  variance, ///< of the pixels
  data      ///< anything else
};

/// A layer as a picture, with the metadata of the whole.
struct PictureLayer {
  render::Image image;
  LayerKind kind;
};

/// Selects a layer, or one channel such as "N.X". Channels R, G and B, or X, Y and Z, become red, green and blue; one
/// channel becomes grey.
///   file   : of the picture, for the message.
///   throws : Error for an unknown name, with the list of names.
PictureLayer select_layer(const render::Image& image, const std::string& name, const std::string& file);

/// Maps data to [0, 1] for display, by the last word of the layer's name. Other kinds stay as they are.
///   N, normal : n becomes (n + 1) / 2; black without a hit.
///   id        : every number has a colour of its own; 0 is black.
///   others    : each channel is scaled: its smallest finite value becomes 0, its largest 1. Infinity becomes 1, NaN
///               and -infinity become 0. A constant channel is clamped to [0, 1].
void show_layer(PictureLayer& layer, const std::string& name);

} // namespace carlo

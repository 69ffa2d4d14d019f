/// carlo image: turns a picture that carlo reads into one that it writes.

#include <options/memory_option.h>
#include <options/picture_output.h>
#include <options/pixels.h>
#include <options/subcommand.h>
#include <picture/crop.h>
#include <picture/layer.h>
#include <terminal/message.h>
#include <terminal/result_writer.h>

#include <render/io/image/image_io.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/memory.h>

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace carlo {

namespace {

using render::Image, render::Spectrum;

struct ImageCommandOptions {
  std::string in, out;
  std::string layer;            ///< empty: the radiance
  std::string crop;             ///< "X,Y,W,H"; empty: the whole picture
  std::string tone;             ///< curve of a PNG; empty: clamp
  std::string exposure;         ///< stops, or auto; empty: 0
  std::optional<double> memory; ///< [GiB]
  std::string command;          ///< the command line, for the metadata
};

std::vector<Option> rows(ImageCommandOptions& o) {
  return in_groups({
      {common_options,
       {
           input_file({"IN", "FILE", &o.in, "Picture: .exr, .pfm, .hdr, .png or .jpg.", true}),
           output_file({"OUT", "FILE", &o.out,
                        "Picture to write: .exr, .pfm or .png (sRGB, 8 bits). An .exr keeps the variance and all "
                        "layers of an .exr.",
                        true}),
           {"--crop", "X,Y,W,H", &o.crop,
            "Keep only this part, from pixel X, Y counted from the upper left corner. Variance and layers are cropped, "
            "too."},
           {"--exposure", "STOPS", &o.exposure,
            "Brightness in stops, or auto: a middle grey on average. Multiplies radiance by 2^STOPS and its variance "
            "by 4^STOPS; other layers stay. Default: 0."},
           {"--tone", "CURVE", &o.tone, "Curve of a PNG for bright light: clamp, reinhard or filmic. Default: clamp."},
           {"--layer", "NAME", &o.layer,
            "Write this layer of an .exr, or one channel such as N.X, instead of the radiance. A wrong name lists the "
            "names."},
       }},
      {expert_options, {memory_option(o.memory)}},
  });
}

bool is_exr(const std::string& path) { return mc::lowercase_extension(path) == ".exr"; }
bool is_png(const std::string& path) { return mc::lowercase_extension(path) == ".png"; }

// The name of a pixel for messages.
std::string place(const Image& image, std::size_t i) {
  const auto width = static_cast<std::size_t>(image.width);
  return fmt::format("pixel ({}, {})", i % width, i / width);
}

// Multiplies values by a factor.
//   throws : Error where a value leaves the range of a float, which files store.
void scale(std::vector<Spectrum>& values, double factor, const Image& image, const std::string& what) {
  using Limits = std::numeric_limits<float>;
  double largest = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double before = double(values[i][c]), after = before * factor;
      if (!std::isfinite(before)) continue;
      mc::require(std::abs(after) <= double(Limits::max()),
                  "{} of {} would be {:.3g}, beyond the largest float; take "
                  "fewer stops",
                  what, place(image, i), after);
      largest = std::max(largest, std::abs(before));
      values[i][c] = render::Float(after);
    }
  mc::require(largest == 0 || factor >= 1 || largest * factor >= double(Limits::min()),
              "{} would be at most {:.3g}, below the smallest float; take more stops", what, largest * factor);
}

// Brightens radiance, with its variance.
void expose(Image& image, double stops, const ImageCommandOptions& o) {
  if (stops == 0) return;
  scale(image.pixels, std::exp2(stops), image, fmt::format("--exposure {:.4g}: the radiance of '{}'", stops, o.in));
  scale(image.variance, std::exp2(2 * stops), image,
        fmt::format("--exposure {:.4g}: the variance of '{}'", stops, o.in));
}

// Warns of pixels that a PNG cannot show.
void warn_about_invalid(const Image& image, const std::string& name) {
  std::size_t count = 0, first = 0;
  for (std::size_t i = image.pixels.size(); i-- > 0;)
    if (!image.pixels[i].isFinite().all()) {
      ++count;
      first = i;
    }
  if (count > 0)
    warn("'{}': {} of {} pixels are not finite, the first at {}; in a PNG NaN is black and infinity white", name, count,
         image.pixels.size(), place(image, first));
}

// Reduces the picture to the layer. Returns what its values are.
LayerKind take_layer(Image& image, const ImageCommandOptions& o) {
  if (o.layer.empty()) return LayerKind::colour;
  PictureLayer layer = select_layer(image, o.layer, o.in);
  mc::require(is_png(o.out) || o.exposure.empty() || layer.kind == LayerKind::colour,
              "--exposure: the layer {} is no light, and '{}' stores its values as they are; write a .png", o.layer,
              o.out);
  if (is_png(o.out)) show_layer(layer, o.layer);
  image = std::move(layer.image);
  return layer.kind;
}

// Keeps the metadata true. A picture whose samples are not those of its render no longer states their number, so that
// carlo render --resume refuses it.
void update_metadata(Image& image, const ImageCommandOptions& o, double stops) {
  const bool is_changed = !o.layer.empty() || (stops != 0 && !is_png(o.out)) || !is_exr(o.in);
  if (is_changed) image.metadata.erase("carlo.samples_per_pixel");
  if (!o.layer.empty()) image.metadata["carlo.layer"] = o.layer;
  std::string& command = image.metadata["carlo.image_command"];
  command += (command.empty() ? "" : "; ") + o.command;
}

// What the format of the output cannot store; "" if nothing is lost.
std::string loss_of(const Image& image, const ImageCommandOptions& o) {
  if (is_exr(o.out) || (image.variance.empty() && image.layers.empty())) return {};
  std::string lost = image.variance.empty() ? "" : "variance";
  if (!image.layers.empty()) lost += (lost.empty() ? "" : " and ") + fmt::format("{} channels", image.layers.size());
  return fmt::format("; without {}, which only an .exr stores", lost);
}

void require_memory(const Image& image, const ImageCommandOptions& o) {
  const double extra = (image.variance.empty() ? 0 : 3) + double(image.layers.size());
  const double planes = is_exr(o.out) ? 3 + extra : 3;
  const double copies = o.layer.empty() ? planes : planes + 3;
  mc::require_memory(sizeof(float) * copies * double(image.pixels.size()),
                     fmt::format("image: {}x{} pixels", image.width, image.height), "a smaller --crop needs less");
}

int run_image(const ImageCommandOptions& o) {
  limit_memory(o.memory);
  require_picture_output(o.out);
  render::ToneMapping tone = parse_tone(o.tone, o.exposure);
  mc::require(o.tone.empty() || is_png(o.out), "--tone: '{}' stores radiance as it is; write a .png", o.out);
  mc::require(o.layer.empty() || is_exr(o.in), "--layer {}: '{}' has no layers; only an .exr has them", o.layer, o.in);
  const std::optional<render::Crop> part = o.crop.empty() ? std::nullopt : std::optional(parse_crop(o.crop));

  Image image = render::read_image(o.in);
  if (part) crop_picture(image, *part, o.in);
  require_memory(image, o);
  const LayerKind kind = take_layer(image, o);
  if (o.exposure == "auto") tone.exposure = auto_exposure(image);
  if (!is_png(o.out)) expose(image, tone.exposure, o);
  else if (kind != LayerKind::data) warn_about_invalid(image, o.in);
  update_metadata(image, o, tone.exposure);

  ResultWriter results;
  results.write(o.out, false, [&](const std::string& file) { render::write_image(file, image, tone); });
  results.finish();
  fmt::print("{}: {}x{} pixels{}{}\n", o.out, image.width, image.height,
             o.exposure == "auto" ? fmt::format(", exposure {:.3g}", tone.exposure) : "", loss_of(image, o));
  return exit_ok;
}

} // namespace

Subcommand image_subcommand() {
  return make_subcommand<ImageCommandOptions>(
      {.name = "image",
       .summary = "Convert a picture: format, exposure and tone, a part of it, or a layer of an EXR",
       .examples = {{"carlo image a.exr a.png --exposure auto --tone filmic", "shows radiance in a browser or a paper"},
                    {"carlo image a.exr part.exr --crop 100,50,64,64", "cuts radiance, variance and all layers"},
                    {"carlo image a.exr depth.png --layer Z", "shows the depth of carlo render --layers"}},
       .sections =
           {{"Layers",
             {{"", "carlo render --layers writes them. An .exr or .pfm receives their values as they are. In a .png, "
                   "--exposure and --tone apply after these steps:"},
              {"albedo", "Channels R, G and B of any layer are shown as colours."},
              {"variance", "The variance of the radiance is shown as it is; --exposure auto makes it visible."},
              {"N", "A normal n becomes the colour (n + 1) / 2. Pixels without a hit are black."},
              {"id", "Each shape has a colour of its own. Pixels without a hit are black."},
              {"Z, P, others", "Each channel is scaled, so that its smallest value is black and its largest white. An "
                               "infinite depth is white."}}},
            {"Formats",
             {{"", "An .exr receives radiance as 32-bit floats, with variance, layers and metadata. A .pfm receives "
                   "radiance alone. A .png receives sRGB with 8 bits, after exposure and tone, and the metadata. An "
                   "8-bit picture is decoded from sRGB when it is read. Transparency is ignored."}}}}},
      rows, run_image);
}

} // namespace carlo

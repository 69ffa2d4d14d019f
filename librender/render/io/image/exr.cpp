#include <render/io/image/formats.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/memory.h>
#include <mc/core/text.h>

#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfDoubleAttribute.h>
#include <ImfEnvmap.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

namespace render::formats {

namespace {

constexpr std::array<const char*, 6> channels = {"R", "G", "B", "variance.R", "variance.G", "variance.B"};
constexpr const char* estimates_key = "estimatesPerPixel";
constexpr const char* noise_area_key = "noiseArea";

// Throws Error for a channel of colour that is subsampled.
void require_whole_colours(const Imf::ChannelList& list) {
  for (auto c = list.begin(); c != list.end(); ++c)
    mc::require((c.channel().xSampling == 1 && c.channel().ySampling == 1) ||
                    (std::find(channels.begin(), channels.end(), std::string_view(c.name())) == channels.end() &&
                     std::string_view(c.name()) != "Y"),
                "EXR stores the channel {} for one pixel in {}; save it for every pixel", c.name(),
                c.channel().xSampling * c.channel().ySampling);
}

// Names of the channels that are not subsampled.
std::vector<std::string> whole_channels(const Imf::ChannelList& list) {
  std::vector<std::string> names;
  for (auto c = list.begin(); c != list.end(); ++c)
    if (c.channel().xSampling == 1 && c.channel().ySampling == 1) names.emplace_back(c.name());
  return names;
}

// Throws Error for a size that a file of this length cannot hold. Deflate expands a byte to at most 1032 bytes. DWA
// leaves at least one of the 64 coefficients of a block to deflate. No other compression of the format exceeds a factor
// of 4096.
void require_size(const Imf::Header& header, const std::string& path) {
  const auto& compression = header.compression();
  const bool is_dwa = compression == Imf::DWAA_COMPRESSION || compression == Imf::DWAB_COMPRESSION;
  const auto& window = header.dataWindow();
  const double bytes = double(std::filesystem::file_size(path)), width = double(window.max.x) - window.min.x + 1,
               height = double(window.max.y) - window.min.y + 1;
  const auto whole = whole_channels(header.channels());
  mc::require(width >= 1 && height >= 1 &&
                  width * height * 2 * double(whole.size()) <= (is_dwa ? 64 * 1032 : 4096) * bytes,
              "EXR says {}x{} in {} channels, which its {} bytes cannot hold", width, height, whole.size(), bytes);
}

// Rejects cube maps, which would otherwise be read as one latitude-longitude image.
void require_no_cube(const Imf::Header& header) {
  mc::require(!Imf::hasEnvmap(header) || Imf::envmap(header) != Imf::ENVMAP_CUBE,
              "EXR says in its envmap that it holds the sides of a cube; convert it to latitude and longitude");
}

// Rejects other colour spaces, which would otherwise be read as Rec. 709.
void require_our_colours(const Imf::Header& header) {
  for (const char* channel : {"RY", "BY"})
    mc::require(!header.channels().findChannel(channel),
                "EXR holds luminance and chroma (a channel {}); save it with the channels R, G and B", channel);
  if (!Imf::hasChromaticities(header)) return;
  const Imf::Chromaticities ours, &its = Imf::chromaticities(header); // the default is Rec. 709
  const std::tuple<const char*, Imath::V2f, Imath::V2f> colours[] = {{"red", its.red, ours.red},
                                                                     {"green", its.green, ours.green},
                                                                     {"blue", its.blue, ours.blue},
                                                                     {"white", its.white, ours.white}};
  for (const auto& [name, is, must] : colours)
    mc::require(
        (is - must).length() <= 1e-3f,
        "EXR says in its chromaticities that {} is ({}, {}); convert it to Rec. 709 (sRGB), where it is ({}, {})", name,
        is.x, is.y, must.x, must.y);
}

// One plane of floats per channel, in the layout of OpenEXR.
struct Planes {
  std::vector<std::vector<float>> plane;
  Imath::Box2i window; ///< window of the pixels
  Planes(std::size_t count, const Imath::Box2i& pixels)
      : plane(count, std::vector<float>(static_cast<std::size_t>(pixels.max.x - pixels.min.x + 1) *
                                        static_cast<std::size_t>(pixels.max.y - pixels.min.y + 1))),
        window(pixels) {}
  Imf::Slice slice(std::size_t c) { return Imf::Slice::Make(Imf::FLOAT, plane[c].data(), window); }
};

// A stream of replace_file() for OpenEXR, which seeks back to the table of its lines at the end.
class OutputStream : public Imf::OStream {
 public:
  explicit OutputStream(std::FILE* stream) : OStream("the stream"), stream_(stream) {}
  void write(const char bytes[], int size) override {
    mc::write_bytes(stream_, {bytes, static_cast<std::size_t>(size)});
  }
  std::uint64_t tellp() override { return static_cast<std::uint64_t>(ftello(stream_)); }
  void seekp(std::uint64_t place) override {
    const bool is_there = fseeko(stream_, static_cast<off_t>(place), SEEK_SET) == 0;
    mc::require(is_there, "{}", std::strerror(errno));
  }

 private:
  std::FILE* stream_;
};

} // namespace

void write_exr(std::FILE* stream, const Image& image) {
  try {
    const std::size_t count = image.variance.empty() ? 3 : 6;
    Imf::Header header(image.width, image.height);
    Imf::FrameBuffer frame;
    Planes planes(count, header.dataWindow());
    for (std::size_t c = 0; c < count; ++c) {
      header.channels().insert(channels[c], Imf::Channel(Imf::FLOAT));
      const auto& source = c < 3 ? image.pixels : image.variance;
      for (std::size_t i = 0; i < source.size(); ++i)
        planes.plane[c][i] = static_cast<float>(source[i][static_cast<int>(c % 3)]);
      frame.insert(channels[c], planes.slice(c));
    }
    Planes layers(image.layers.size(), header.dataWindow());
    std::size_t layer = 0;
    for (const auto& [name, values] : image.layers) {
      header.channels().insert(name, Imf::Channel(Imf::FLOAT));
      layers.plane[layer] = values;
      frame.insert(name, layers.slice(layer++));
    }
    for (const auto& [key, value] : image.metadata) header.insert(key, Imf::StringAttribute(value));
    if (image.estimates > 0) header.insert(estimates_key, Imf::IntAttribute(static_cast<int>(image.estimates)));
    if (image.noise_area != 1) header.insert(noise_area_key, Imf::DoubleAttribute(image.noise_area));
    OutputStream output(stream);
    Imf::OutputFile file(output, header);
    file.setFrameBuffer(frame);
    file.writePixels(image.height);
  } catch (const mc::Error&) {
    throw;
  } catch (const std::exception& e) {
    throw mc::Error(fmt::format("EXR: {}", e.what()));
  }
}

Image read_exr(const std::string& path) {
  try {
    Imf::InputFile file(path.c_str());
    require_our_colours(file.header());
    require_no_cube(file.header());
    require_whole_colours(file.header().channels());
    require_size(file.header(), path);
    const auto window = file.header().dataWindow();
    const auto has = [&](const char* channel) { return file.header().channels().findChannel(channel) != nullptr; };
    const bool grey = has("Y") && !has("R") && !has("G") && !has("B"), with_variance = has(channels[3]);
    std::vector<std::string> names = whole_channels(file.header().channels());
    std::erase_if(names, [&](const std::string& name) {
      return (grey && name == "Y") || std::find(channels.begin(), channels.end(), name) != channels.end();
    });
    const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
    for (std::size_t c = 0; c < 3; ++c)
      mc::require(grey || has(channels[c]), "EXR has no channel {}; R, G and B, or Y alone, are needed", channels[c]);
    const double floats = 2 * (with_variance ? 6 : 3) + double(names.size()); // of planes and pixels
    mc::require_memory(4 * floats * width * height, fmt::format("{}x{} pixels", width, height));
    Planes planes(with_variance ? 6 : 3, window);
    Imf::FrameBuffer frame;
    if (grey) frame.insert("Y", planes.slice(0));
    for (std::size_t c = grey ? 3 : 0; c < planes.plane.size(); ++c) frame.insert(channels[c], planes.slice(c));
    Planes layers(names.size(), window);
    for (std::size_t i = 0; i < names.size(); ++i) frame.insert(names[i], layers.slice(i));
    file.setFrameBuffer(frame);
    file.readPixels(window.min.y, window.max.y);
    if (grey) planes.plane[1] = planes.plane[2] = planes.plane[0];
    Image image(width, height);
    if (with_variance) image.variance.resize(image.pixels.size());
    for (std::size_t c = 0; c < planes.plane.size(); ++c) {
      auto& target = c < 3 ? image.pixels : image.variance;
      for (std::size_t i = 0; i < target.size(); ++i) target[i][static_cast<int>(c % 3)] = Float(planes.plane[c][i]);
    }
    for (std::size_t i = 0; i < names.size(); ++i) image.layers[names[i]] = std::move(layers.plane[i]);
    for (auto it = file.header().begin(); it != file.header().end(); ++it)
      if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&it.attribute()))
        image.metadata[it.name()] = text->value();
    if (const auto* count = file.header().findTypedAttribute<Imf::IntAttribute>(estimates_key);
        count && count->value() > 0)
      image.estimates = static_cast<std::uint32_t>(count->value());
    if (const auto* area = file.header().findTypedAttribute<Imf::DoubleAttribute>(noise_area_key);
        area && area->value() >= 1 && std::isfinite(area->value()))
      image.noise_area = area->value();
    return image;
  } catch (const mc::Error&) {
    throw;
  } catch (const std::exception& e) {
    throw mc::Error(fmt::format("cannot read EXR: {}", mc::printable(e.what())));
  }
}

} // namespace render::formats

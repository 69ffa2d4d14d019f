#include <render/io/image/formats.h>
#include <render/io/image/image_io.h>

#include <mc/core/error.h>
#include <mc/core/file.h>

#include <array>
#include <filesystem>
#include <vector>

namespace render {

namespace {

using Read = Image (*)(const std::string& path, const std::optional<Transfer>& transfer);
using Write = void (*)(std::FILE* stream, const Image& image, const ToneMapping& tone);

struct Format {
  std::string_view extension;
  Read read;
  Write write;
};

void write_exr(std::FILE* stream, const Image& image, const ToneMapping&) { formats::write_exr(stream, image); }
void write_pfm(std::FILE* stream, const Image& image, const ToneMapping&) { formats::write_pfm(stream, image); }

// Reads a format of linear values.
template <Image (*read)(const std::string&)>
Image read_linear(const std::string& path, const std::optional<Transfer>& transfer) {
  mc::require(!transfer || transfer->gamma == 1, "the values of this format are linear; leave out gamma, or say 1");
  return read(path);
}

constexpr auto known_formats = std::to_array<Format>({
    {".exr", read_linear<formats::read_exr>, write_exr},
    {".pfm", read_linear<formats::read_pfm>, write_pfm},
    {".hdr", read_linear<formats::read_hdr>, nullptr},
    {".png", formats::read_png, formats::write_png},
    {".jpg", formats::read_jpeg, nullptr},
    {".jpeg", formats::read_jpeg, nullptr},
    {".bmp", formats::read_bmp, nullptr},
    {".tga", formats::read_tga, nullptr},
    {".ppm", formats::read_ppm, nullptr},
    {".pgm", formats::read_ppm, nullptr},
});

template <class Can> const Format& format_of(const std::string& path, std::string_view verb, const Can& can) {
  const std::string extension = mc::lowercase_extension(path);
  std::vector<std::string_view> usable;
  for (const Format& f : known_formats) {
    if (!can(f)) continue;
    if (f.extension == extension) return f;
    usable.push_back(f.extension);
  }
  const std::string_view last = usable.back();
  usable.pop_back();
  throw mc::Error(fmt::format("cannot {} '{}': unknown image format '{}'; use {} or {}", verb, path, extension,
                              fmt::join(usable, ", "), last));
}

} // namespace

void write_image(const std::string& path, const Image& image, const ToneMapping& tone) {
  const Format& format = format_of(path, "write", [](const Format& f) { return f.write != nullptr; });
  mc::replace_file(path, [&](std::FILE* stream) { format.write(stream, image, tone); });
}

Image read_image(const std::string& path, const std::optional<Transfer>& transfer) {
  const Format& format = format_of(path, "read", [](const Format& f) { return f.read != nullptr; });
  mc::require(std::filesystem::exists(path), "cannot read '{}': no such file", path);
  return mc::with_context(path, [&] { return format.read(path, transfer); });
}

} // namespace render

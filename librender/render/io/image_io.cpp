#include <render/io/formats.h>
#include <render/io/image_io.h>

#include <mc/core/error.h>
#include <mc/core/file.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace render {

namespace {

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

} // namespace

void write_image(const std::string& path, const Image& image, double exposure) {
  const std::string extension = extension_of(path);
  mc::require(extension == ".exr" || extension == ".pfm" || extension == ".png",
              "cannot write '{}': unknown image format '{}'; use .exr, .pfm or .png", path, extension);
  mc::replace_file(path, [&](const std::string& temporary) {
    mc::with_context(path, [&] {
      if (extension == ".exr") formats::write_exr(temporary, image);
      else if (extension == ".pfm") formats::write_pfm(temporary, image);
      else formats::write_png(temporary, image, exposure);
    });
  });
}

Image read_image(const std::string& path) {
  const std::string extension = extension_of(path);
  mc::require(extension == ".exr" || extension == ".pfm",
              "cannot read '{}': unknown image format '{}'; use .exr or .pfm", path, extension);
  mc::require(std::filesystem::exists(path), "cannot read '{}': no such file", path);
  return mc::with_context(path,
                          [&] { return extension == ".exr" ? formats::read_exr(path) : formats::read_pfm(path); });
}

} // namespace render

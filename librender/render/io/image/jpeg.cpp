#include <render/io/image/formats.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/memory.h>

#include <turbojpeg.h>

#include <memory>
#include <vector>

namespace render::formats {

// Treats warnings of the library, such as data that end early, as errors, because the image would be wrong.
Image read_jpeg(const std::string& path, const std::optional<Transfer>& transfer) {
  const std::string file = mc::read_file(path);
  mc::require(file.starts_with("\xff\xd8"), "not a JPEG file: it does not begin with ff d8");
  const auto* data = reinterpret_cast<const unsigned char*>(file.data());
  const std::unique_ptr<void, int (*)(tjhandle)> decoder(tjInitDecompress(), tjDestroy);
  mc::require(decoder != nullptr, "no memory to read a JPEG");
  const auto require_done = [&](int result) {
    mc::require(result == 0, "broken JPEG: {}", tjGetErrorStr2(decoder.get()));
  };
  int width = 0, height = 0, subsampling = 0, colours = 0;
  require_done(tjDecompressHeader3(decoder.get(), data, file.size(), &width, &height, &subsampling, &colours));
  mc::require(colours != TJCS_CMYK && colours != TJCS_YCCK,
              "the JPEG holds the inks of a printer (CMYK); save it as RGB");
  // A block of 64 pixels takes at least one bit.
  mc::require(double(width) * double(height) <= 64 * 8 * double(file.size()),
              "JPEG says {}x{}, which its {} bytes cannot hold", width, height, file.size());
  mc::require_memory((3.0 + sizeof(Spectrum)) * width * height, fmt::format("{}x{} pixels", width, height));
  std::vector<unsigned char> codes(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  require_done(
      tjDecompress2(decoder.get(), data, file.size(), codes.data(), width, 0, height, TJPF_RGB, TJFLAG_LIMITSCANS));

  const auto linear = transfer.value_or(Transfer()).table();
  Image image(width, height);
  for (std::size_t i = 0; i < codes.size(); ++i) image.pixels[i / 3][static_cast<int>(i % 3)] = linear[codes[i]];
  return image;
}

} // namespace render::formats

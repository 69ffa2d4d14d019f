#include <render/io/image/formats.h>
#include <render/io/image/srgb.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/memory.h>

#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <optional>

namespace render::formats {

namespace {

// libpng reports errors by longjmp. Functions that call setjmp therefore have no locals with destructors; their data
// belong to the callers.
struct Problem {
  char text[128] = "unreadable";
};

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
  auto* problem = static_cast<Problem*>(png_get_error_ptr(png));
  std::snprintf(problem->text, sizeof problem->text, "%s", message);
  png_longjmp(png, 1);
}
void on_warning(png_structp, png_const_charp) {}

class Writer {
 public:
  Writer() : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, &problem_, on_error, on_warning)) {
    mc::require(png_, "no memory to write a PNG");
    info_ = png_create_info_struct(png_);
  }
  ~Writer() { png_destroy_write_struct(&png_, &info_); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  std::string encode(int width, int height, std::vector<png_bytep>& rows, std::vector<png_text>& texts) {
    std::string bytes;
    mc::require(encode_into(bytes, width, height, rows, texts), "cannot encode a {}x{} PNG: {}", width, height,
                problem_.text);
    return bytes;
  }

 private:
  static void append(png_structp png, png_bytep data, png_size_t size) {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), size);
  }

  bool encode_into(std::string& bytes, int width, int height, std::vector<png_bytep>& rows,
                   std::vector<png_text>& texts) {
    if (setjmp(png_jmpbuf(png_))) return false;
    png_set_write_fn(png_, &bytes, append, nullptr);
    png_set_IHDR(png_, info_, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), 8, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(png_, info_, PNG_sRGB_INTENT_PERCEPTUAL);
    png_set_text(png_, info_, texts.data(), static_cast<int>(texts.size()));
    png_write_info(png_, info_);
    png_write_image(png_, rows.data());
    png_write_end(png_, info_);
    return true;
  }

  Problem problem_;
  png_structp png_;
  png_infop info_ = nullptr;
};

class Reader {
 public:
  // Delegates, so that the destructor runs if reading the header throws.
  explicit Reader(const std::string& bytes) : Reader(std::string_view(bytes)) {
    mc::require(read_header(), "broken PNG: {}", problem_.text);
  }
  ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  std::size_t width() const { return png_get_image_width(png_, info_); }
  std::size_t height() const { return png_get_image_height(png_, info_); }
  std::size_t row_bytes() const { return png_get_rowbytes(png_, info_); }
  std::size_t packed_row_bytes() const { return packed_row_bytes_; } ///< size of a row before compression
  bool is_16_bit() const { return png_get_bit_depth(png_, info_) == 16; }

  /// Exponent that converts encoded to linear values, if the file contains one and is not marked as sRGB.
  std::optional<double> gamma() const {
    int intent = 0;
    double encoding = 0;
    if (png_get_sRGB(png_, info_, &intent) != 0 || png_get_gAMA(png_, info_, &encoding) == 0) return {};
    mc::require(encoding > 0, "PNG says a gamma of {}; it must be > 0", encoding);
    return 1 / encoding;
  }

  void read(std::vector<png_bytep>& rows) { mc::require(read_pixels(rows), "broken PNG: {}", problem_.text); }

  std::map<std::string, std::string> texts() const {
    std::map<std::string, std::string> result;
    png_textp texts = nullptr;
    int count = 0;
    png_get_text(png_, info_, &texts, &count);
    for (int i = 0; i < count; ++i) result[texts[i].key] = texts[i].text ? texts[i].text : "";
    return result;
  }

 private:
  explicit Reader(std::string_view bytes)
      : png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &problem_, on_error, on_warning)), rest_(bytes) {
    mc::require(png_, "no memory to read a PNG");
    info_ = png_create_info_struct(png_);
  }

  static void take(png_structp png, png_bytep to, png_size_t size) {
    auto* rest = static_cast<std::string_view*>(png_get_io_ptr(png));
    if (size > rest->size()) png_error(png, "the file ends early");
    std::memcpy(to, rest->data(), size);
    rest->remove_prefix(size);
  }

  // Converts every colour type to RGB of 8 or 16 bits.
  bool read_header() {
    if (setjmp(png_jmpbuf(png_))) return false;
    png_set_read_fn(png_, &rest_, take);
    png_read_info(png_, info_);
    packed_row_bytes_ = png_get_rowbytes(png_, info_);
    png_set_expand(png_);
    png_set_gray_to_rgb(png_);
    png_set_strip_alpha(png_);
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    return true;
  }

  bool read_pixels(std::vector<png_bytep>& rows) {
    if (setjmp(png_jmpbuf(png_))) return false;
    png_read_image(png_, rows.data());
    png_read_end(png_, info_);
    return true;
  }

  Problem problem_;
  png_structp png_;
  png_infop info_ = nullptr;
  std::string_view rest_;
  std::size_t packed_row_bytes_ = 0;
};

std::uint8_t encode(double linear) {
  const double encoded = 255 * linear_to_srgb(linear);
  return std::isfinite(encoded) ? static_cast<std::uint8_t>(std::lround(encoded)) : std::uint8_t{0}; // NaN becomes 0
}

std::vector<png_bytep> rows_of(std::vector<std::uint8_t>& bytes, std::size_t row_bytes, std::size_t height) {
  std::vector<png_bytep> rows;
  for (std::size_t y = 0; y < height; ++y) rows.push_back(bytes.data() + y * row_bytes);
  return rows;
}

png_text text_of(const std::string& key, const std::string& value) {
  png_text text{};
  text.compression = PNG_ITXT_COMPRESSION_NONE; // UTF-8
  text.key = const_cast<png_charp>(key.c_str());
  text.text = const_cast<png_charp>(value.c_str());
  text.itxt_length = value.size();
  return text;
}

} // namespace

void write_png(std::FILE* stream, const Image& image, const ToneMapping& tone) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(image.pixels.size() * 3);
  for (const Spectrum& p : image.pixels)
    for (const double value : tone_map(p, tone)) bytes.push_back(encode(value));
  auto rows = rows_of(bytes, 3 * static_cast<std::size_t>(image.width), static_cast<std::size_t>(image.height));
  std::vector<png_text> texts;
  for (const auto& [key, value] : image.metadata) texts.push_back(text_of(key, value));
  mc::write_bytes(stream, Writer().encode(image.width, image.height, rows, texts));
}

Image read_png(const std::string& path, const std::optional<Transfer>& transfer) {
  const std::string file = mc::read_file(path);
  Reader reader(file);
  const std::size_t row_bytes = reader.row_bytes(), height = reader.height();
  // Deflate expands a byte to at most 1032 bytes.
  mc::require(reader.packed_row_bytes() * height <= 1032 * file.size(),
              "PNG says {}x{}, which its {} bytes cannot hold", reader.width(), height, file.size());
  mc::require_memory(double(height) * (double(row_bytes) + double(sizeof(Spectrum) * reader.width())),
                     fmt::format("{}x{} pixels", reader.width(), height));
  std::vector<std::uint8_t> bytes(row_bytes * height);
  auto rows = rows_of(bytes, row_bytes, height);
  reader.read(rows);

  Image image(static_cast<int>(reader.width()), static_cast<int>(height));
  const std::size_t values = 3 * image.pixels.size();
  const bool wide = reader.is_16_bit();
  const Transfer curve = transfer ? *transfer : Transfer{reader.gamma()};
  const auto narrow = curve.table();
  for (std::size_t i = 0; i < values; ++i)
    image.pixels[i / 3][static_cast<int>(i % 3)] =
        wide ? Float(curve.to_linear((256 * bytes[2 * i] + bytes[2 * i + 1]) / 65535.0)) : narrow[bytes[i]];
  image.metadata = reader.texts();
  return image;
}

} // namespace render::formats

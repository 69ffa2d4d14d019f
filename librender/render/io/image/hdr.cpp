#include <render/io/image/formats.h>
#include <render/io/spectrum.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/memory.h>
#include <mc/core/text.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <vector>

namespace render::formats {

namespace {

// Radiance HDR [Ward91]: header lines, the size, then the pixels row by row. A pixel has three mantissas and a common
// exponent. A row is plain, run-length encoded by pixels (the old way), or run-length encoded by components.

using Rgbe = std::array<std::uint8_t, 4>;

/// The unread rest of the file.
struct Rest {
  std::string_view bytes;

  std::string line() {
    const std::size_t end = bytes.find('\n');
    mc::require(end != std::string_view::npos, "HDR header ends early");
    std::string text(bytes.substr(0, end));
    bytes.remove_prefix(end + 1);
    if (text.ends_with('\r')) text.pop_back();
    return text;
  }
  std::uint8_t byte() {
    mc::require(!bytes.empty(), "HDR data ends early");
    const auto value = static_cast<std::uint8_t>(bytes.front());
    bytes.remove_prefix(1);
    return value;
  }
  Rgbe pixel() {
    Rgbe p;
    for (std::uint8_t& part : p) part = byte();
    return p;
  }
};

/// Colour space and scale of the header: file values times `scale` are radiance.
struct Header {
  bool is_xyz = false;
  Eigen::Array3d scale = Eigen::Array3d::Ones();
};

Header header_of(Rest& rest) {
  mc::require(rest.bytes.starts_with("#?"), "not a Radiance HDR file: it does not start with #?");
  Header header;
  for (std::string line = rest.line(); !line.empty(); line = rest.line()) {
    if (line.starts_with("FORMAT=")) {
      const std::string_view format = mc::trimmed(std::string_view(line).substr(7));
      header.is_xyz = format == "32-bit_rle_xyze";
      mc::require(header.is_xyz || format == "32-bit_rle_rgbe",
                  "HDR header says '{}'; 32-bit_rle_rgbe or 32-bit_rle_xyze is needed", line);
    }
    // Both factors were multiplied into the pixels, and may occur several times.
    Eigen::Array3d by = Eigen::Array3d::Ones();
    if (std::sscanf(line.c_str(), "EXPOSURE=%lf", &by[0]) == 1) by.setConstant(by[0]);
    else if (std::sscanf(line.c_str(), "COLORCORR=%lf %lf %lf", &by[0], &by[1], &by[2]) != 3) continue;
    header.scale /= by;
    mc::require((by > 0).all() && by.isFinite().all() && (header.scale > 0).all() && header.scale.isFinite().all(),
                "HDR header says '{}'; it must be finite and > 0", line);
  }
  return header;
}

/// "-Y 480 +X 640": rows from the top, with pixels from the left. Any order and any signs.
struct Layout {
  int width, height;
  bool in_columns, from_right, from_below;
};

Layout layout_of(const std::string& line) {
  char sign[2], axis[2], rest = 0;
  int n[2];
  const bool is_read =
      std::sscanf(line.c_str(), "%c%c %d %c%c %d %c", &sign[0], &axis[0], &n[0], &sign[1], &axis[1], &n[1], &rest) == 6;
  const bool in_columns = is_read && axis[0] == 'X';
  const int x = in_columns ? 0 : 1, y = 1 - x;
  mc::require(is_read && axis[x] == 'X' && axis[y] == 'Y' && (sign[0] == '+' || sign[0] == '-') &&
                  (sign[1] == '+' || sign[1] == '-') && n[0] > 0 && n[1] > 0,
              "HDR size '{}' must be like -Y 480 +X 640", line);
  return {n[x], n[y], in_columns, sign[x] == '-', sign[y] == '+'};
}

// Reads a line with run-length encoding of each component.
void read_components(Rest& rest, std::vector<Rgbe>& line) {
  for (std::size_t c = 0; c < 4; ++c)
    for (std::size_t i = 0; i < line.size();) {
      const std::size_t code = rest.byte(), count = code > 128 ? code - 128 : code;
      mc::require(count > 0 && count <= line.size() - i, "broken HDR: a run of {} bytes where {} are left", count,
                  line.size() - i);
      const std::uint8_t repeated = code > 128 ? rest.byte() : std::uint8_t{0};
      for (std::size_t k = 0; k < count; ++k) line[i++][c] = code > 128 ? repeated : rest.byte();
    }
}

// Reads a line with run-length encoding of pixels. The pixel 1, 1, 1, n repeats the previous pixel n times. Consecutive
// such pixels are the digits of one count in base 256, lowest digit first.
void read_pixels(Rest& rest, const Rgbe& first, std::vector<Rgbe>& line) {
  int shift = 0;
  Rgbe next = first;
  for (std::size_t i = 0; i < line.size();) {
    if (next[0] == 1 && next[1] == 1 && next[2] == 1) {
      const std::size_t count = shift <= 24 ? std::size_t{next[3]} << shift : line.size();
      mc::require(i > 0 && count <= line.size() - i, "broken HDR: a run of {} pixels where {} are left", count,
                  line.size() - i);
      std::fill_n(&line[i], count, line[i - 1]);
      i += count;
      shift += 8;
    } else {
      line[i++] = next;
      shift = 0;
    }
    if (i < line.size()) next = rest.pixel();
  }
}

void read_line(Rest& rest, std::vector<Rgbe>& line) {
  const Rgbe first = rest.pixel();
  const std::size_t said = 256u * first[2] + first[3];
  if (first[0] == 2 && first[1] == 2 && first[2] < 128 && said == line.size()) read_components(rest, line);
  else read_pixels(rest, first, line);
}

Spectrum radiance(const Rgbe& p, const Header& header) {
  if (p[3] == 0) return Spectrum::Zero();
  Eigen::Array3d c = std::ldexp(1.0, p[3] - 136) * Eigen::Array3d(p[0], p[1], p[2]) * header.scale;
  if (header.is_xyz) c = xyz_to_rgb(c.matrix());
  return c.cast<Float>();
}

} // namespace

Image read_hdr(const std::string& path) {
  const std::string bytes = mc::read_file(path);
  Rest rest{bytes};
  const Header header = header_of(rest);
  const Layout layout = layout_of(rest.line());
  // Run lengths allow any size, but an image from so few bytes would be nearly constant.
  mc::require(double(layout.width) * layout.height <= 4096.0 * double(rest.bytes.size()),
              "HDR says {}x{}, which its {} bytes cannot hold", layout.width, layout.height, bytes.size());
  mc::require_memory(double(sizeof(Spectrum)) * layout.width * layout.height,
                     fmt::format("{}x{} pixels", layout.width, layout.height));
  Image image(layout.width, layout.height);
  const int lines = layout.in_columns ? layout.width : layout.height;
  std::vector<Rgbe> line(static_cast<std::size_t>(layout.in_columns ? layout.height : layout.width));
  for (int j = 0; j < lines; ++j) {
    read_line(rest, line);
    for (std::size_t i = 0; i < line.size(); ++i) {
      const int along = static_cast<int>(i), x = layout.in_columns ? j : along, y = layout.in_columns ? along : j;
      image.at(layout.from_right ? layout.width - 1 - x : x, layout.from_below ? layout.height - 1 - y : y) =
          radiance(line[i], header);
    }
  }
  return image;
}

} // namespace render::formats

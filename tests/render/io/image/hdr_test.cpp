// Radiance HDR images, written here in all encodings of the format.

#include <render/io/image/image_io.h>

#include <mc/random/pcg.h>

#include "support/files.h"

#include <array>

namespace {

using render::Float, render::Image, render::Spectrum;
using Rgbe = std::array<std::uint8_t, 4>;
using Lines = std::vector<std::vector<Rgbe>>;

const std::string head = "#?RADIANCE\n# a comment\nFORMAT=32-bit_rle_rgbe\n\n";

// Long runs and single pixels. No pixel equals a run-length code.
Lines random_lines(mc::Pcg& random, std::size_t lines, std::size_t length) {
  Lines all(lines, std::vector<Rgbe>(length));
  const auto byte = [&](int lo, int hi) {
    return static_cast<std::uint8_t>(lo + static_cast<int>(random.uniform<double>() * (hi - lo)));
  };
  for (auto& line : all)
    for (std::size_t i = 0; i < length;) {
      const Rgbe p = {byte(3, 256), byte(3, 256), byte(0, 256), byte(118, 140)};
      const std::size_t run = random.uniform<double>() < 0.3 ? 1 + static_cast<std::size_t>(byte(0, 255)) * 3 : 1;
      for (std::size_t k = 0; k < run && i < length; ++k) line[i++] = p;
    }
  return all;
}

char code(std::size_t n) { return static_cast<char>(static_cast<std::uint8_t>(n)); }
void append(std::string& to, const Rgbe& p) { to.append(reinterpret_cast<const char*>(p.data()), 4); }

std::string plain(const std::vector<Rgbe>& line) {
  std::string bytes;
  for (const Rgbe& p : line) append(bytes, p);
  return bytes;
}

template <class Same> std::size_t run_at(std::size_t i, std::size_t length, const Same& same) {
  std::size_t n = 1;
  while (i + n < length && same(i, i + n)) ++n;
  return n;
}

std::string counted_pixels(const std::vector<Rgbe>& line) {
  std::string bytes;
  for (std::size_t i = 0; i < line.size();) {
    append(bytes, line[i]);
    const std::size_t more =
        run_at(i, line.size(), [&](std::size_t a, std::size_t b) { return line[a] == line[b]; }) - 1;
    for (std::size_t rest = more; rest > 0; rest /= 256) bytes += std::string("\1\1\1") + code(rest % 256);
    i += 1 + more;
  }
  return bytes;
}

std::string counted_bytes(const std::vector<Rgbe>& line) {
  std::string bytes = std::string("\2\2") + code(line.size() / 256) + code(line.size() % 256);
  for (std::size_t c = 0; c < 4; ++c)
    for (std::size_t i = 0; i < line.size();) {
      const auto same = [&](std::size_t a, std::size_t b) { return line[a][c] == line[b][c]; };
      const std::size_t run = std::min<std::size_t>(run_at(i, line.size(), same), 127);
      if (run > 2) {
        bytes += code(128 + run);
        bytes += static_cast<char>(line[i][c]);
        i += run;
        continue;
      }
      std::size_t n = 1; // until the next run
      while (n < 128 && i + n < line.size() && run_at(i + n, line.size(), same) <= 2) ++n;
      bytes += code(n);
      for (std::size_t k = 0; k < n; ++k) bytes += static_cast<char>(line[i++][c]);
    }
  return bytes;
}

Spectrum value(const Rgbe& p) {
  if (p[3] == 0) return Spectrum::Zero();
  return Spectrum(Float(p[0]), Float(p[1]), Float(p[2])) * Float(std::ldexp(1.0, p[3] - 136));
}

using Encode = std::string (*)(const std::vector<Rgbe>&);
constexpr std::array<Encode, 3> ways = {plain, counted_pixels, counted_bytes};

struct Hdr : support::ScratchTest {
  Image read(const std::string& bytes) const { return render::read_image(write("a.hdr", bytes)); }
  std::string refusal(const std::string& bytes) const {
    const std::string said = support::error_of([&] { read(bytes); });
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    EXPECT_TRUE(said.empty() || said.find("a.hdr: ") != std::string::npos) << said;
    return said;
  }
};

TEST_F(Hdr, EveryEncodingAndOrientation) {
  mc::Pcg random(1);
  for (const Encode encode : ways)
    for (const char* size : {"-Y {0} +X {1}", "-Y {0} -X {1}", "+Y {0} +X {1}", "+Y {0} -X {1}", "+X {0} -Y {1}",
                             "-X {0} -Y {1}", "+X {0} +Y {1}", "-X {0} +Y {1}"}) {
      const std::size_t lines = 3, length = 700;
      const Lines all = random_lines(random, lines, length);
      std::string bytes = head + fmt::format(fmt::runtime(size), lines, length) + "\n";
      for (const auto& line : all) bytes += encode(line);
      const Image image = read(bytes);
      const bool columns = size[1] == 'X';
      ASSERT_EQ(image.width, int(columns ? lines : length)) << size;
      ASSERT_EQ(image.height, int(columns ? length : lines)) << size;
      const char x_sign = columns ? size[0] : size[7], y_sign = columns ? size[7] : size[0];
      for (std::size_t j = 0; j < lines; ++j)
        for (std::size_t i = 0; i < length; ++i) {
          int x = int(columns ? j : i), y = int(columns ? i : j);
          if (x_sign == '-') x = image.width - 1 - x;
          if (y_sign == '+') y = image.height - 1 - y;
          ASSERT_TRUE((image.at(x, y) == value(all[j][i])).all()) << size << " " << j << " " << i;
        }
    }
}

// Rows too short or long for encoding by components are plain, whatever bytes they begin with. Black has no mantissa.
TEST_F(Hdr, ShortRows) {
  const Image image = read("#?RGBE\r\n\r\n-Y 1 +X 2\n" + plain({{2, 2, 0, 130}, {200, 100, 50, 0}}));
  EXPECT_TRUE((image.at(0, 0) == Spectrum(2, 2, 0) * Float(std::ldexp(1.0, -6))).all());
  EXPECT_TRUE(render::is_black(image.at(1, 0)));
}

TEST_F(Hdr, ExposureAndColourCorrectionAreUndone) {
  const std::string pixel = "-Y 1 +X 1\n" + plain({{128, 128, 128, 129}});
  EXPECT_TRUE((read("#?RADIANCE\n\n" + pixel).at(0, 0) == 1).all());
  const Image image = read("#?RADIANCE\nEXPOSURE=2\nEXPOSURE=2\nCOLORCORR= 1 2 0.5\n\n" + pixel);
  EXPECT_TRUE((image.at(0, 0) == Spectrum(Float(0.25), Float(0.125), Float(0.5))).all());
}

// The white of sRGB in XYZ becomes grey. The tolerance is for red, where a step of x has the largest effect: half a
// step of 1/128 times 3.24.
TEST_F(Hdr, Xyz) {
  const Image image = read("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n" + plain({{122, 128, 139, 129}}));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(image.at(0, 0)[c], 1, 0.0127) << c;
}

TEST_F(Hdr, BlanksInTheHeader) {
  const Image image = read("#?RADIANCE\nFORMAT= 32-bit_rle_rgbe \t\n \nEXPOSURE=2 \n\n-Y  1 +X 1 \t\r\n" +
                           plain({{128, 128, 128, 129}}));
  EXPECT_TRUE((image.at(0, 0) == Spectrum(Float(0.5), Float(0.5), Float(0.5))).all());
}

TEST_F(Hdr, TruncatedAtAnyByte) {
  mc::Pcg random(2);
  for (const Encode encode : ways) {
    std::string bytes = head + "-Y 3 +X 40\n";
    for (const auto& line : random_lines(random, 3, 40)) bytes += encode(line);
    ASSERT_EQ(refusal(bytes), "");
    for (std::size_t n = 0; n < bytes.size(); ++n) EXPECT_NE(refusal(bytes.substr(0, n)), "") << n;
  }
}

// With any byte changed, the file is read, or rejected with a one-line error.
TEST_F(Hdr, BrokenAnywhere) {
  mc::Pcg random(3);
  for (const Encode encode : ways) {
    std::string whole = head + "-Y 2 +X 30\n";
    for (const auto& line : random_lines(random, 2, 30)) whole += encode(line);
    for (std::size_t n = 0; n < whole.size(); ++n) {
      std::string bytes = whole;
      bytes[n] = static_cast<char>(random.uniform<double>() * 256);
      refusal(bytes);
    }
  }
}

TEST_F(Hdr, RefusesWithOneLine) {
  const auto with_size = [](const std::string& size) { return "#?RADIANCE\n\n" + size + "\n" + std::string(64, 'x'); };
  EXPECT_THAT(refusal("P6\n"), testing::HasSubstr("not a Radiance HDR file"));
  EXPECT_THAT(refusal("#?RADIANCE\nFORMAT=32-bit_rle_yuv\n\n"), testing::HasSubstr("FORMAT=32-bit_rle_yuv"));
  EXPECT_THAT(refusal("#?RADIANCE\nEXPOSURE=0\n\n"), testing::HasSubstr("'EXPOSURE=0'; it must be finite and > 0"));
  for (const char* size : {"", "-Y 0 +X 4", "-Y 4 +X -4", "-Y 4 +Y 4", "-Y 4", "*Y 4 +X 4", "-Y 4 +X 4 4"})
    EXPECT_THAT(refusal(with_size(size)), testing::HasSubstr("must be like -Y 480 +X 640")) << size;
  EXPECT_THAT(refusal(with_size("-Y 2147483647 +X 2147483647")), testing::HasSubstr("bytes cannot hold"));
  EXPECT_THAT(refusal("#?RADIANCE\n\n-Y 1 +X 9\n\2\2" + std::string("\0\11", 2) + "\212x"),
              testing::HasSubstr("a run of 10 bytes where 9 are left"));
  EXPECT_THAT(refusal("#?RADIANCE\n\n-Y 1 +X 9\nabcd\1\1\1\11"),
              testing::HasSubstr("a run of 9 pixels where 8 are left"));
  EXPECT_THAT(refusal("#?RADIANCE\n\n-Y 1 +X 9\n\1\1\1\3"), testing::HasSubstr("a run of 3 pixels"));
}

} // namespace

#include <mc/run/archive.h>

#include <support/files.h>

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace {

using mc::ArchiveReader, mc::ArchiveWriter;
using testing::HasSubstr;

enum class Color : std::uint8_t { red, green };

struct Point {
  double x = 0, y = 0;
  template <class Archive> void archive(Archive& a) { a(x, y); }
  bool operator==(const Point&) const = default;
};
struct Outside {
  int i = 0;
  bool operator==(const Outside&) const = default;
};
template <class Archive> void archive(Archive& a, Outside& x) { a(x.i); }

struct Everything {
  bool flag = false;
  Color color = Color::red;
  float small = 0;
  std::uint64_t big = 0;
  std::string text;
  std::vector<Point> points;
  std::deque<std::string> words;
  std::vector<Eigen::Array3d> colors;
  std::array<Outside, 2> pair;
  std::optional<Point> none, some;
  std::map<std::string, std::vector<int>> map;
  std::pair<int, std::string> two;

  template <class Archive> void archive(Archive& a) {
    a(flag, color, small, big, text, points, words, colors, pair, none, some, map, two);
  }
};

Everything example() {
  Everything e{true, Color::green, 0.1f, ~0ull,       std::string("a\0b", 3), {{1, 2}, {3, 4}}, {"", "w"}, {}, {},
               {},   {},           {},   {7, "seven"}};
  e.colors = {Eigen::Array3d(1, std::nextafter(2.0, 3.0), -0.0), Eigen::Array3d::Constant(HUGE_VAL)};
  e.pair = {Outside{4}, Outside{5}};
  e.some = Point{std::numeric_limits<double>::denorm_min(), -1};
  e.map = {{"x", {1, 2, 3}}, {"y", {}}};
  return e;
}

std::string bytes_of(const Everything& e) {
  ArchiveWriter writer;
  writer(e);
  return writer.take();
}

TEST(Archive, ReadsWhatItWrote) {
  const std::string bytes = bytes_of(example());
  Everything read;
  read.none = Point{};
  read.map = {{"old", {}}};
  read.points.resize(9);
  ArchiveReader reader(bytes);
  reader(read).require_end();
  EXPECT_EQ(bytes_of(read), bytes);
  EXPECT_EQ(read.text, example().text);
  EXPECT_EQ(read.points, example().points);
  EXPECT_EQ(read.map, example().map);
  EXPECT_FALSE(read.none);
  EXPECT_EQ(read.some, example().some);
  EXPECT_TRUE(std::signbit(read.colors[0][2]));
}

// Whatever number stands at the place of a size: no read beyond the end, and no huge allocation.
TEST(Archive, RefusesEveryCutAndWildSize) {
  const std::string bytes = bytes_of(example());
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    Everything read;
    ArchiveReader reader(std::string_view(bytes).substr(0, n));
    EXPECT_THROW(reader(read), mc::Error) << n;
  }
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string wild = bytes;
    wild[i] = char(0x7f);
    Everything read;
    ArchiveReader reader(wild);
    try {
      reader(read);
    } catch (const mc::Error&) { // may or may not be refused
    }
  }
  Everything read;
  const std::string longer = bytes + "x";
  ArchiveReader reader(longer);
  reader(read);
  EXPECT_THAT(support::error_of([&] { reader.require_end(); }), HasSubstr("1 bytes are left over"));
}

// The byte of a truth value is 0 or 1.
TEST(Archive, WildTruthValue_IsRefused) {
  bool value = false;
  ArchiveReader right("\x01"), wrong("\x7f");
  right(value);
  EXPECT_TRUE(value);
  EXPECT_THAT(support::error_of([&] { wrong(value); }), HasSubstr("127 where a truth value is expected"));
}

TEST(Archive, FixedSize_KeepsTheSize) {
  std::vector<double> sums{1, 2, 3}, two(2), three(3);
  ArchiveWriter writer;
  writer(mc::fixed_size(sums));
  ArchiveReader(writer.text())(mc::fixed_size(three));
  EXPECT_EQ(three, sums);
  EXPECT_THAT(support::error_of([&] { ArchiveReader(writer.text())(mc::fixed_size(two)); }),
              HasSubstr("3 elements where 2 are expected"));
}

} // namespace

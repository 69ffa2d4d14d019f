#include <gallery/label.h>

#include <gtest/gtest.h>

#include <string>

namespace {

std::string drawn(std::string_view text, int left = 0, int top = 0, int width = 30, int height = 20) {
  render::Image image(width, height);
  carlo::draw_label(image, left, top, text);
  std::string rows;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) rows += (image.at(x, y) == 1).all() ? '#' : '.';
    rows += '\n';
  }
  return rows;
}

TEST(Label, DrawsTheGlyphsOfItsFont) {
  EXPECT_EQ(drawn("T-1"), "..............................\n"
                          "..............................\n"
                          "..............................\n"
                          ".########...............##....\n"
                          "....##.................###....\n"
                          "....##................####....\n"
                          "....##...............##.##....\n"
                          "....##..................##....\n"
                          "....##..................##....\n"
                          "....##.....########.....##....\n"
                          "....##..................##....\n"
                          "....##..................##....\n"
                          "....##..................##....\n"
                          "....##..................##....\n"
                          "....##..................##....\n"
                          "....##...............########.\n"
                          "..............................\n"
                          "..............................\n"
                          "..............................\n"
                          "..............................\n");
}

TEST(Label, EveryCharacterIsDifferent) {
  for (char a = '!'; a <= '~'; ++a)
    for (char b = '!'; b < a; ++b) EXPECT_NE(drawn({&a, 1}, 0, 0, 10), drawn({&b, 1}, 0, 0, 10)) << a << b;
}

TEST(Label, CharactersAreTenPixelsWide) {
  EXPECT_EQ(carlo::label_width("mis+lt"), 60);
  EXPECT_EQ(carlo::label_width(""), 0);
  EXPECT_EQ(drawn(" a", 0, 0, 20), drawn("a", 10, 0, 20));
  EXPECT_EQ(drawn("a", 3, 2), drawn("a\n\xc3\xa4", 3, 2)) << "no glyphs for what is not printable ASCII";
}

TEST(Label, PartsOutsideOfThePictureAreLeftOut) {
  EXPECT_NE(drawn("W", -4, -5), drawn(""));
  EXPECT_EQ(drawn("W", -40, 0), drawn(""));
  EXPECT_EQ(drawn("W", 0, 100), drawn(""));
}

} // namespace

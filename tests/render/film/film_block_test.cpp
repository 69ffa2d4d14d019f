#include <render/film/film_block.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace render;

/// The same samples, given to a film or to a block.
template <class Target> void fill(Target& target, bool splats) {
  const Eigen::Array3d red(1, 0.25, 0), blue(0, 0.5, 3);
  SampleSums samples;
  samples.add(red);
  samples.add(blue);
  target.add(0, 1, 0, red, 1);
  target.add(0, 1, 1, blue, 1);
  target.add(2, 0, 1, blue, 3);
  target.record_samples(0, 1, samples, 7);
  if (splats) target.add_splat(1, 1, 0, Eigen::Array4d(1, 2, 3, 0.5));
}

TEST(FilmBlock, AddsTheSamplesOfAFilm) {
  for (const bool splats : {false, true}) {
    FilmOptions options{.has_light_paths = true};
    if (splats) options.splat.emplace(Filter(GaussianFilter()));
    Film film(3, 2, 2, options), from_block(3, 2, 2, options);
    FilmBlock block(3, 2, 2);
    fill(film, splats);
    fill(block, splats);
    film.add_light_splat(2, 1, 0, Spectrum(1, 2, 3).cast<double>());
    film.add_light_rays(9);
    block.add_light_splat(2, 1, 0, Spectrum(1, 2, 3));
    block.add_light_rays(9);
    mc::ArchiveWriter bytes, expected, found;
    bytes(block);
    FilmBlock read;
    mc::ArchiveReader reader(bytes.text());
    reader(read).require_end();
    from_block.add(read);
    expected(film);
    found(from_block);
    EXPECT_EQ(found.text(), expected.text());
    mc::ArchiveWriter empty;
    empty(Film(3, 2, 2, options));
    EXPECT_NE(found.text(), empty.text());
  }
}

// Rows that take turns in a window end in the film as if they had been added to it.
TEST(FilmBlock, RowsOfAWindow) {
  const FilmOptions options{.splat = SplatFilter(Filter(GaussianFilter()))};
  Film direct(2, 7, 2, options), film(2, 7, 2, options), window(2, 3, 2, options);
  for (int y = 0; y < 9; ++y) { // the rows y - 2, y - 1 and y of the film, of which the first one is complete
    FilmBlock block(2, 7, 2);
    for (int row = std::max(y - 2, 0); row <= std::min(y, 6); ++row) {
      block.add_splat(1, row, 0, Eigen::Array4d(y, 2 * y, row, 1));
      block.add(1, row, 0, Eigen::Array3d::Zero(), 0.5);
    }
    direct.add(block);
    film.add(block, &window);
    if (y >= 2) film.take_row(window, y - 2);
  }
  mc::ArchiveWriter expected, found, rest, nothing;
  expected(direct);
  found(film);
  EXPECT_EQ(found.text(), expected.text());
  rest(window);
  nothing(Film(2, 3, 2, options));
  EXPECT_EQ(rest.text(), nothing.text());
}

TEST(FilmBlock, ContainsThePixelsOfItsFilm) {
  const FilmBlock block(3, 2, 4);
  EXPECT_EQ(block.sets(), 4);
  EXPECT_TRUE(block.contains(0, 0) && block.contains(2, 1));
  EXPECT_FALSE(block.contains(3, 0) || block.contains(0, 2) || block.contains(-1, 0) || block.contains(0, -1));
}

// The archive has the same values without padding.
TEST(FilmBlock, MemoryOfAPixel_IsAsStated) {
  for (const int splats : {0, 9, 81}) {
    constexpr int pixels = 1000;
    FilmBlock block(pixels, 1, 2);
    for (int x = 0; x < pixels; ++x) {
      for (int set = 0; set < 2; ++set) {
        block.add(x, 0, set, Eigen::Array3d::Ones(), 1);
        for (int k = 0; k < splats; ++k) block.add_splat(x, 0, set, Eigen::Array4d::Ones());
      }
      block.record_samples(x, 0, {}, 1);
    }
    mc::ArchiveWriter bytes;
    bytes(block);
    const double stated = pixels * FilmBlock::bytes_per_pixel(2, splats);
    EXPECT_LE(double(bytes.text().size()), stated) << splats;
    EXPECT_GE(double(bytes.text().size()), 0.85 * stated) << splats;
  }
}

} // namespace

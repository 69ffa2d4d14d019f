#include <render/film/film_block.h>

#include <gtest/gtest.h>

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

TEST(FilmBlock, ContainsThePixelsOfItsFilm) {
  const FilmBlock block(3, 2, 4);
  EXPECT_EQ(block.sets(), 4);
  EXPECT_TRUE(block.contains(0, 0) && block.contains(2, 1));
  EXPECT_FALSE(block.contains(3, 0) || block.contains(0, 2) || block.contains(-1, 0) || block.contains(0, -1));
}

} // namespace

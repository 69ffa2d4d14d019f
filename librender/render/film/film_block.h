#pragma once
/// Samples of a unit of work, before they enter a film.

#include <render/film/film.h>

#include <vector>

namespace render {

/// Samples for a film that does not change yet: threads fill blocks, and Film::add(block) adds each in the order of its
/// calls. The functions are those of Film.
class FilmBlock {
 public:
  FilmBlock() = default;
  /// An empty block for a film of this size and number of point sets.
  FilmBlock(int width, int height, int sets) : width_(width), height_(height), sets_(sets) {}

  /// Memory of a block with the samples of one pixel, each set of which has this number of splats [bytes].
  static double bytes_per_pixel(int sets, int splats) {
    return sets * (double(sizeof(SetSum)) + splats * double(sizeof(Splat))) + double(sizeof(Record));
  }

  /// Number of point sets of each pixel.
  int sets() const { return sets_; }
  /// Whether the film contains the pixel (x, y).
  bool contains(int x, int y) const { return x >= 0 && x < width_ && y >= 0 && y < height_; }

  /// As Film::add().
  void add(int x, int y, int set, const Eigen::Array3d& sum, double count) { sums_.push_back({x, y, set, count, sum}); }
  /// As Film::add_splat().
  void add_splat(int x, int y, int set, const Eigen::Array4d& sum) { splats_.push_back({x, y, set, sum}); }
  /// As Film::add_light_splat().
  void add_light_splat(int x, int y, int set, const Spectrum& value) { light_splats_.push_back({x, y, set, value}); }
  /// As Film::add_unseen_light().
  void add_unseen_light(const Spectrum& value) { unseen_light_.add(value); }
  /// As Film::add_light_rays().
  void add_light_rays(std::uint64_t rays) { light_rays_ += rays; }
  /// As Film::record_samples().
  void record_samples(int x, int y, const SampleSums& samples, std::uint64_t rays) {
    records_.push_back({x, y, samples, rays});
  }

  /// The samples, see mc/run/archive.h.
  template <class Archive> void archive(Archive& a) {
    a(width_, height_, sets_, sums_, splats_, light_splats_, records_, unseen_light_, light_rays_);
  }

 private:
  friend class Film;

  struct SetSum {
    int x, y, set;
    double count;
    Eigen::Array3d sum;
    template <class Archive> void archive(Archive& a) { a(x, y, set, count, sum); }
  };
  struct Splat {
    int x, y, set;
    Eigen::Array<double, 4, 1, Eigen::DontAlign> sum; // smaller than an Array4d
    template <class Archive> void archive(Archive& a) { a(x, y, set, sum); }
  };
  struct LightSplat {
    int x, y, set;
    Spectrum value;
    template <class Archive> void archive(Archive& a) { a(x, y, set, value); }
  };
  struct Record {
    int x, y;
    SampleSums samples;
    std::uint64_t rays;
    template <class Archive> void archive(Archive& a) { a(x, y, samples, rays); }
  };

  int width_ = 0, height_ = 0, sets_ = 0;
  std::vector<SetSum> sums_;
  std::vector<Splat> splats_;
  std::vector<LightSplat> light_splats_;
  std::vector<Record> records_;
  UnseenLight unseen_light_;
  std::uint64_t light_rays_ = 0;
};

} // namespace render

#pragma once
/// Samples of tiles of pixels.

#include <render/film/sampling_plan.h>
#include <render/integrator/tile.h>
#include <render/pixel_sampler.h>

namespace render {

/// The samples of a picture's pixels, by PixelPoints, taken by tiles: those of all its pixels together, see
/// TileIntegrator. Tiles lie where they do in the whole picture, and the pixels of a part are those of the whole.
class TileTaker {
 public:
  /// light_paths : see PathIntegrator
  ///   throws    : Error where something else than radiance is to be shown
  TileTaker(const Scene& scene, const PathOptions& path, const PixelPoints& points, const Whole& whole,
            const LightPaths* light_paths = nullptr);

  /// Whether tiles begin at the film's row y; those that begin above it do at its first.
  bool begins(int y) const { return y == 0 || (whole_.part.y + y) % side == 0; }

  /// Where the film's pixels lie in their tiles.
  Tiling tiling() const { return {side, whole_.part.x % side, whole_.part.y % side}; }

  /// Adds to the film the samples [from[x], to[x]) of all pixels of the tiles that begin at its row y, of each of which
  /// x is the first column; what is not finite is left out.
  Tally take(int y, std::span<const std::uint32_t> from, std::span<const std::uint32_t> to, Film& film) const {
    return (this->*take_)(y, from, to, film);
  }

 private:
  static constexpr int side = TileIntegrator<Scene>::side;
  static constexpr std::size_t pixels = TileIntegrator<Scene>::pixels;

  /// Of a tile.
  struct Pixel {
    int x, y;    ///< in the whole picture
    bool counts; ///< it is one of the film's
    SampleSums seen = {};
    Eigen::Array3d sum = Eigen::Array3d::Zero(); ///< of the set under way
    std::uint32_t valid = 0;                     ///< samples of it
  };

  using Take = Tally (TileTaker::*)(int, std::span<const std::uint32_t>, std::span<const std::uint32_t>, Film&) const;
  template <class Stream>
  Tally take_by(int y, std::span<const std::uint32_t> from, std::span<const std::uint32_t> to, Film& film) const;
  template <class Stream>
  void take_tile(int left, int top, std::uint32_t from, std::uint32_t to, Film& film, Tally& tally) const;
  template <class Stream>
  void take_run(const PixelPoints::Run& run, std::array<Pixel, pixels>& tile, Tally& tally) const;
  static Take take_of(PixelSampler sampler);

  const Scene& scene_;
  PixelRays pixel_rays_;
  TileIntegrator<Scene> integrator_;
  PixelPoints points_;
  Whole whole_;
  Take take_;
};

} // namespace render

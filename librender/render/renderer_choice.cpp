#include <render/renderer_choice.h>

#include <algorithm>
#include <cmath>

namespace render {

namespace {

// Width and height of the blocks that alternate [pixels]; a multiple of the side of a tile. Small, so that all
// renderers get a fair share of the picture.
constexpr int block_side = 4;

} // namespace

RendererChoice::RendererChoice(const Scene& scene, const RenderOptions& options, const PixelPoints& points,
                               const ImageExtent& extent, const std::optional<SplatFilter>& splat,
                               const LightTracer* light_tracer)
    : extent_(extent) {
  const bool is_open = options.adaptive && options.aov.kind == Aov::radiance && !options.branches;
  const RayCone cone = RayCone::of_pixel(scene.camera(), extent.width, extent.height);
  const auto path = [&](int branches) { return PathOptions{options.strategy, options.max_depth, branches, cone}; };
  const auto add = [&](int branches) {
    renderers_.emplace_back(std::in_place_type<PixelRenderer>, scene, path(branches), points, extent, splat,
                            light_tracer, options.aov);
  };
  if (!options.tiles.value_or(false)) {
    add(options.branches.value_or(2));
    if (is_open) add(1);
  }
  if (options.tiles.value_or(is_open && !scene.has_volumes()))
    renderers_.emplace_back(std::in_place_type<TileRenderer>, scene, path(1), points, extent, splat, light_tracer);
  if (renderers_.size() == 1) chosen_ = 0;
}

std::size_t RendererChoice::in_turn(int x, int y) const {
  constexpr int shift = block_side * (static_cast<int>(SplatFilter::max_radius) + 1); // keeps the border positive
  const int blocks = (x + extent_.crop.x + shift) / block_side + (y + extent_.crop.y + shift) / block_side;
  return static_cast<std::size_t>(blocks) % renderers_.size();
}

RenderStats RendererChoice::render_row(int y, int column, std::span<const std::uint32_t> from,
                                       std::span<const std::uint32_t> to, FilmBlock& block,
                                       std::optional<double> weight, bool alternates) const {
  const auto of_pixel = [&](std::size_t i) {
    return chosen_ || !alternates ? chosen_.value_or(0) : in_turn(column + static_cast<int>(i), y);
  };
  RenderStats stats;
  for (std::size_t begin = 0, end = 0; begin < from.size(); begin = end) {
    const std::size_t own = of_pixel(begin);
    while (end < from.size() && of_pixel(end) == own) ++end;
    stats.merge(std::visit(
        [&](const auto& renderer) {
          return renderer.render_row(y, column + static_cast<int>(begin), from.subspan(begin, end - begin),
                                     to.subspan(begin, end - begin), block, weight);
        },
        renderers_[own]));
  }
  return stats;
}

void RendererChoice::choose(const Film& pilot) {
  if (chosen_) return;
  double mean = 0;
  for (int y = 0; y < pilot.height(); ++y)
    for (int x = 0; x < pilot.width(); ++x) mean += pilot.estimate(x, y).mean.mean();
  mean /= double(pilot.width()) * pilot.height();
  struct Part {
    double errors = 0, rays = 0, pixels = 0;
    double cost() const { return pixels > 0 ? mc::sqr(errors / pixels) * rays / pixels : mc::infinity<double>; }
  };
  std::vector<Part> parts(renderers_.size());
  for (int y = 0; y < pilot.height(); ++y)
    for (int x = 0; x < pilot.width(); ++x) {
      const PixelEstimate pixel = pilot.estimate(x, y);
      Part& own = parts[in_turn(x, y)];
      const Eigen::Array3d unit = pixel.mean.square() + mc::sqr(mean / 2);
      if (mean > 0) own.errors += std::sqrt(((pixel.variance - pixel.light_variance).max(0) / unit).mean());
      own.rays += double(pilot.rays(x, y));
      ++own.pixels;
    }
  const auto least =
      std::min_element(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.cost() < b.cost(); });
  chosen_ = static_cast<std::size_t>(least - parts.begin());
}

double RendererChoice::noise_area(double alternating) const {
  constexpr double of_tiles = PathReuseIntegrator<Scene>::noise_area;
  if (any_tiling().side == 1) return 1;
  if (chosen_ == renderers_.size() - 1) return of_tiles;
  return 1 + (of_tiles - 1) * alternating / double(renderers_.size());
}

} // namespace render

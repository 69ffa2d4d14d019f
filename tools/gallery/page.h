#pragma once
/// The rendered gallery as one HTML page.

#include <gallery/comparison.h>
#include <gallery/features.h>

#include <string>
#include <vector>

namespace carlo {

/// A scene of the gallery and the statistics of its render.
struct RenderedScene {
  const GalleryScene* scene = nullptr;
  int width = 0, height = 0;
  double spp = 0, seconds = 0, samples_per_second = 0;
  double relative_error = 0, outlier_dominated = 0; ///< see RenderResult
  std::string strategy, sampler;
  std::vector<Feature> features;
  std::vector<StrategyResult> strategies; ///< empty if they were not compared

  /// The fields, see mc/run/archive.h.
  template <class Archive> void archive(Archive& a) {
    std::string name(scene ? scene->name : std::string_view());
    a(name, width, height, spp, seconds, samples_per_second, relative_error, outlier_dominated, strategy, sampler,
      features, strategies);
    if constexpr (Archive::is_reader) scene = &gallery_scene(name);
  }
};

/// HTML that shows NAME.png of every scene, from the folder of the page. It needs no script and no network.
///   requested : number of requested scenes; an interrupted run renders fewer.
std::string gallery_page(const std::vector<RenderedScene>& rendered, std::size_t requested, const std::string& command);

} // namespace carlo

#pragma once
/// The tables of plugins, one for each kind. A new plugin is a row with its function in the kind's .cpp.

#include <render/io/mitsuba/plugin.h>

namespace render::mitsuba {

/// A shape with what covers it.
struct ShapeDescription {
  Shape shape;
  std::optional<BsdfId> bsdf;
  std::optional<Emission> emission;
  bool importance_target;
  std::optional<HomogeneousMedium> interior;
  std::string missing_uv_reason; ///< why a mesh has no texture coordinates
};

struct FilmSettings {
  int width, height;
  Filter filter;
};

struct IntegratorSettings {
  int max_depth = -1; ///< longest path in edges, -1 for no limit
  Aov aov = Aov::radiance;
};

struct SensorSettings {
  ThinLens camera;
  FilmSettings film;
  int spp;
};

const Plugins<IntegratorSettings>& integrator_plugins();
const Plugins<SensorSettings>& sensor_plugins();
const Plugins<FilmSettings>& film_plugins();
const Plugins<Filter>& filter_plugins();
const Plugins<int>& sampler_plugins(); ///< samples per pixel
const Plugins<Material>& bsdf_plugins();
const Plugins<Texture>& texture_plugins();
const Plugins<ShapeDescription>& shape_plugins();
const Plugins<Emission>& surface_emitter_plugins(); ///< inside a shape
const Plugins<HomogeneousMedium>& medium_plugins(); ///< inside a shape
const Plugins<Light>& emitter_plugins();            ///< of the scene

/// Every kind with its rows, in the order of the reference.
struct Kind {
  std::string tag, meaning;
  std::vector<PluginText> rows;
};
std::vector<Kind> all_plugins();

} // namespace render::mitsuba

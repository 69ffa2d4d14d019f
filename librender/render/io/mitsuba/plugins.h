#pragma once
/// The tables of plugins, one per kind. A new plugin is a row with its function in the .cpp file of its kind.

#include <render/io/mitsuba/plugin.h>

namespace render::mitsuba {

/// A medium, and the element that describes it.
struct NamedMedium {
  HomogeneousMedium medium;  ///< The medium.
  const XmlElement* element; ///< Its element: media of one element are the same medium.
};

/// A shape with its material, emission and media.
struct ShapeDescription {
  Shape shape;                         ///< The geometry.
  std::optional<BsdfId> bsdf;          ///< Its BSDF; nullopt: the default.
  std::optional<Emission> emission;    ///< Its emission, if it is a light.
  bool importance_target;              ///< Whether guiding strategies also sample directions to the shape.
  std::optional<NamedMedium> interior; ///< The medium inside, if there is one.
  std::optional<NamedMedium> exterior; ///< The medium around it, if the file names one.
  std::string missing_uv_reason;       ///< Why a mesh has no texture coordinates.
};

/// Parameters of a film.
struct FilmSettings {
  int width, height; ///< Size [pixels].
  Filter filter;     ///< Reconstruction filter.
};

/// Parameters of an integrator.
struct IntegratorSettings {
  int max_depth = -1;      ///< Longest path in edges; -1: no limit.
  Aov aov = Aov::radiance; ///< Output of the integrator.
};

/// Parameters of a sensor.
struct SensorSettings {
  ThinLens camera;                        ///< The camera.
  FilmSettings film;                      ///< Its film.
  int spp;                                ///< Samples per pixel.
  std::optional<NamedMedium> medium = {}; ///< The medium around the camera, if there is one.
};

const Plugins<IntegratorSettings>& integrator_plugins(); ///< Rows of <integrator>.
const Plugins<SensorSettings>& sensor_plugins();         ///< Rows of <sensor>.
const Plugins<FilmSettings>& film_plugins();             ///< Rows of <film>.
const Plugins<Filter>& filter_plugins();                 ///< Rows of <rfilter>.
const Plugins<int>& sampler_plugins();            ///< Rows of <sampler>; the value is the number of samples per pixel.
const Plugins<Material>& bsdf_plugins();          ///< Rows of <bsdf>.
const Plugins<Texture>& texture_plugins();        ///< Rows of <texture>.
const Plugins<ShapeDescription>& shape_plugins(); ///< Rows of <shape>.
const Plugins<Emission>& surface_emitter_plugins(); ///< Rows of <emitter> inside a shape.
const Plugins<HomogeneousMedium>& medium_plugins(); ///< Rows of <medium>.
const Plugins<PhaseFunction>& phase_plugins();      ///< Rows of <phase> inside a medium.
/// The medium that a <medium> describes or a <ref> references.
NamedMedium read_medium(const XmlElement& e, Context& context);
const Plugins<Light>& emitter_plugins(); ///< Rows of <emitter> in the scene.

/// One kind of plugin with its rows.
struct Kind {
  std::string tag, meaning;     ///< Tag of the kind, and its description.
  std::vector<PluginText> rows; ///< Its plugins.
};
/// All kinds in the order of the reference.
std::vector<Kind> all_plugins();

} // namespace render::mitsuba

#pragma once
/// Scenes in Mitsuba's XML format, versions 0.4 to 0.6.

#include <render/scene/scene.h>

#include <string>

namespace render {

/// How a scene file asks to be rendered.
struct RenderDefaults {
  int width = 256, height = 256;
  int spp = 64;
  int max_depth = -1; ///< longest path in edges; -1: no limit
};

struct SceneFile {
  Scene scene;
  RenderDefaults defaults;
};

/// Reads a scene file with its meshes.
///   integrator : path (maxDepth)
///   sensor     : perspective, thinlens (fov, fovAxis, toWorld, nearClip, apertureRadius, focusDistance), sampler
///                (sampleCount), film (width, height) with rfilter box, tent (radius), gaussian (stddev), subpixeltent
///                (n, radius)
///   bsdf       : diffuse, conductor (a mirror: specularReflectance), fuzzymetal (albedo, fuzz), dielectric (intIOR,
///                extIOR), twosided (all of ours are); inline, or by id and <ref>
///   shape      : obj (filename), rectangle, cube, sphere (center, radius, flipNormals, capAxis, capHeight); toWorld,
///                an area emitter (radiance, twoSided); guide: the mixture strategy also aims at it
///   emitter    : constant (radiance), gradient (bottom, top)
///   Ours, not Mitsuba's: fuzzymetal, subpixeltent, gradient, twoSided, guide, capAxis, capHeight.
///   Accepted without effect, since they cannot change the picture: the sampler's type, farClip, rrDepth,
///   strictNormals, and the film's file format.
///   throws : Error "scene.xml:14: ..." for broken XML, an unknown plugin (naming the nearest), a parameter that is not
///            supported or cannot be read, a missing or broken mesh, an emitting shape without area, an empty scene
SceneFile read_mitsuba(const std::string& path);

} // namespace render

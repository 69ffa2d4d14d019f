#pragma once
/// Small scenes made by machine, each with a ray and what that must bring, by a closed form or by another scene that
/// must look the same.

#include <render/scene/scene.h>

#include <mc/random/pcg.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace render::truth {

/// One radiance.
struct Picture {
  std::shared_ptr<const Scene> scene;
  Ray ray;
  int max_depth = -1;
  std::string variant; ///< how it differs from the first of its family
};

/// Pictures that all show the same radiance.
struct Family {
  std::string kind;
  std::vector<Picture> pictures;
  std::optional<double> truth; ///< where there is a closed form
  double rounding = 1e-4;      ///< relative: as much may rounding to Float do
  double rarest = 1;           ///< how often a direction of the cosine hemisphere meets the smallest light, about
};

/// Everything sends out 1: Lambertian things of albedo a emit 1 - a, the others reflect or refract all. In a closed
/// sphere or cube, or under a sky of 1. The truth is 1.
Family furnace(mc::Pcg& random);

/// A white Lambertian floor lit by one to forty spheres and rectangles of any size and distance, none in front of
/// another, perhaps under a sky. A sphere of half angle a towards direction w gives L sin^2 a cos w, a polygon what
/// Lambert's formula says.
Family direct_light(mc::Pcg& random);

/// A closed room with things of all kinds in it, and the same turned, mirrored, scaled, moved, with its walls cut into
/// many triangles.
Family room(mc::Pcg& random);

/// Any of the three.
Family any(mc::Pcg& random);

} // namespace render::truth

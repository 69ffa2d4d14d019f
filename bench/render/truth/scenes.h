#pragma once
/// Small random scenes, each with a ray and its expected radiance. The expectation is a closed form, or another scene
/// that must give the same radiance.

#include <render/scene/scene.h>

#include <mc/random/pcg.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace render::truth {

/// A scene and a ray; its radiance is a single number.
struct Picture {
  std::shared_ptr<const Scene> scene;
  Ray ray;
  int max_depth = -1;
  std::string variant; ///< Difference from the first picture of the family.
};

/// Pictures with the same radiance.
struct Family {
  std::string kind;
  std::vector<Picture> pictures;
  std::optional<double> truth; ///< Closed form, if there is one.
  double rounding = 1e-4;      ///< Relative bound of the rounding to Float.
  /// Approximate probability that a direction of the cosine hemisphere hits the smallest light.
  double rarest = 1;
};

/// A furnace test: all radiance is 1. Lambertian objects of albedo a emit 1 - a; the others reflect or refract without
/// loss. The scene is a closed sphere or cube, or lies under a sky of radiance 1. The truth is 1.
Family furnace(mc::Pcg& random);

/// A white Lambertian floor lit by one to forty spheres and rectangles of any size and distance, optionally under a
/// sky. No light occludes another. A sphere of half angle a in direction w contributes L sin^2 a cos w, a polygon
/// follows Lambert's formula.
Family direct_light(mc::Pcg& random);

/// A closed room with objects of all kinds. The other pictures show the same room rotated, mirrored, scaled,
/// translated, or with walls split into many triangles.
Family room(mc::Pcg& random);

/// A family of one of the three kinds.
Family any(mc::Pcg& random);

} // namespace render::truth

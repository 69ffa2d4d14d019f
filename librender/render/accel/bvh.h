#pragma once
/// Ray queries against all shapes of a scene.

#include <render/core/bounds.h>
#include <render/core/ray.h>
#include <render/shape/shape.h>

#include <memory>
#include <optional>
#include <span>

namespace render {

/// Nearest and any hit of single rays, with one tree per kind of primitive (see trees.h). Immutable after construction,
/// so threads may share it. It copies the geometry it needs: the shapes need not outlive it.
class Bvh {
 public:
  /// A Bvh without shapes, which no ray hits.
  Bvh();
  /// Builds the trees. Hit::shape is an index into `shapes`.
  explicit Bvh(std::span<const Shape* const> shapes);
  /// Builds the trees. Hit::shape is an index into `shapes`.
  explicit Bvh(std::span<const Shape> shapes);

  /// The nearest hit with 0 < t < t_max, if there is one.
  std::optional<Hit> intersect(const Ray& ray) const;
  /// Whether there is a hit with 0 < t < t_max.
  bool occluded(const Ray& ray) const;
  /// Bounds of all shapes; empty for an empty scene.
  const Bounds& bounds() const { return bounds_; }

  struct Trees;
  struct Trace;

 private:
  std::shared_ptr<const Trees> trees_;
  Bounds bounds_;
};

} // namespace render

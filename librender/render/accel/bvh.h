#pragma once
/// Ray queries against all shapes of a scene.

#include <render/core/bounds.h>
#include <render/core/ray.h>
#include <render/shape/shape.h>

#include <memory>
#include <optional>
#include <span>

namespace render {

/// Nearest and any hit of single rays: one tree for each kind of leaf (trees.h lists them). Immutable after
/// construction, so threads share it. It copies what it needs: the shapes need not outlive it.
class Bvh {
 public:
  Bvh();
  explicit Bvh(std::span<const Shape* const> shapes);
  explicit Bvh(std::span<const Shape> shapes);

  std::optional<Hit> intersect(const Ray& ray) const;
  bool occluded(const Ray& ray) const;
  /// Of everything; empty for an empty scene.
  const Bounds& bounds() const { return bounds_; }

  struct Trees;
  struct Trace;

 private:
  std::shared_ptr<const Trees> trees_;
  Bounds bounds_;
};

} // namespace render

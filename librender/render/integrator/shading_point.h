#pragma once
/// Scattering at path vertices.

#include <render/scene/scene.h>

#include <mc/core/frame.h>

#include <array>
#include <optional>

namespace render {

/// Local frame of a surface point that is seen from a direction, with the shading normal as z.
///   Bent normals : a coarse mesh with smooth normals shows triangles whose shading normal faces away. Such a normal is
///                  bent until the viewer is just above the horizon of the shading normal, or just below it for a
///                  viewer behind the surface: on the same side as of the geometric normal.
class ShadingFrame {
 public:
  /// Smallest cosine of viewer and shading normal, on the side of the viewer.
  static constexpr Float least_cosine = Float(1e-3);

  /// Frame at a point seen from the unit direction wo, in world space.
  ShadingFrame(const SurfacePoint& point, const Vec3& wo) : is_flat_(point.ns == point.ng) {
    if (is_flat_) [[likely]] {
      frame_ = mc::Frame<Float>::from_z(point.ns);
      return;
    }
    is_bent_ = faces_away(point, wo);
    const Float side = wo.dot(point.ng) < 0 ? Float(-1) : Float(1);
    frame_ = mc::Frame<Float>::from_z(
        is_bent_ ? Vec3((point.ns + (side * least_cosine - wo.dot(point.ns)) * wo).normalized()) : point.ns);
    ng_ = frame_.to_local(point.ng);
  }

  /// Whether the shading normal is bent for a viewer in the direction wo.
  static bool faces_away(const SurfacePoint& point, const Vec3& wo) {
    const Float cosine = wo.dot(point.ns);
    return point.ns != point.ng && (wo.dot(point.ng) < 0 ? -cosine : cosine) < least_cosine;
  }

  /// Local coordinates of a vector.
  Vec3 to_local(const Vec3& d) const { return frame_.to_local(d); }
  /// World coordinates of a vector.
  Vec3 to_world(const Vec3& w) const { return frame_.to_world(w); }

  /// Whether both normals are equal, as on all shapes but smooth meshes.
  bool is_flat() const { return is_flat_; }
  /// Whether the shading normal is bent.
  bool is_bent() const { return is_bent_; }
  /// Whether two local directions are on the same side of the surface.
  bool same_side(const Vec3& a, const Vec3& b) const {
    return is_flat_ ? a.z() * b.z() > 0 : (a.dot(ng_) > 0) == (b.dot(ng_) > 0);
  }
  /// Mirror image of a local direction at the surface.
  Vec3 mirror(const Vec3& w) const { return w - 2 * w.dot(ng_) * ng_; }

 private:
  mc::Frame<Float> frame_;
  Vec3 ng_ = Vec3::UnitZ(); ///< Geometric normal, local
  bool is_flat_, is_bent_ = false;
};

/// A sampled direction of a ShadingPoint; see BsdfSample.
struct ShadingSample {
  Vec3 wi;        ///< Direction in the local frame.
  Spectrum f_cos; ///< BSDF times |cos|.
  Float pdf;      ///< Density [1/sr], or the probability of a delta lobe.
  bool delta;     ///< Whether a delta lobe was sampled.
  Float eta;      ///< Index ratio.
  /// Whether a delta or near-specular lobe scatters from wi to wo, too: neither of them bends the normal, and wi is not
  /// mirrored.
  bool reversible;
};

/// A path vertex with a BSDF of type B. Directions are in the frame.
///   Shading normals : reflection that a BSDF directs below the surface, and transmission that it directs above it, is
///                     mirrored at the geometric normal. For each wo the surface then has the albedo of its BSDF, and
///                     an opaque one passes no light: f_cos is the sum over the directions that end in wi, and so is
///                     the density. Reciprocity is lost, as with all shading normals [Veach97, section 5.3]. See
///                     docs/methods/path-tracing.md.
template <class B> struct ShadingPoint {
  /// BSDF at the vertex.
  const B& bsdf;
  /// Position and normals.
  const SurfacePoint& point;
  /// Local frame.
  ShadingFrame frame;
  Vec3 wo; ///< Direction toward the previous vertex, in the frame.

  /// A vertex seen from the unit direction d in world space.
  ShadingPoint(const B& b, const SurfacePoint& p, const Vec3& d) : bsdf(b), point(p), frame(p, d) {
    wo = frame.to_local(d);
  }
  struct Reverse;
  /// The vertex for a path that arrives from wi and goes on to wo.
  Reverse reverse(const Vec3& wi) const;

  /// BSDF times |cos wi|, delta lobes excluded.
  Spectrum f_cos(const Vec3& wi) const {
    return frame.is_flat() ? Spectrum(bsdf.eval(wo, wi) * std::abs(wi.z())) : mirrored_f_cos(wi);
  }
  /// Density of wi [1/sr], delta lobes excluded.
  Float pdf(const Vec3& wi) const { return frame.is_flat() ? bsdf.pdf(wo, wi) : mirrored_pdf(wi); }
  /// Density [1/sr] of wo for a path that arrives from wi; see reverse().
  Float reverse_pdf(const Vec3& wi) const { return frame.is_flat() ? bsdf.pdf(wi, wo) : mirrored_reverse_pdf(wi); }
  /// Index of refraction on the side of wi over the index on the side of wo, delta lobes excluded.
  Float eta(const Vec3& wi) const {
    Float ratio = 1;
    for (const Vec3& w : origins(wi)) ratio = bsdf.eta(wo, w);
    return ratio;
  }
  /// Samples a direction; see BsdfLike.
  std::optional<ShadingSample> sample(Float uc, const Vec2& u) const {
    const auto s = bsdf.sample(wo, uc, u);
    if (!s) return {};
    const ShadingSample sampled{s->wi, s->f * std::abs(s->wi.z()), s->pdf, s->delta, s->eta, !frame.is_bent()};
    return frame.is_flat() ? sampled : mirrored(sampled);
  }

 private:
  // Directions of the BSDF that end in one direction.
  struct Origins {
    std::array<Vec3, 2> directions;
    int count;
    const Vec3* begin() const { return directions.data(); }
    const Vec3* end() const { return directions.data() + count; }
  };
  Origins origins(const Vec3& wi) const {
    if (frame.is_flat()) return {{wi}, 1};
    Origins found{{}, 0};
    const bool reflects = frame.same_side(wo, wi);
    for (const Vec3& w : {wi, frame.mirror(wi)})
      if (is_reflection(w) == reflects) found.directions[static_cast<std::size_t>(found.count++)] = w;
    return found;
  }
  // Whether the BSDF reflects light from w.
  bool is_reflection(const Vec3& w) const { return wo.z() * w.z() > 0; }

  // For different normals. Calls, so that code for equal normals stays small.
  [[gnu::noinline]] Spectrum mirrored_f_cos(const Vec3& wi) const {
    Spectrum sum = Spectrum::Zero();
    for (const Vec3& w : origins(wi)) sum += bsdf.eval(wo, w) * std::abs(w.z());
    return sum;
  }
  [[gnu::noinline]] Float mirrored_pdf(const Vec3& wi) const {
    Float sum = 0;
    for (const Vec3& w : origins(wi)) sum += bsdf.pdf(wo, w);
    return sum;
  }
  [[gnu::noinline]] Float mirrored_reverse_pdf(const Vec3& wi) const {
    const Reverse other = reverse(wi);
    return other.at.pdf(other.wi);
  }
  [[gnu::noinline]] ShadingSample mirrored(ShadingSample sampled) const {
    sampled.reversible = sampled.reversible && !ShadingFrame::faces_away(point, frame.to_world(sampled.wi));
    if (frame.same_side(wo, sampled.wi) != is_reflection(sampled.wi)) {
      sampled.wi = frame.mirror(sampled.wi);
      sampled.reversible = false;
    }
    if (!sampled.delta && origins(sampled.wi).count == 2) {
      sampled.f_cos = mirrored_f_cos(sampled.wi);
      sampled.pdf = mirrored_pdf(sampled.wi);
    }
    return sampled;
  }
};

/// A vertex with exchanged directions.
template <class B> struct ShadingPoint<B>::Reverse {
  ShadingPoint at; ///< The vertex, seen from the former wi.
  Vec3 wi;         ///< The former wo, in its frame.
};

template <class B> auto ShadingPoint<B>::reverse(const Vec3& wi) const -> Reverse {
  Reverse other{frame.is_flat() ? *this : ShadingPoint(bsdf, point, frame.to_world(wi)), wo};
  if (frame.is_flat()) other.at.wo = wi;
  else other.wi = other.at.frame.to_local(frame.to_world(wo));
  return other;
}

} // namespace render

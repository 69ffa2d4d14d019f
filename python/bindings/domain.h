#pragma once
/// Domains for Python.

#include "arrays.h"

#include <mc/check/subject/make_distribution.h>
#include <mc/domain/annulus.h>
#include <mc/domain/ball.h>
#include <mc/domain/box.h>
#include <mc/domain/cap.h>
#include <mc/domain/disk.h>
#include <mc/domain/hemisphere.h>
#include <mc/domain/interval.h>
#include <mc/domain/parallelogram.h>
#include <mc/domain/patch.h>
#include <mc/domain/product.h>
#include <mc/domain/rotated.h>
#include <mc/domain/sphere.h>
#include <mc/domain/triangle.h>

#include <fmt/format.h>

#include <string>

namespace bindings {

/// A domain of any type over double, with its text for messages.
struct BoundDomain {
  mc::AnyDomain any;
  std::string text; ///< "the unit disk"
};

/// The text of a domain.
inline std::string domain_text(const mc::Interval<double>& d) { return fmt::format("x in [{:g}, {:g}]", d.lo, d.hi); }
/// @cond
inline std::string domain_text(const mc::HalfLine<double>& d) {
  return d.scale > 0 ? fmt::format("x in [{:g}, inf)", d.origin) : fmt::format("x in (-inf, {:g}]", d.origin);
}
inline std::string domain_text(const mc::RealLine<double>&) { return "the real line"; }
inline std::string domain_text(const mc::Disk<double>&) { return "the unit disk"; }
inline std::string domain_text(const mc::Annulus<double>& d) {
  return fmt::format("the ring {:g} <= |p| <= {:g}", d.inner, d.outer);
}
inline std::string domain_text(const mc::Triangle<double>&) { return "the triangle x, y >= 0, x + y <= 1"; }
inline std::string domain_text(const mc::Sphere<double>&) { return "the unit sphere"; }
inline std::string domain_text(const mc::Hemisphere<double>&) { return "the upper unit hemisphere"; }
inline std::string domain_text(const mc::Cap<double>& d) { return fmt::format("the cap 1 - z <= {:g}", d.h); }
inline std::string domain_text(const mc::Ball<double>&) { return "the unit ball"; }
inline std::string domain_text(const mc::UnitQuaternions<double>&) { return "the unit quaternions"; }
inline std::string domain_text(const mc::Parallelogram<double>&) { return "a parallelogram in space"; }
template <int N> std::string domain_text(const mc::Patch<double, N>&) { return "directions to a patch"; }
template <int N> std::string domain_text(const mc::Box<double, N>& d) {
  std::string text;
  for (int i = 0; i < d.dimension(); ++i) text += fmt::format("{}[{:g}, {:g}]", i ? " x " : "", d.lo[i], d.hi[i]);
  return text;
}
template <class D> std::string domain_text(const mc::RotatedDomain<D>& d) {
  return fmt::format("{} about ({:g}, {:g}, {:g})", domain_text(d.inner), d.frame.z.x(), d.frame.z.y(), d.frame.z.z());
}
template <class A, class B> std::string domain_text(const mc::ProductDomain<A, B>& d) {
  return domain_text(d.first) + " x " + domain_text(d.second);
}
/// @endcond

/// Removes the type of a domain.
template <mc::Domain D> BoundDomain bind_domain(const D& domain) {
  return {mc::detail::distribution_on("", domain).domain, domain_text(domain)};
}

/// A domain from a Python object: a domain, a warp, or text such as "hemisphere" and "x=0:1,y=-1:2".
///   throws : Error for anything else.
BoundDomain to_domain(const py::handle& object);

} // namespace bindings

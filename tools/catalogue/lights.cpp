#include <catalogue/warp_case.h>

#include <mc/warp/sphere_light.h>
#include <mc/warp/spherical_rectangle.h>
#include <mc/warp/spherical_triangle.h>

namespace carlo {

namespace {

// A patch given by a corner and two edges of length about `edge`.
template <template <class> class W, class S> W<S> patch(double edge) {
  return W<S>(mc::Vec3<S>(S(0.3), S(-0.2), S(0.9)), mc::Vec3<S>(S(edge), S(0.1 * edge), S(-0.2 * edge)),
              mc::Vec3<S>(S(0.3 * edge), S(edge), S(0.05 * edge)));
}

} // namespace

void add_lights(Catalogue& c) {
  for (const double radius : {1e-8, 1e-3, 0.5, 0.999999, 1.0, 1.5})
    add_warp(c, "SphereLight", fmt::format("radius={:g}, distance=1", radius), [radius](auto s) {
      return mc::SphereLight<decltype(s)>({0, 1, 0}, static_cast<decltype(s)>(radius));
    });
  for (const double edge : {1.0, 0.1, 1e-4}) {
    const mc::LawOptions bounds{.invert_eps = 6400 / edge, .sample_eps = 64, .pdf_eps = 64};
    add_warp(
        c, "SphericalTriangle", fmt::format("edge={:g}", edge),
        [edge](auto s) { return patch<mc::SphericalTriangle, decltype(s)>(edge); }, bounds);
    add_warp(
        c, "SphericalRectangle", fmt::format("edge={:g}", edge),
        [edge](auto s) { return patch<mc::SphericalRectangle, decltype(s)>(edge); }, bounds);
  }
}

} // namespace carlo

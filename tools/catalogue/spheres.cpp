#include <catalogue/warp_case.h>

#include <mc/table/table_dist_1d.h>
#include <mc/warp/ball.h>
#include <mc/warp/cone.h>
#include <mc/warp/hemisphere.h>
#include <mc/warp/mixture.h>
#include <mc/warp/mixture_n.h>
#include <mc/warp/rotated.h>
#include <mc/warp/rotation.h>
#include <mc/warp/sphere.h>

namespace carlo {

void add_spheres(Catalogue& c) {
  add_warp(c, "UniformSphere", "", [](auto s) { return mc::UniformSphere<decltype(s)>{}; }, {.invert_eps = 8});
  add_warp(c, "UniformHemisphere", "", [](auto s) { return mc::UniformHemisphere<decltype(s)>{}; }, {.invert_eps = 8});
  add_warp(c, "CosineHemisphere", "", [](auto s) { return mc::CosineHemisphere<decltype(s)>{}; }, {.invert_eps = 8});
  for (const double angle : {1e-6, 1e-3, 0.1, 1.5, 3.0})
    add_warp(c, "UniformCone", fmt::format("angle={:g}", angle),
             [angle](auto s) { return mc::UniformCone<decltype(s)>::from_angle(static_cast<decltype(s)>(angle)); });
  for (const double weight : {1e-4, 0.5})
    add_warp(c, "Mixture", fmt::format("uniform={:g}, cosine={:g}", weight, 1 - weight), [weight](auto s) {
      using S = decltype(s);
      return mc::Mixture(std::array<S, 2>{S(weight), S(1 - weight)}, mc::UniformHemisphere<S>{},
                         mc::CosineHemisphere<S>{});
    });
  add_warp(c, "MixtureN", "3 cones", [](auto s) {
    using S = decltype(s);
    std::vector<mc::Rotated<mc::UniformCone<S>>> parts;
    for (const auto& axis : {mc::Vec3<S>(0, 0, 1), mc::Vec3<S>(S(0.6), S(-0.8), 0), mc::Vec3<S>(0, S(0.6), S(0.8))})
      parts.emplace_back(mc::UniformCone<S>::from_angle(S(0.5)), axis);
    return mc::MixtureN(mc::Sphere<S>{}, mc::TableDist1D<S>(std::vector<double>{1, 5, 2}), parts);
  });
  add_warp(c, "UniformBall", "", [](auto s) { return mc::UniformBall<decltype(s)>{}; }, {.invert_eps = 8});
  add_warp(c, "UniformRotation", "", [](auto s) { return mc::UniformRotation<decltype(s)>{}; }, {.invert_eps = 8});
  add_warp(c, "Rotated", "cosine about (0.6, -0.8, 0)",
           [](auto s) {
             using S = decltype(s);
             return mc::Rotated(mc::CosineHemisphere<S>{}, mc::Vec3<S>(S(0.6), S(-0.8), 0));
           },
           {.invert_eps = 64, .pdf_eps = 512}); // eps / z at the horizon
}

} // namespace carlo

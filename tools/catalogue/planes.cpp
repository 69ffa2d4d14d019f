#include <catalogue/warp_case.h>

#include <mc/table/discrete.h>
#include <mc/warp/annulus.h>
#include <mc/warp/bilinear.h>
#include <mc/warp/disk.h>
#include <mc/warp/isotropic_normal.h>
#include <mc/warp/mixture_n.h>
#include <mc/warp/parallelogram.h>
#include <mc/warp/product.h>
#include <mc/warp/triangle.h>
#include <mc/warp/uniform.h>

namespace carlo {

void add_planes(Catalogue& c) {
  add_warp(c, "UniformDisk", "", [](auto s) { return mc::UniformDisk<decltype(s)>{}; }, {.invert_eps = 8});
  add_warp(c, "UniformDiskPolar", "", [](auto s) { return mc::UniformDiskPolar<decltype(s)>{}; }, {.invert_eps = 8});
  add_warp(c, "UniformTriangle", "", [](auto s) { return mc::UniformTriangle<decltype(s)>{}; }, {.invert_eps = 4});
  for (const double inner : {0.0, 0.5})
    add_warp(c, "UniformAnnulus", fmt::format("inner={:g}, outer=1", inner),
             [inner](auto s) { return mc::UniformAnnulus<decltype(s)>(static_cast<decltype(s)>(inner), 1); });
  add_warp(c, "UniformParallelogram", "", [](auto s) {
    using S = decltype(s);
    return mc::UniformParallelogram<S>{{mc::Vec3<S>(0, 0, 0), mc::Vec3<S>(1, 2, 3), mc::Vec3<S>(-1, 0, S(0.5))}};
  });
  for (const std::array<double, 4>& w : {std::array{1.0, 2.0, 3.0, 4.0}, {0.0, 0.0, 1.0, 1.0}, {1e30, 1.0, 1e30, 0.0}})
    add_warp(c, "Bilinear", fmt::format("{:g}, {:g}, {:g}, {:g}", w[0], w[1], w[2], w[3]), [w](auto s) {
      using S = decltype(s);
      return mc::Bilinear<S>(S(w[0]), S(w[1]), S(w[2]), S(w[3]));
    });
  add_warp(c, "IsotropicNormal", "sigma=1", [](auto s) { return mc::IsotropicNormal<decltype(s)>{}; },
           {.invert_eps = 8});
  add_warp(c, "UniformBox", "a pixel", [](auto s) {
    using S = decltype(s);
    return mc::UniformBox<S, 2>(mc::Vec2<S>(S(-0.5), S(-0.5)), mc::Vec2<S>(S(0.5), S(0.5)));
  });
  add_warp(c, "Product", "2 x 2 tents", [](auto s) {
    using S = decltype(s);
    const mc::MixtureN axis(mc::Interval<S>(-1, 1), mc::UniformDiscrete<S>(2),
                            std::vector<mc::Tent<S>>{{S(-0.25), S(0.5)}, {S(0.25), S(0.5)}});
    return mc::Product{axis, axis};
  });
  add_warp(c, "Product", "2-D tent", [](auto s) { return mc::Tent2D<decltype(s)>{}; }, {.invert_eps = 8});
  add_warp(c, "Product", "2-D normal", [](auto s) { return mc::Normal2D<decltype(s)>{}; });
}

} // namespace carlo

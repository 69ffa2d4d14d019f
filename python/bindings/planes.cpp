#include "warp.h"

#include <mc/warp/annulus.h>
#include <mc/warp/ball.h>
#include <mc/warp/bilinear.h>
#include <mc/warp/disk.h>
#include <mc/warp/isotropic_normal.h>
#include <mc/warp/parallelogram.h>
#include <mc/warp/rotation.h>
#include <mc/warp/triangle.h>
#include <mc/warp/uniform.h>

namespace bindings {

namespace {

using Numbers3 = std::array<double, 3>;
mc::Vec3<double> vector(const Numbers3& v) { return {v[0], v[1], v[2]}; }

struct UniformBox {};

template <int N> AnyWarp box_of(const std::vector<double>& lo, const std::vector<double>& hi) {
  using V = mc::Vec<double, N>;
  return any_warp(fmt::format("UniformBox([{:g}], [{:g}])", fmt::join(lo, ", "), fmt::join(hi, ", ")),
                  mc::UniformBox<double, N>(V(Eigen::Map<const V>(lo.data())), V(Eigen::Map<const V>(hi.data()))));
}

BoundWarp<UniformBox> make_box(const std::vector<double>& lo, const std::vector<double>& hi) {
  mc::require(lo.size() == hi.size() && (lo.size() == 2 || lo.size() == 3),
              "UniformBox: bounds of {} and {} numbers; both need 2 or 3", lo.size(), hi.size());
  return BoundWarp<UniformBox>(lo.size() == 2 ? box_of<2>(lo, hi) : box_of<3>(lo, hi));
}

} // namespace

void bind_planes(py::module_& m) {
  using py::arg;
  warp_class<mc::UniformDisk<double>>(m, "UniformDisk").def(py::init([] {
    return make_warp("UniformDisk()", mc::UniformDisk<double>());
  }));
  warp_class<mc::UniformDiskPolar<double>>(m, "UniformDiskPolar").def(py::init([] {
    return make_warp("UniformDiskPolar()", mc::UniformDiskPolar<double>());
  }));
  warp_class<mc::UniformTriangle<double>>(m, "UniformTriangle").def(py::init([] {
    return make_warp("UniformTriangle()", mc::UniformTriangle<double>());
  }));
  warp_class<mc::UniformAnnulus<double>>(m, "UniformAnnulus")
      .def(py::init([](double inner, double outer) {
             return make_warp("UniformAnnulus(inner={:g}, outer={:g})", mc::UniformAnnulus<double>(inner, outer), inner,
                              outer);
           }),
           arg("inner"), arg("outer") = 1.0);
  warp_class<mc::UniformParallelogram<double>>(m, "UniformParallelogram")
      .def(py::init([](const Numbers3& origin, const Numbers3& a, const Numbers3& b) {
             return make_warp(
                 "UniformParallelogram(origin=({:g}), a=({:g}), b=({:g}))",
                 mc::UniformParallelogram<double>{mc::Parallelogram<double>(vector(origin), vector(a), vector(b))},
                 fmt::join(origin, ", "), fmt::join(a, ", "), fmt::join(b, ", "));
           }),
           arg("origin"), arg("a"), arg("b"));
  warp_class<mc::Bilinear<double>>(m, "Bilinear")
      .def(py::init([](double w00, double w10, double w01, double w11) {
             return make_warp("Bilinear(w00={:g}, w10={:g}, w01={:g}, w11={:g})",
                              mc::Bilinear<double>(w00, w10, w01, w11), w00, w10, w01, w11);
           }),
           arg("w00"), arg("w10"), arg("w01"), arg("w11"));
  warp_class<mc::IsotropicNormal<double>>(m, "IsotropicNormal")
      .def(py::init([](double sigma) {
             return make_warp("IsotropicNormal(sigma={:g})", mc::IsotropicNormal<double>(sigma), sigma);
           }),
           arg("sigma") = 1.0);
  py::class_<BoundWarp<UniformBox>, AnyWarp>(m, "UniformBox", contract("UniformBox").c_str())
      .def(py::init(&make_box), arg("lo"), arg("hi"));
  warp_class<mc::UniformBall<double>>(m, "UniformBall").def(py::init([] {
    return make_warp("UniformBall()", mc::UniformBall<double>());
  }));
  warp_class<mc::UniformRotation<double>>(m, "UniformRotation").def(py::init([] {
    return make_warp("UniformRotation()", mc::UniformRotation<double>());
  }));
}

} // namespace bindings

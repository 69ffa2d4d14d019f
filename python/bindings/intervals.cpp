#include "warp.h"

#include <mc/warp/exponential.h>
#include <mc/warp/linear.h>
#include <mc/warp/logistic.h>
#include <mc/warp/normal.h>
#include <mc/warp/power.h>
#include <mc/warp/smoothstep.h>
#include <mc/warp/tent.h>
#include <mc/warp/uniform.h>

namespace bindings {

void bind_intervals(py::module_& m) {
  using py::arg;
  warp_class<mc::UniformInterval<double>>(m, "UniformInterval")
      .def(py::init([](double lo, double hi) {
             return make_warp("UniformInterval(lo={:g}, hi={:g})", mc::UniformInterval<double>(lo, hi), lo, hi);
           }),
           arg("lo") = 0.0, arg("hi") = 1.0);
  warp_class<mc::Linear<double>>(m, "Linear")
      .def(py::init(
               [](double a, double b) { return make_warp("Linear(a={:g}, b={:g})", mc::Linear<double>(a, b), a, b); }),
           arg("a"), arg("b"));
  warp_class<mc::Tent<double>>(m, "Tent").def(py::init([](double center, double radius) {
                                                return make_warp("Tent(center={:g}, radius={:g})",
                                                                 mc::Tent<double>(center, radius), center, radius);
                                              }),
                                              arg("center") = 0.0, arg("radius") = 1.0);
  warp_class<mc::Normal<double>>(m, "Normal")
      .def(py::init([](double mean, double sigma) {
             return make_warp("Normal(mean={:g}, sigma={:g})", mc::Normal<double>(mean, sigma), mean, sigma);
           }),
           arg("mean") = 0.0, arg("sigma") = 1.0);
  warp_class<mc::Exponential<double>>(m, "Exponential")
      .def(py::init(
               [](double rate) { return make_warp("Exponential(rate={:g})", mc::Exponential<double>(rate), rate); }),
           arg("rate") = 1.0);
  warp_class<mc::TrimmedExponential<double>>(m, "TrimmedExponential")
      .def(py::init([](double rate, double length) {
             return make_warp("TrimmedExponential(rate={:g}, length={:g})",
                              mc::TrimmedExponential<double>(rate, length), rate, length);
           }),
           arg("rate") = 1.0, arg("length") = 1.0);
  warp_class<mc::Logistic<double>>(m, "Logistic")
      .def(py::init([](double mean, double scale) {
             return make_warp("Logistic(mean={:g}, scale={:g})", mc::Logistic<double>(mean, scale), mean, scale);
           }),
           arg("mean") = 0.0, arg("scale") = 1.0);
  warp_class<mc::TrimmedLogistic<double>>(m, "TrimmedLogistic")
      .def(py::init([](double scale, double lo, double hi) {
             return make_warp("TrimmedLogistic(scale={:g}, lo={:g}, hi={:g})",
                              mc::TrimmedLogistic<double>(scale, lo, hi), scale, lo, hi);
           }),
           arg("scale") = 1.0, arg("lo") = -1.0, arg("hi") = 1.0);
  warp_class<mc::Smoothstep<double>>(m, "Smoothstep").def(py::init([] {
    return make_warp("Smoothstep()", mc::Smoothstep<double>());
  }));
  warp_class<mc::Power<double>>(m, "Power")
      .def(py::init([](double n) { return make_warp("Power(n={:g})", mc::Power<double>(n), n); }), arg("n"));
}

} // namespace bindings

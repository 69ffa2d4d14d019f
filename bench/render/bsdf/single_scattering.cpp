// Energy loss of rough surfaces with single scattering: the albedo of materials that absorb nothing, as CSV.
//
//   bench_render_single_scattering [POINTS] > notebooks-data/single-scattering/albedo.csv

#include <render/bsdf/rough_conductor.h>
#include <render/bsdf/rough_dielectric.h>
#include <render/bsdf/rough_plastic.h>

#include <fmt/format.h>

#include <cstdlib>

#include "render/bsdf/albedo.h"

namespace {

using namespace render;

template <class B> void print_row(const char* material, double eta, double alpha, const B& bsdf, int side, int points) {
  fmt::print("{},{},{}", material, eta, alpha);
  for (const double cosine : {1.0, 0.9, 0.7, 0.5, 0.3, 0.2, 0.1, 0.03, 0.003})
    fmt::print(",{:.4f}", support::albedo(bsdf, side * cosine, points));
  fmt::print("\n");
}

} // namespace

int main(int argc, char** argv) {
  const int points = argc > 1 ? std::atoi(argv[1]) : 1 << 18;
  const Spectrum one = Spectrum::Ones(), none = Spectrum::Zero();
  fmt::print("material,eta,alpha,cos=1,cos=0.9,cos=0.7,cos=0.5,cos=0.3,cos=0.2,cos=0.1,cos=0.03,cos=0.003\n");
  for (const double alpha : {1e-4, 1e-3, 0.01, 0.03, 0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1.0}) {
    const Float a(alpha);
    print_row("metal ggx", 0, alpha, RoughConductor(none, one, TrowbridgeReitzFacets(a)), 1, points); // F = 1
    print_row("metal phong", 0, alpha, RoughConductor(none, one, BlinnPhongFacets(a)), 1, points);
    for (const double eta : {1.33, 1.5, 2.0}) {
      print_row("glass from outside", eta, alpha, RoughDielectric(Float(eta), a), 1, points);
      print_row("glass from inside", eta, alpha, RoughDielectric(Float(eta), a), -1, points);
      print_row("white paint", eta, alpha, RoughPlastic(Float(eta), a, one, one), 1, points);
    }
  }
}

/// CPU time of batches of C++ in double: the yardstick of overhead.py, which writes lines "CASE<tab>OPERATION" to the
/// standard input. Each line runs one batch of 1e6 points and prints its CPU time [ns per point]; operations are
/// sample, pdf, invert and sample_index. With an argument: lists the cases, which are expressions of Python.

#include <mc/random/uniform.h>
#include <mc/table/alias_table.h>
#include <mc/table/discrete.h>
#include <mc/table/table_dist_1d.h>
#include <mc/table/table_dist_2d.h>
#include <mc/table/table_dist_tree.h>
#include <mc/warp/annulus.h>
#include <mc/warp/ball.h>
#include <mc/warp/beckmann.h>
#include <mc/warp/bilinear.h>
#include <mc/warp/blinn_phong.h>
#include <mc/warp/cone.h>
#include <mc/warp/disk.h>
#include <mc/warp/exponential.h>
#include <mc/warp/half_vector.h>
#include <mc/warp/hemisphere.h>
#include <mc/warp/henyey_greenstein.h>
#include <mc/warp/isotropic_normal.h>
#include <mc/warp/linear.h>
#include <mc/warp/logistic.h>
#include <mc/warp/mixture_n.h>
#include <mc/warp/normal.h>
#include <mc/warp/parallelogram.h>
#include <mc/warp/power.h>
#include <mc/warp/product.h>
#include <mc/warp/rotated.h>
#include <mc/warp/rotation.h>
#include <mc/warp/sample_n.h>
#include <mc/warp/smoothstep.h>
#include <mc/warp/sphere.h>
#include <mc/warp/sphere_light.h>
#include <mc/warp/spherical_rectangle.h>
#include <mc/warp/spherical_triangle.h>
#include <mc/warp/tent.h>
#include <mc/warp/triangle.h>
#include <mc/warp/trowbridge_reitz.h>
#include <mc/warp/uniform.h>
#include <mc/warp/von_mises_fisher.h>

#include <cstdio>
#include <ctime>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace {

constexpr std::size_t samples = 1'000'000;

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

template <class F> double ns_of(F&& f) {
  const double start = cpu_seconds();
  f();
  return (cpu_seconds() - start) * 1e9 / samples;
}

using Case = std::map<std::string, std::function<double()>>; // operations of a case

const std::vector<double>& uniforms() {
  static const std::vector<double> u = [] {
    std::vector<double> numbers(3 * samples);
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = mc::hash_uniform<double>(1, i);
    return numbers;
  }();
  return u;
}

template <mc::Warp W> double sample_ns(const W& warp) {
  constexpr std::size_t from = std::tuple_size_v<mc::UnitColumns<W>>, to = std::tuple_size_v<mc::PointColumns<W>>;
  static std::vector<double> x(4 * samples);
  mc::UnitColumns<W> in;
  mc::PointColumns<W> out;
  for (std::size_t k = 0; k < from; ++k) in[k] = std::span(uniforms()).subspan(k * samples, samples);
  for (std::size_t k = 0; k < to; ++k) out[k] = std::span(x).subspan(k * samples, samples);
  return ns_of([&] { mc::sample_n(warp, in, out); });
}

// The points that pdf and invert receive.
template <mc::Warp W> std::vector<mc::PointOf<W>> points_of(const W& warp) {
  std::vector<mc::PointOf<W>> points;
  for (std::size_t i = 0; i < samples; ++i) {
    mc::UnitPointOf<W> u;
    if constexpr (W::Domain::dim == 1) u = uniforms()[i];
    else
      for (int k = 0; k < W::Domain::dim; ++k) u[k] = uniforms()[std::size_t(k) * samples + i];
    points.push_back(warp.sample(u));
  }
  return points;
}

template <mc::Warp W> Case operations(const W& warp) {
  Case c;
  c["sample"] = [warp] { return sample_ns(warp); };
  c["pdf"] = [warp] {
    const std::vector<mc::PointOf<W>> points = points_of(warp);
    std::vector<double> densities(samples);
    return ns_of([&] {
      for (std::size_t i = 0; i < samples; ++i) densities[i] = warp.pdf(points[i]);
    });
  };
  if constexpr (mc::InvertibleWarp<W>)
    c["invert"] = [warp] {
      const std::vector<mc::PointOf<W>> points = points_of(warp);
      std::vector<mc::UnitPointOf<W>> u(samples);
      return ns_of([&] {
        for (std::size_t i = 0; i < samples; ++i) u[i] = warp.invert(points[i]);
      });
    };
  return c;
}

template <mc::DiscreteDistribution D> Case index_operations(const D& d) {
  return {{"sample_index", [d] {
             std::vector<std::int64_t> index(samples);
             std::vector<double> pmf(samples), remapped(samples);
             return ns_of([&] {
               for (std::size_t i = 0; i < samples; ++i) {
                 const mc::DiscreteSample<double> s = d.sample_index(uniforms()[i]);
                 index[i] = std::int64_t(s.index);
                 pmf[i] = s.pmf;
                 remapped[i] = s.u_remapped;
               }
             });
           }}};
}

std::vector<double> weights(std::size_t n) {
  std::vector<double> w(n);
  for (std::size_t i = 0; i < n; ++i) w[i] = double(i + 1);
  return w;
}

using V = mc::Vec3<double>;

void add_intervals(std::map<std::string, Case>& c) {
  c["UniformInterval()"] = operations(mc::UniformInterval<double>(0, 1));
  c["Linear(1, 3)"] = operations(mc::Linear<double>(1, 3));
  c["Tent()"] = operations(mc::Tent<double>(0, 1));
  c["Normal()"] = operations(mc::Normal<double>());
  c["Exponential(2)"] = operations(mc::Exponential<double>(2));
  c["TrimmedExponential(2, 1)"] = operations(mc::TrimmedExponential<double>(2, 1));
  c["Logistic()"] = operations(mc::Logistic<double>(0, 1));
  c["TrimmedLogistic(0.5)"] = operations(mc::TrimmedLogistic<double>(0.5, -1, 1));
  c["Smoothstep()"] = operations(mc::Smoothstep<double>());
  c["Power(3)"] = operations(mc::Power<double>(3));
}

void add_planes(std::map<std::string, Case>& c) {
  c["UniformDisk()"] = operations(mc::UniformDisk<double>());
  c["UniformDiskPolar()"] = operations(mc::UniformDiskPolar<double>());
  c["UniformTriangle()"] = operations(mc::UniformTriangle<double>());
  c["UniformAnnulus(0.5)"] = operations(mc::UniformAnnulus<double>(0.5, 1));
  c["UniformParallelogram((0, 0, 1), (1, 0, 0), (0, 2, 1))"] =
      operations(mc::UniformParallelogram<double>{mc::Parallelogram<double>(V(0, 0, 1), V(1, 0, 0), V(0, 2, 1))});
  c["Bilinear(1, 2, 3, 4)"] = operations(mc::Bilinear<double>(1, 2, 3, 4));
  c["IsotropicNormal()"] = operations(mc::IsotropicNormal<double>(1));
  c["UniformBox([0, 0, 0], [1, 2, 3])"] = operations(mc::UniformBox<double, 3>(V(0, 0, 0), V(1, 2, 3)));
  c["UniformBall()"] = operations(mc::UniformBall<double>());
  c["UniformRotation()"] = operations(mc::UniformRotation<double>());
}

void add_directions(std::map<std::string, Case>& c) {
  using Visible = mc::TrowbridgeReitzVisibleNormals<double>;
  const V wo(0.6, 0, 0.8);
  c["UniformSphere()"] = operations(mc::UniformSphere<double>());
  c["UniformHemisphere()"] = operations(mc::UniformHemisphere<double>());
  c["CosineHemisphere()"] = operations(mc::CosineHemisphere<double>());
  c["UniformCone(0.3)"] = operations(mc::UniformCone<double>::from_angle(0.3));
  c["SphereLight((0, 0, 3), 1)"] = operations(mc::SphereLight<double>(V(0, 0, 3), 1));
  c["SphericalRectangle((1, 0, 1), (0, 1, 0), (0, 0, 1))"] =
      operations(mc::SphericalRectangle<double>(V(1, 0, 1), V(0, 1, 0), V(0, 0, 1)));
  c["SphericalTriangle((1, 0, 1), (0, 1, 0), (0, 0, 1))"] =
      operations(mc::SphericalTriangle<double>(V(1, 0, 1), V(0, 1, 0), V(0, 0, 1)));
  c["BlinnPhong(20)"] = operations(mc::BlinnPhong<double>(20));
  c["HenyeyGreenstein(0.7)"] = operations(mc::HenyeyGreenstein<double>(0.7));
  c["VonMisesFisher(10)"] = operations(mc::VonMisesFisher<double>(10));
  c["BeckmannNormals(0.3)"] = operations(mc::BeckmannNormals<double>(0.3, 0.3));
  c["TrowbridgeReitzNormals(0.3)"] = operations(mc::TrowbridgeReitzNormals<double>(0.3, 0.3));
  c["TrowbridgeReitzVisibleNormals((0.6, 0, 0.8), 0.3)"] = operations(Visible(wo, 0.3));
  c["Reflected(TrowbridgeReitzVisibleNormals((0.6, 0, 0.8), 0.3))"] = operations(mc::Reflected(Visible(wo, 0.3)));
  c["RefractedIn(TrowbridgeReitzVisibleNormals((0.6, 0, 0.8), 0.3), 1.5)"] =
      operations(mc::RefractedIn(Visible(wo, 0.3), 1.5));
  c["Rotated(CosineHemisphere(), (0.6, 0, 0.8))"] = operations(mc::Rotated<mc::CosineHemisphere<double>>({}, wo));
}

void add_tables(std::map<std::string, Case>& c) {
  c["AliasTable(numpy.arange(1, 1025))"] = index_operations(mc::AliasTable(weights(1024)));
  c["UniformDiscrete(1024)"] = index_operations(mc::UniformDiscrete<double>(1024));
  c["Bernoulli(0.3)"] = index_operations(mc::Bernoulli<double>(0.3));
  c["ShortDiscrete(numpy.arange(1, 17))"] = index_operations(mc::ShortDiscrete<double, 64>(weights(16)));
  const mc::TableDist1D<double> table(weights(1024), mc::Interval<double>(0, 1));
  c["TableDist1D(numpy.arange(1, 1025))"] = operations(table);
  c["TableDist1D(numpy.arange(1, 1025))"].merge(index_operations(table));
  c["TableDist2D(numpy.arange(1, 65537).reshape(256, 256))"] =
      operations(mc::TableDist2D<double>(weights(65536), 256, 256));
  c["TableDistTree(2, [(0, 0.5), (-1, 1), (1, 0.25), (-1, 2), (-1, 3)])"] = operations(
      mc::TableDistTree<double, 2>(mc::BoxTree(2, std::vector<mc::BoxTreeNode>{{0, 0.5},
                                                                               {mc::BoxTreeNode::leaf, 1},
                                                                               {1, 0.25},
                                                                               {mc::BoxTreeNode::leaf, 2},
                                                                               {mc::BoxTreeNode::leaf, 3}})));
  c["Mixture([1, 3], [Tent(0, 1), Tent(0.5, 0.5)], \"x=-1:1\")"] =
      operations(mc::MixtureN(mc::Interval<double>(-1, 1), mc::TableDist1D<double>(std::vector<double>{1, 3}),
                              std::vector{mc::Tent<double>(0, 1), mc::Tent<double>(0.5, 0.5)}));
  c["Product(Tent(), Exponential(2))"] = operations(mc::Product{mc::Tent<double>(0, 1), mc::Exponential<double>(2)});
}

} // namespace

int main(int count, char**) {
  std::map<std::string, Case> cases;
  add_intervals(cases);
  add_planes(cases);
  add_directions(cases);
  add_tables(cases);
  if (count > 1) {
    for (const auto& [name, c] : cases)
      for (const auto& [operation, run] : c) std::printf("%s\t%s\n", name.c_str(), operation.c_str());
    return 0;
  }
  for (std::string line; std::getline(std::cin, line);) {
    const std::size_t tab = line.find('\t');
    std::printf("%.4f\n", cases.at(line.substr(0, tab)).at(line.substr(tab + 1))());
    std::fflush(stdout);
  }
  return 0;
}

#include "module.h"
#include "warp.h"

#include <mc/table/table_dist_1d.h>
#include <mc/warp/mixture_n.h>
#include <mc/warp/product.h>

#include <cmath>
#include <map>

namespace bindings {

namespace detail {
void refuse_outside(const double* x, std::size_t columns, std::size_t index) {
  throw mc::Error(fmt::format("point {} = {} lies outside of the domain", index, mc::format_numbers({x, columns}, 17)));
}
} // namespace detail

namespace {

Array sample(const AnyWarp& w, const ArrayLike& u, const py::object& out) {
  const Rows rows = to_rows(u, w.uniforms(), "sample: u");
  Array x = rows_for(out, rows.outer, w.coordinates());
  double* to = x.mutable_data();
  const bool in_place = to == rows.array.data();
  if (in_place) require_unit(rows, "sample: u"); // so that an error leaves u as it was
  const py::gil_scoped_release release;
  constexpr std::size_t block = 1024; // stays in the cache between the check and the map
  for (std::size_t first = 0; first < rows.count; first += block) {
    const std::size_t n = std::min(block, rows.count - first);
    require_unit(rows, "sample: u", first, n);
    w.sample(w.held.get(), n, rows.values().data() + first * w.uniforms(), to + first * w.coordinates());
  }
  return x;
}

Array pdf(const AnyWarp& w, const ArrayLike& x, const py::object& out) {
  const Rows rows = to_rows(x, w.coordinates(), "pdf: x");
  Array density = rows_for(out, rows.outer, 1);
  const double* in = rows.array.data();
  double* to = density.mutable_data();
  const py::gil_scoped_release release;
  w.pdf(w.held.get(), rows.count, in, to);
  return density;
}

Array invert(const AnyWarp& w, const ArrayLike& x, const py::object& out) {
  mc::require(w.invert, "{}: has no inverse, because several u give the same point", w.name);
  const Rows rows = to_rows(x, w.coordinates(), "invert: x");
  Array u = rows_for(out, rows.outer, w.uniforms());
  const double* in = rows.array.data();
  double* to = u.mutable_data();
  const py::gil_scoped_release release;
  mc::with_context("invert", [&] { w.invert(w.held.get(), rows.count, in, to); });
  return u;
}

// Whether the charts of two domains give the same points, at three places of each axis.
bool are_equal(const mc::AnyDomain& a, const mc::AnyDomain& b) {
  if (a.dim != b.dim || a.point_size != b.point_size) return false;
  constexpr std::array places{0.0625, 0.5, 0.9375};
  const auto points = static_cast<std::size_t>(std::pow(places.size(), a.dim));
  for (std::size_t i = 0; i < points; ++i) {
    mc::AnyDomain::Coordinates v{};
    std::size_t rest = i;
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(a.dim); ++axis, rest /= places.size())
      v[axis] = places[rest % places.size()];
    if (a.from_unit(v).x != b.from_unit(v).x) return false;
  }
  return true;
}

bool have_equal_domains(const std::vector<AnyWarp>& warps) {
  return std::all_of(warps.begin(), warps.end(),
                     [&](const AnyWarp& w) { return are_equal(w.domain.any, warps.front().domain.any); });
}

template <int Dim, int Size>
AnyWarp mixture_of(const std::string& name, const BoundDomain& domain, const std::vector<double>& weights,
                   const std::vector<AnyWarp>& warps) {
  std::vector<PartWarp<Dim, Size>> parts;
  for (const AnyWarp& w : warps) parts.emplace_back(w);
  const PartDomain<Dim, Size> on{std::make_shared<const mc::AnyDomain>(domain.any)};
  AnyWarp any = any_warp(name, mc::MixtureN(on, mc::TableDist1D<double>(weights), std::move(parts)));
  any.domain = domain;
  return any;
}

struct Mixture {};
struct Product {};

BoundWarp<Mixture> make_mixture(const std::vector<double>& weights, const std::vector<AnyWarp>& warps,
                                const py::object& on) {
  mc::require(!warps.empty(), "Mixture: no warps; one or more are needed");
  mc::require(!on.is_none() || have_equal_domains(warps),
              "Mixture: the warps have different domains, {} and others; name a domain that contains them: domain=...",
              warps.front().domain.text);
  const BoundDomain domain = on.is_none() ? warps.front().domain : to_domain(on);
  const int dim = domain.any.dim, size = domain.any.point_size;
  using Make = AnyWarp(const std::string&, const BoundDomain&, const std::vector<double>&, const std::vector<AnyWarp>&);
  static const std::map<std::pair<int, int>, Make*> makers = {{{1, 1}, mixture_of<1, 1>},
                                                              {{2, 2}, mixture_of<2, 2>},
                                                              {{2, 3}, mixture_of<2, 3>},
                                                              {{3, 3}, mixture_of<3, 3>},
                                                              {{3, 4}, mixture_of<3, 4>}};
  std::string names;
  for (const AnyWarp& w : warps) {
    mc::require(w.domain.any.dim == dim && w.domain.any.point_size == size,
                "Mixture: {} has points of {} coordinates, the domain {} of {}; they must agree", w.name,
                w.domain.any.point_size, domain.text, size);
    names += (names.empty() ? "" : ", ") + w.name;
  }
  const std::string name = fmt::format("Mixture([{:g}], [{}])", fmt::join(weights, ", "), names);
  const auto make = makers.find({dim, size});
  mc::require(make != makers.end(), "Mixture: points of {} coordinates on {} axes; 1 to 3 axes are supported", size,
              dim);
  return BoundWarp<Mixture>(make->second(name, domain, weights, warps));
}

// A function of both factors of a product, column by column: products of densities, or a column of results each.
template <class P, auto function> void factor_rows(const void* held, std::size_t count, const double* in, double* out) {
  const P& product = *static_cast<const P*>(held);
  std::array<double, detail::block_size> column, first, second;
  detail::for_blocks(count, [&](std::size_t begin, std::size_t n) {
    const auto map = [&](const AnyWarp& factor, std::size_t k, double* results) {
      for (std::size_t i = 0; i < n; ++i) column[i] = in[2 * (begin + i) + k];
      (factor.*function)(factor.held.get(), n, column.data(), results);
    };
    map(*product.first.any, 0, first.data());
    map(*product.second.any, 1, second.data());
    for (std::size_t i = begin; i < begin + n; ++i) {
      if constexpr (function == &AnyWarp::pdf) {
        out[i] = first[i - begin] * second[i - begin];
      } else {
        out[2 * i] = first[i - begin];
        out[2 * i + 1] = second[i - begin];
      }
    }
  });
}

template <class P> AnyWarp product_of(const std::string& name, const P& product) {
  AnyWarp any = any_warp(name, product);
  any.sample = factor_rows<P, &AnyWarp::sample>;
  any.pdf = factor_rows<P, &AnyWarp::pdf>;
  return any;
}

BoundWarp<Product> make_product(const AnyWarp& a, const AnyWarp& b) {
  mc::require(a.uniforms() == 1 && b.uniforms() == 1, "Product: factors of {} and {} dimensions; both must have one",
              a.uniforms(), b.uniforms());
  const std::string name = fmt::format("Product({}, {})", a.name, b.name);
  AnyWarp any = a.invert && b.invert ? product_of(name, mc::Product{InvertiblePart<1, 1>(a), InvertiblePart<1, 1>(b)})
                                     : product_of(name, mc::Product{PartWarp<1, 1>(a), PartWarp<1, 1>(b)});
  any.domain.text = a.domain.text + " x " + b.domain.text;
  any.breaks = {a.breaks[0], b.breaks[0]};
  return BoundWarp<Product>(std::move(any));
}

constexpr const char* mixture_doc = R"(

In Python the warps may have different types. Without `domain` their domains must be equal.)";
constexpr const char* product_doc = R"(

In Python both factors have one dimension.)";

} // namespace

mc::AnyDistribution to_distribution(const AnyWarp& w) {
  using Uniforms = mc::AnyDistribution::Uniforms;
  using Sample = mc::AnyDistribution::Sample;
  mc::AnyDistribution d;
  d.name = w.name;
  d.domain = w.domain.any;
  d.breaks = w.breaks;
  d.uniforms = w.domain.any.dim;
  d.sample = [w](const Uniforms& u) {
    Sample s;
    w.sample(w.held.get(), 1, u.data(), s.x.data());
    return std::optional(s);
  };
  d.pdf = [w](const mc::PointArray& x) {
    double density = 0;
    w.pdf(w.held.get(), 1, x.data(), &density);
    return density;
  };
  if (w.invert)
    d.invert = [w](const mc::PointArray& x) {
      Uniforms u{};
      w.invert(w.held.get(), 1, x.data(), u.data());
      return std::optional(u);
    };
  return d;
}

void bind_warps(py::module_& parent) {
  py::module_ m = parent.def_submodule("warps", R"(Distributions as maps of uniform numbers, over double.

Every warp has sample(u), pdf(x) and mostly invert(x), which take arrays of any length. An array of points has the shape
(..., k) with k coordinates in the last axis; in one dimension any shape. The same holds for u.)");
  py::class_<AnyWarp>(m, "Warp", R"(Base of all warps: a map from the unit cube, with its density.

  sample(u) : u (..., dim) in [0,1) -> x (..., point_size)
  pdf(x)    : x (..., point_size) -> (...), with respect to length, area, solid angle or volume; 0 outside the support
  invert(x) : x (..., point_size) -> u (..., dim), so that invert(sample(u)) = u
`out` takes an array for the results, which may be the argument itself but must not overlap it otherwise. After an Error
its content is undefined.)")
      .def("sample", &sample, py::arg("u"), py::kw_only(), py::arg("out") = py::none(),
           "Points for uniform numbers: u (..., dim) in [0,1) -> x (..., point_size).")
      .def("pdf", &pdf, py::arg("x"), py::kw_only(), py::arg("out") = py::none(),
           "Density at points: x (..., point_size) -> (...); 0 outside the support.")
      .def("invert", &invert, py::arg("x"), py::kw_only(), py::arg("out") = py::none(),
           "Uniform numbers of points: x (..., point_size) -> u (..., dim). Raises Error for points outside the domain "
           "and for warps without an inverse.")
      .def_property_readonly(
          "domain", [](const AnyWarp& w) { return w.domain; }, "The libmc.Domain of the points.")
      .def_property_readonly(
          "dim", [](const AnyWarp& w) { return w.uniforms(); }, "Uniform numbers for one point.")
      .def_property_readonly(
          "point_size", [](const AnyWarp& w) { return w.coordinates(); }, "Coordinates of a point.")
      .def_property_readonly(
          "is_invertible", [](const AnyWarp& w) { return w.invert != nullptr; }, "Whether invert is available.")
      .def("__repr__", [](const AnyWarp& w) { return w.name; });
  bind_intervals(m);
  bind_planes(m);
  bind_directions(m);
  bind_lobes(m);
  bind_tables(m);
  py::class_<BoundWarp<Mixture>, AnyWarp>(m, "Mixture", (contract("MixtureN") + mixture_doc).c_str())
      .def(py::init(&make_mixture), py::arg("weights"), py::arg("warps"), py::arg("domain") = py::none());
  py::class_<BoundWarp<Product>, AnyWarp>(m, "Product", (contract("Product") + product_doc).c_str())
      .def(py::init(&make_product), py::arg("first"), py::arg("second"));
}

} // namespace bindings

#pragma once
/// Warps without their types, for Python.

#include "contracts.h"
#include "domain.h"

#include <mc/check/subject/any_distribution.h>
#include <mc/warp/sample_n.h>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace bindings {

/// A function of rows of numbers; `held` is the object that it belongs to.
using RowFunction = void(const void* held, std::size_t count, const double* in, double* out);

/// A warp of any type over double. Every Python class of a warp derives from it.
struct AnyWarp {
  std::string name; ///< as Python writes it, "Tent(center=0, radius=1)"
  BoundDomain domain;
  std::shared_ptr<const void> held;
  RowFunction* sample;
  RowFunction* pdf;
  RowFunction* invert; ///< null without an inverse
  mc::PerAxis<std::vector<double>> breaks = {};

  std::size_t uniforms() const { return static_cast<std::size_t>(domain.any.dim); }
  std::size_t coordinates() const { return static_cast<std::size_t>(domain.any.point_size); }
};

/// The warp for the checks of libmc, without an oracle.
mc::AnyDistribution to_distribution(const AnyWarp& warp);

namespace detail {

template <class P> constexpr std::size_t columns_of = std::size_t(mc::detail::point_size<P>());

template <class P> P point_at(const double* row) {
  if constexpr (columns_of<P> == 1) {
    return *row;
  } else {
    P p;
    for (std::size_t k = 0; k < columns_of<P>; ++k) p[Eigen::Index(k)] = row[k];
    return p;
  }
}
template <class P> void put_point(double* row, const P& p) {
  if constexpr (columns_of<P> == 1) *row = p;
  else
    for (std::size_t k = 0; k < columns_of<P>; ++k) row[k] = p[Eigen::Index(k)];
}

// Rows are mapped in blocks. The results of a block are local: they cannot alias the warp, so that the loops vectorize.
// The loops are functions of their own, which the compiler can optimize as it does in C++ programs. A few rows, as of a
// part of another warp, are mapped one by one.
constexpr std::size_t block_size = 64, few = 4;

template <class Map> void for_blocks(std::size_t count, const Map& map) {
  for (std::size_t first = 0; first < count; first += block_size) map(first, std::min(block_size, count - first));
}

template <class W>
[[gnu::noinline]] void sample_columns(const W& warp, const mc::UnitColumns<W>& u, const mc::PointColumns<W>& x) {
  mc::sample_n(warp, u, x);
}

template <class W> void sample_rows(const void* held, std::size_t count, const double* u, double* x) {
  constexpr std::size_t from = columns_of<mc::UnitPointOf<W>>, to = columns_of<mc::PointOf<W>>;
  const W& warp = *static_cast<const W*>(held);
  if (count < few) {
    for (std::size_t i = 0; i < count; ++i)
      put_point<mc::PointOf<W>>(x + i * to, warp.sample(point_at<mc::UnitPointOf<W>>(u + i * from)));
    return;
  }
  if constexpr (from == 1 && to == 1) {
    sample_columns<W>(warp, {std::span(u, count)}, {std::span(x, count)});
    return;
  }
  for_blocks(count, [&](std::size_t first, std::size_t n) {
    std::array<std::array<double, block_size>, from> in;
    std::array<std::array<double, block_size>, to> out;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < from; ++k) in[k][i] = u[(first + i) * from + k];
    mc::UnitColumns<W> columns;
    mc::PointColumns<W> results;
    for (std::size_t k = 0; k < from; ++k) columns[k] = std::span(in[k]).first(n);
    for (std::size_t k = 0; k < to; ++k) results[k] = std::span(out[k]).first(n);
    sample_columns(warp, columns, results);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < to; ++k) x[(first + i) * to + k] = out[k][i];
  });
}

template <class W> [[gnu::noinline]] void pdf_block(const W& warp, std::size_t n, const double* x, double* density) {
  using P = mc::PointOf<W>;
  std::array<double, block_size> out;
  for (std::size_t i = 0; i < n; ++i) out[i] = warp.pdf(point_at<P>(x + i * columns_of<P>));
  std::copy_n(out.data(), n, density);
}

template <class W> void pdf_rows(const void* held, std::size_t count, const double* x, double* density) {
  using P = mc::PointOf<W>;
  const W& warp = *static_cast<const W*>(held);
  if (count < few) {
    for (std::size_t i = 0; i < count; ++i) density[i] = warp.pdf(point_at<P>(x + i * columns_of<P>));
    return;
  }
  for_blocks(count,
             [&](std::size_t first, std::size_t n) { pdf_block(warp, n, x + first * columns_of<P>, density + first); });
}

[[noreturn]] void refuse_outside(const double* x, std::size_t columns, std::size_t index);

// The index of the first point outside of a domain, or n.
template <class Domain>
[[gnu::noinline]] std::size_t first_outside(const Domain& domain, std::size_t n, const double* x) {
  using P = typename Domain::Point;
  std::uint64_t inside = 0; // as wide as the numbers, so that the loop vectorizes
  for (std::size_t i = 0; i < n; ++i) inside += domain.contains(point_at<P>(x + i * columns_of<P>));
  if (inside == n) return n;
  std::size_t i = 0;
  while (i < n && domain.contains(point_at<P>(x + i * columns_of<P>))) ++i;
  return i;
}

template <class W> [[gnu::noinline]] void invert_block(const W& warp, std::size_t n, const double* x, double* u) {
  using P = mc::PointOf<W>;
  using U = mc::UnitPointOf<W>;
  std::array<double, block_size * columns_of<U>> out;
  for (std::size_t i = 0; i < n; ++i)
    put_point<U>(out.data() + i * columns_of<U>, warp.invert(point_at<P>(x + i * columns_of<P>)));
  std::copy_n(out.data(), n * columns_of<U>, u);
}

template <class W> void invert_rows(const void* held, std::size_t count, const double* x, double* u) {
  using P = mc::PointOf<W>;
  using U = mc::UnitPointOf<W>;
  const W& warp = *static_cast<const W*>(held);
  const typename W::Domain domain = warp.domain();
  if (count < few) {
    for (std::size_t i = 0; i < count; ++i) {
      const P p = point_at<P>(x + i * columns_of<P>);
      if (!domain.contains(p)) refuse_outside(x + i * columns_of<P>, columns_of<P>, i);
      put_point<U>(u + i * columns_of<U>, warp.invert(p));
    }
    return;
  }
  for_blocks(count, [&](std::size_t first, std::size_t n) {
    const double* in = x + first * columns_of<P>;
    if (const std::size_t i = first_outside(domain, n, in); i < n)
      refuse_outside(in + i * columns_of<P>, columns_of<P>, first + i);
    invert_block(warp, n, in, u + first * columns_of<U>);
  });
}

} // namespace detail

/// Removes the type of a warp over double.
template <mc::Warp W> AnyWarp any_warp(std::string name, const W& warp) {
  AnyWarp any{std::move(name),        bind_domain(warp.domain()), std::make_shared<const W>(warp),
              detail::sample_rows<W>, detail::pdf_rows<W>,        nullptr};
  if constexpr (mc::InvertibleWarp<W>) any.invert = detail::invert_rows<W>;
  if constexpr (requires { warp.breaks(); }) {
    std::size_t axis = 0;
    for (std::vector<double>& places : warp.breaks()) any.breaks[axis++] = std::move(places);
  }
  return any;
}

/// The C++ type behind a Python class of warps. `W` only tells the classes apart where they hold several types.
template <class W> struct BoundWarp : AnyWarp {
  explicit BoundWarp(AnyWarp any) : AnyWarp(std::move(any)) {}
  /// The warp of type W. Only for classes that hold no other type.
  const W& get() const { return *static_cast<const W*>(held.get()); }
};

/// A warp as a part of another: its type is removed, its dimensions are not.
template <int Dim, int Size> struct PartDomain {
  using Scalar = double;
  using Point = mc::Point<double, Size>;
  using UnitPoint = mc::Point<double, Dim>;
  static constexpr int dim = Dim;
  static constexpr mc::Measure measure = Dim == 1 ? mc::Measure::length : mc::Measure::volume;
  std::shared_ptr<const mc::AnyDomain> any;

  Point from_unit(const UnitPoint& v) const {
    return mc::detail::to_point<Point>(any->from_unit(mc::detail::to_array<double, mc::max_chart_dim>(v)).x);
  }
  UnitPoint to_unit(const Point& x) const {
    return mc::detail::to_point<UnitPoint>(any->to_unit(mc::detail::to_array<double>(x)));
  }
  double jacobian(const UnitPoint& v) const {
    return any->jacobian(mc::detail::to_array<double, mc::max_chart_dim>(v));
  }
  bool contains(const Point& x) const { return any->contains(mc::detail::to_array<double>(x)); }
  template <mc::Real T> PartDomain cast() const { return *this; }
};
/// The axes of the domain.
template <int Dim, int Size> std::vector<mc::Axis> chart_axes(const PartDomain<Dim, Size>& d) { return d.any->axes; }
/// Its text is that of the whole.
template <int Dim, int Size> std::string domain_text(const PartDomain<Dim, Size>&) { return ""; }

/// See PartDomain.
template <int Dim, int Size> struct PartWarp {
  using Scalar = double;
  using Domain = PartDomain<Dim, Size>;
  std::shared_ptr<const AnyWarp> any;
  std::shared_ptr<const mc::AnyDomain> on;

  explicit PartWarp(const AnyWarp& warp)
      : any(std::make_shared<const AnyWarp>(warp)), on(std::make_shared<const mc::AnyDomain>(warp.domain.any)) {}

  Domain domain() const { return {on}; }
  typename Domain::Point sample(const typename Domain::UnitPoint& u) const {
    return map<typename Domain::Point>(any->sample, u);
  }
  double pdf(const typename Domain::Point& x) const { return map<double>(any->pdf, x); }
  template <mc::Real T> PartWarp cast() const { return *this; }

 private:
  template <class To, class From> To map(RowFunction* f, const From& from) const {
    std::array<double, 4> in, out;
    detail::put_point<From>(in.data(), from);
    f(any->held.get(), 1, in.data(), out.data());
    return detail::point_at<To>(out.data());
  }
};

/// A PartWarp with an inverse.
template <int Dim, int Size> struct InvertiblePart : PartWarp<Dim, Size> {
  using Domain = typename PartWarp<Dim, Size>::Domain;
  using PartWarp<Dim, Size>::PartWarp;
  typename Domain::UnitPoint invert(const typename Domain::Point& x) const {
    std::array<double, 4> in, out;
    detail::put_point<typename Domain::Point>(in.data(), x);
    this->any->invert(this->any->held.get(), 1, in.data(), out.data());
    return detail::point_at<typename Domain::UnitPoint>(out.data());
  }
  template <mc::Real T> InvertiblePart cast() const { return *this; }
};

/// The Python class of a warp, with the contract of `name` and the shapes as its docstring.
template <class W> py::class_<BoundWarp<W>, AnyWarp> warp_class(py::module_& m, const char* name) {
  return py::class_<BoundWarp<W>, AnyWarp>(m, name, contract(name).c_str());
}

/// A warp for Python; its name is the format with the arguments, such as "Tent(center={:g}, radius={:g})".
template <class W, class... Args> auto make_warp(const char* format, const W& warp, Args&&... args) {
  return BoundWarp<W>(any_warp(fmt::format(fmt::runtime(format), args...), warp));
}

/// Adds the classes of a family to libmc.warps.
void bind_intervals(py::module_& m);
void bind_planes(py::module_& m);
void bind_directions(py::module_& m);
void bind_lobes(py::module_& m);
void bind_tables(py::module_& m);

} // namespace bindings

#include "warp.h"

#include <mc/table/alias_table.h>
#include <mc/table/discrete.h>
#include <mc/table/table_dist_1d.h>
#include <mc/table/table_dist_2d.h>
#include <mc/table/table_dist_tree.h>

#include <algorithm>
#include <cmath>

namespace bindings {

namespace {

using py::arg;

template <mc::DiscreteDistribution D> py::tuple sample_index(const D& d, const ArrayLike& u) {
  const Rows rows = to_rows(u, 1, "sample_index: u");
  require_unit(rows, "sample_index: u");
  py::array_t<std::int64_t> index(rows.outer);
  Array pmf = new_rows(rows.outer, 1), remapped = new_rows(rows.outer, 1);
  for (std::size_t i = 0; i < rows.count; ++i) {
    const mc::DiscreteSample<double> s = d.sample_index(rows.values()[i]);
    index.mutable_data()[i] = static_cast<std::int64_t>(s.index);
    pmf.mutable_data()[i] = s.pmf;
    remapped.mutable_data()[i] = s.u_remapped;
  }
  return py::make_tuple(index, pmf, remapped);
}

template <mc::DiscreteDistribution D> Array pmf(const D& d, const ArrayLike& index) {
  const Rows rows = to_rows(index, 1, "pmf: index");
  Array p = new_rows(rows.outer, 1);
  for (std::size_t i = 0; i < rows.count; ++i) {
    const double at = rows.values()[i];
    mc::require(at >= 0 && at < static_cast<double>(d.size()) && at == std::floor(at),
                "pmf: outcome {}; there are outcomes 0 to {}", at, d.size() - 1);
    p.mutable_data()[i] = d.pmf(static_cast<std::size_t>(at));
  }
  return p;
}

constexpr const char* sample_index_doc =
    "Outcomes for uniform numbers: u (...) in [0,1) -> (index, pmf, u_remapped), each (...). u_remapped is uniform "
    "again and independent of the index: use it for the next decision.";
constexpr const char* pmf_doc = "Probability of outcomes: index (...) -> (...).";

template <mc::DiscreteDistribution D, class Init>
void bind_discrete(py::module_& m, const char* name, Init init, const char* argument) {
  py::class_<D>(m, name, contract(name).c_str())
      .def(py::init(init), arg(argument))
      .def("sample_index", &sample_index<D>, arg("u"), sample_index_doc)
      .def("pmf", &pmf<D>, arg("index"), pmf_doc)
      .def("__len__", &D::size)
      .def("__repr__", [name](const D& d) { return fmt::format("<libmc.warps.{}: {} outcomes>", name, d.size()); });
}

using Table1D = mc::TableDist1D<double>;
using Table2D = mc::TableDist2D<double>;
using ShortDiscrete = mc::ShortDiscrete<double, 64>;

BoundWarp<Table1D> bound(const Table1D& table) {
  return BoundWarp<Table1D>(any_warp(
      fmt::format("<TableDist1D: {} cells on [{:g}, {:g}]>", table.size(), table.domain().lo, table.domain().hi),
      table));
}
BoundWarp<Table2D> bound(const Table2D& table) {
  return BoundWarp<Table2D>(
      any_warp(fmt::format("<TableDist2D: {} x {} cells>", table.width(), table.height()), table));
}

// Weights of shape (height, width).
template <class Make> BoundWarp<Table2D> from_image(const ArrayLike& weights, Make make) {
  const Array image = to_array(weights, "TableDist2D: weights");
  mc::require(image.ndim() == 2, "TableDist2D: weights of shape {}; the shape must be (height, width)",
              shape_text(image));
  return bound(
      make(span_of(image), static_cast<std::size_t>(image.shape(1)), static_cast<std::size_t>(image.shape(0))));
}

struct TableTree {};

template <int N> AnyWarp tree_of(mc::BoxTree tree) {
  const std::size_t leaves = tree.leaves();
  return any_warp(fmt::format("<TableDistTree: {} boxes in {} dimensions>", leaves, N),
                  mc::TableDistTree<double, N>(std::move(tree)));
}

BoundWarp<TableTree> tree_warp(mc::BoxTree tree) {
  mc::require(tree.dim() == 2 || tree.dim() == 3, "TableDistTree: {} dimensions; 2 or 3 are supported", tree.dim());
  return BoundWarp<TableTree>(tree.dim() == 2 ? tree_of<2>(std::move(tree)) : tree_of<3>(std::move(tree)));
}

BoundWarp<TableTree> tree_from_nodes(int dim, const std::vector<std::pair<int, double>>& nodes) {
  std::vector<mc::BoxTreeNode> tree;
  for (const auto& [axis, value] : nodes)
    tree.push_back({axis < 0 ? mc::BoxTreeNode::leaf : static_cast<std::uint32_t>(axis), value});
  return tree_warp(mc::BoxTree(dim, tree));
}

BoundWarp<TableTree> tree_from_function(const py::function& f, int dim, std::size_t leaves) {
  const auto value = [&](std::span<const double> x) {
    const Array values = to_array(f(new_array(x)), "TableDistTree: f returned");
    mc::require(values.size() == 1, "TableDistTree: f returned an array of shape {}; one number is needed",
                shape_text(values));
    return *values.data();
  };
  return tree_warp(mc::BoxTree::from_function(dim, value, leaves));
}

} // namespace

void bind_tables(py::module_& m) {
  bind_discrete<mc::AliasTable>(
      m, "AliasTable",
      [](const ArrayLike& weights) { return mc::AliasTable(span_of(to_array(weights, "AliasTable: weights"))); },
      "weights");
  bind_discrete<mc::UniformDiscrete<double>>(
      m, "UniformDiscrete", [](std::size_t n) { return mc::UniformDiscrete<double>(n); }, "n");
  bind_discrete<mc::Bernoulli<double>>(
      m, "Bernoulli", [](double p) { return mc::Bernoulli<double>(p); }, "p");
  bind_discrete<ShortDiscrete>(
      m, "ShortDiscrete",
      [](const ArrayLike& weights) { return ShortDiscrete(span_of(to_array(weights, "ShortDiscrete: weights"))); },
      "weights");

  warp_class<Table1D>(m, "TableDist1D")
      .def(py::init([](const ArrayLike& weights, double lo, double hi) {
             const Array w = to_array(weights, "TableDist1D: weights");
             return bound(Table1D(span_of(w), mc::Interval<double>(lo, hi)));
           }),
           arg("weights"), arg("lo") = 0.0, arg("hi") = 1.0)
      .def(
          "sample_index", [](const BoundWarp<Table1D>& t, const ArrayLike& u) { return sample_index(t.get(), u); },
          arg("u"), sample_index_doc)
      .def(
          "pmf", [](const BoundWarp<Table1D>& t, const ArrayLike& i) { return pmf(t.get(), i); }, arg("index"), pmf_doc)
      .def("__len__", [](const BoundWarp<Table1D>& t) { return t.get().size(); });

  warp_class<Table2D>(m, "TableDist2D")
      .def(py::init(
               [](const ArrayLike& weights) { return from_image(weights, [](auto... w) { return Table2D(w...); }); }),
           arg("weights"), "Weights of shape (height, width); row 0 is at y = 0.")
      .def_static(
          "from_lat_long",
          [](const ArrayLike& weights) {
            return from_image(weights, [](auto... w) { return Table2D::from_lat_long(w...); });
          },
          arg("weights"),
          "For a latitude-longitude image of shape (height, width): weights are multiplied by the solid angle of the "
          "row.");

  py::class_<BoundWarp<TableTree>, AnyWarp>(m, "TableDistTree", contract("TableDistTree").c_str())
      .def(py::init(&tree_from_nodes), arg("dim"), arg("nodes"),
           "Nodes in preorder: (axis, place) cuts, (-1, weight) is a leaf. dim is 2 or 3.")
      .def_static("from_function", &tree_from_function, arg("f"), arg("dim"), arg("leaves"),
                  "Partition into at most `leaves` boxes adapted to f, which takes an array of shape (dim,).");
}

} // namespace bindings

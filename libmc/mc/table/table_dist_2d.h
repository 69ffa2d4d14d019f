#pragma once
/// A piecewise constant distribution on the unit square.

#include <mc/core/sum.h>
#include <mc/domain/box.h>
#include <mc/table/table_dist_1d.h>

namespace mc {

/// Conditional distributions of the column for each row: the arrays of one CdfView per row, concatenated.
struct ConditionalRows {
  std::vector<double> cumulative;   ///< Cumulative probabilities, CdfView::ends(width) per row.
  std::vector<std::uint32_t> guide; ///< Guide entries, CdfView::cells(width) + 1 per row.
  std::size_t width;                ///< Number of columns.
};

/// width x height cells on the unit square, in row order (row 0 at y = 0). A cell is chosen with probability
/// proportional to its weight; points are uniform within.
///   sample : u1 selects the row, u0 the column in it. Points stay in their cell as in TableDist1D: in float for up to
///            2^20 rows and columns.
///   pdf    : pmf(row) pmf(column | row) width height [1/area]; 0 outside and in cells of weight 0.
///   invert : |invert(sample(u)) - u| <= 4 eps + 2 ulp times the density of the row, or of the column within it. Holds
///            for points that round to their own cell.
///   throws : Error unless weights are width * height numbers, finite, >= 0, not all 0.
///   Source : inverse transform sampling of the marginal and the conditionals, [PharrJakobHumphreys23] section A.5.6.
template <Real S> class TableDist2D {
 public:
  using Scalar = S;
  using Domain = Square<S>;

  /// A distribution over width x height cells; weights are in row order.
  TableDist2D(std::span<const double> weights, std::size_t width, std::size_t height)
      : TableDist2D(make_rows(weights, width, height)) {}

  /// Distribution with weights f(x, y) at the centres of the cells.
  template <class F> static TableDist2D from_function(F&& f, std::size_t width, std::size_t height) {
    std::vector<double> weights;
    weights.reserve(width * height);
    for (std::size_t y = 0; y < height; ++y)
      for (std::size_t x = 0; x < width; ++x)
        weights.push_back(static_cast<double>(f((static_cast<double>(x) + 0.5) / static_cast<double>(width),
                                                (static_cast<double>(y) + 0.5) / static_cast<double>(height))));
    return TableDist2D(weights, width, height);
  }

  /// Distribution for a latitude-longitude image. Row y spans theta in [pi y / height, pi (y + 1) / height]; its
  /// weights are multiplied by the solid angle of the row, cos(theta_0) - cos(theta_1).
  static TableDist2D from_lat_long(std::span<const double> weights, std::size_t width, std::size_t height) {
    const double largest = largest_of(weights, width, height), h = static_cast<double>(height);
    std::vector<double> scaled;
    scaled.reserve(weights.size());
    for (std::size_t y = 0; y < height; ++y) {
      const double angle =
          2 * std::sin(pi<double> * (static_cast<double>(y) + 0.5) / h) * std::sin(pi<double> / (2 * h));
      for (std::size_t x = 0; x < width; ++x) scaled.push_back(weights[y * width + x] / largest * angle);
    }
    return TableDist2D(scaled, width, height);
  }

  /// Number of columns.
  std::size_t width() const { return rows_.width; }
  /// Number of rows.
  std::size_t height() const { return row_choice_.size(); }
  /// Probability of the cell at column x, row y.
  S pmf(std::size_t x, std::size_t y) const {
    return row_choice_.pmf(y) == 0 ? S(0) : S(row_choice_.pmf(y)) * S(row(y).cdf.pmf(x));
  }

  /// A sampled cell.
  struct CellSample {
    std::size_t x,      ///< Column.
        y;              ///< Row.
    S pmf;              ///< Probability of the cell, > 0.
    Vec2<S> u_remapped; ///< Uniform in [0,1)^2 and independent of the cell.
  };
  /// Selects a cell with u.
  CellSample sample_index(const Vec2<S>& u) const {
    const std::size_t y = rows().find(u[1]);
    const auto columns = row(y);
    const std::size_t x = columns.find(u[0]);
    return {x, y, pmf(x, y), {columns.remapped(u[0], x), rows().remapped(u[1], y)}};
  }

  Domain domain() const { return {}; }
  Vec2<S> sample(const Vec2<S>& u) const {
    const std::size_t y = rows().find(u[1]);
    const auto columns = row(y);
    return {columns.point(u[0], columns.find(u[0])), rows().point(u[1], y)};
  }
  S pdf(const Vec2<S>& p) const {
    if (!domain().contains(p)) return S(0);
    const std::size_t y = rows().cell(p[1]);
    const auto columns = row(y);
    const S marginal = rows().density(y);
    return marginal == 0 ? S(0) : S(marginal * columns.density(columns.cell(p[0])));
  }
  Vec2<S> invert(const Vec2<S>& p) const { return {row(rows().cell(p[1])).invert(p[0]), rows().invert(p[1])}; }
  /// Places where the density may jump along x and y.
  std::array<std::vector<double>, 2> breaks() const { return {even_breaks(width()), even_breaks(height())}; }
  template <Real T> TableDist2D<T> cast() const { return TableDist2D<T>(rows_, row_choice_); }

 private:
  template <Real T> friend class TableDist2D;
  using Rows = ConditionalRows;
  struct RowsWithSums {
    Rows rows;
    std::vector<double> sums;
  };

  // The largest weight. Checks the number and the values of all weights.
  static double largest_of(std::span<const double> weights, std::size_t width, std::size_t height) {
    require(width > 0 && height > 0 && weights.size() == width * height,
            "TableDist2D: {} weights for {}x{} cells; {} are needed", weights.size(), width, height, width * height);
    double largest = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      require(std::isfinite(weights[i]) && weights[i] >= 0,
              "TableDist2D: weights[{}] = {} (column {}, row {}) is not finite and >= 0", i, weights[i], i % width,
              i / width);
      largest = std::max(largest, weights[i]);
    }
    require(largest > 0, "TableDist2D: all {} weights are 0; at least one must be > 0", weights.size());
    return largest;
  }

  static RowsWithSums make_rows(std::span<const double> weights, std::size_t width, std::size_t height) {
    const double largest = largest_of(weights, width, height);
    // Scales by a power of two near 1 / largest: row sums neither overflow nor fall below the denormals.
    int exponent;
    std::frexp(largest, &exponent);
    const std::size_t ends = CdfView::ends(width), guides = CdfView::cells(width) + 1;
    RowsWithSums result{{std::vector<double>(height * ends), std::vector<std::uint32_t>(height * guides), width}, {}};
    std::vector<double> row(width);
    for (std::size_t y = 0; y < height; ++y) {
      bool empty = true;
      for (std::size_t x = 0; x < width; ++x) empty &= weights[y * width + x] == 0;
      // A row of weight 0 is never selected; it gets a uniform placeholder.
      for (std::size_t x = 0; x < width; ++x) row[x] = empty ? 1 : weights[y * width + x];
      Cdf::fill(row, &result.rows.cumulative[y * ends], &result.rows.guide[y * guides]);
      CompensatedSum scaled;
      for (std::size_t x = 0; x < width && !empty; ++x) scaled.add(std::ldexp(weights[y * width + x], -exponent));
      result.sums.push_back(empty ? 0 : std::max(scaled.value(), std::numeric_limits<double>::denorm_min()));
    }
    return result;
  }
  explicit TableDist2D(RowsWithSums r) : rows_(std::move(r.rows)), row_choice_(std::span<const double>(r.sums)) {}
  TableDist2D(Rows rows, Cdf row_choice) : rows_(std::move(rows)), row_choice_(std::move(row_choice)) {}

  PiecewiseConstantView<S, UnitInterval> rows() const { return {row_choice_.view(), {}}; }
  PiecewiseConstantView<S, UnitInterval> row(std::size_t y) const {
    const std::size_t n = rows_.width;
    return {{&rows_.cumulative[y * CdfView::ends(n)], &rows_.guide[y * (CdfView::cells(n) + 1)],
             static_cast<std::uint32_t>(n)},
            {}};
  }

  Rows rows_;
  Cdf row_choice_;
};

} // namespace mc

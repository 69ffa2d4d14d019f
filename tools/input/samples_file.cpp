#include <input/check_rows.h>
#include <input/csv.h>
#include <input/row_shuffler.h>
#include <input/samples_density.h>
#include <input/samples_file.h>
#include <integrands/variable_bounds.h>

#include <render/io/image/image_io.h>

#include <mc/check/check_subject.h>
#include <mc/core/error.h>
#include <mc/core/memory.h>
#include <mc/core/sum.h>
#include <mc/core/turns.h>
#include <mc/random/uniform.h>
#include <mc/table/table_dist_1d.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

namespace carlo {

namespace {

using mc::Subject;
using mc::Vec2;

constexpr double unit_tolerance = 1e-5, mass_tolerance = 1e-4;
constexpr double digits = 1e-6; // precision to which programs print numbers of order 1

// The sphere as (azimuth, angle from +z), each scaled by its range, or a rectangle, mapped to the unit square of the
// grid.
struct GridDomain {
  bool sphere = false;
  std::vector<VariableBounds> sides;

  std::size_t columns() const { return sphere ? 3 : sides.size(); }

  std::optional<Vec2<double>> to_square(const double* x) const {
    if (sphere) {
      const double length = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
      if (!(std::abs(length - 1) <= unit_tolerance)) return {};
      return Vec2<double>(mc::azimuth_turns(x[0], x[1]), std::atan2(std::hypot(x[0], x[1]), x[2]) / mc::pi<double>);
    }
    Vec2<double> p(0, 0.5);
    for (std::size_t i = 0; i < sides.size(); ++i) {
      if (!(x[i] >= sides[i].lo && x[i] <= sides[i].hi)) return {};
      p[static_cast<Eigen::Index>(i)] = (x[i] - sides[i].lo) / (sides[i].hi - sides[i].lo);
    }
    return p;
  }
  std::string describe(const Vec2<double>& p) const {
    if (sphere) {
      const double phi = 2 * mc::pi<double> * p[0], theta = mc::pi<double> * p[1];
      return fmt::format("({:.6g}, {:.6g}, {:.6g})", std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                         std::cos(theta));
    }
    std::string text = "(";
    for (std::size_t i = 0; i < sides.size(); ++i)
      text += fmt::format("{}{:.6g}", i ? ", " : "",
                          sides[i].lo + (sides[i].hi - sides[i].lo) * p[static_cast<Eigen::Index>(i)]);
    return text + ")";
  }
  std::vector<mc::Axis> axes() const {
    if (sphere) return {{.name = "phi", .scale = mc::Axis::Scale::azimuth}, {.name = "theta [deg]", .b = 180}};
    std::vector<mc::Axis> named;
    for (const VariableBounds& s : sides) named.push_back({.name = s.name, .a = s.lo, .b = s.hi});
    return named;
  }
  // Measure of a cell in row j.
  double measure(std::size_t j, std::size_t width, std::size_t height) const {
    const double w = static_cast<double>(width), h = static_cast<double>(height);
    if (sphere)
      return 2 * mc::pi<double> / w * 2 * std::sin(mc::pi<double> * (static_cast<double>(j) + 0.5) / h) *
             std::sin(mc::pi<double> / (2 * h));
    double area = 1 / (w * h);
    for (const VariableBounds& s : sides) area *= s.hi - s.lo;
    return area;
  }
  std::string name() const {
    if (sphere) return fmt::format("the unit sphere (to {:g})", unit_tolerance);
    std::string text;
    for (const VariableBounds& s : sides)
      text += fmt::format("{}{} in [{:g}, {:g}]", text.empty() ? "" : ", ", s.name, s.lo, s.hi);
    return text;
  }
};

std::vector<VariableBounds> finite_sides(const std::string& box) {
  std::vector<VariableBounds> sides = parse_bounds(box);
  for (const VariableBounds& s : sides)
    mc::require(s.is_finite(), "--domain: '{}' has no end in '{}'; a grid needs one: give the density as --pdf", s.name,
                box);
  return sides;
}

GridDomain domain_of(const SamplesFileOptions& o, std::size_t columns) {
  GridDomain d;
  if (o.domain == "sphere" || (o.domain.empty() && columns == 3)) d.sphere = true;
  else if (!o.domain.empty() && o.domain.find('=') == std::string::npos)
    throw mc::Error(fmt::format("--domain: on '{}' the density is an expression: --pdf", o.domain));
  else if (!o.domain.empty()) d.sides = finite_sides(o.domain);
  else if (columns == 1) d.sides = {{"x", 0, 1}};
  else d.sides = {{"x", 0, 1}, {"y", 0, 1}};
  mc::require(d.columns() <= 3 && (d.sphere || d.sides.size() <= 2),
              "--domain: '{}' has {} variables; a grid has 1 or 2", o.domain, d.sides.size());
  mc::require(columns == d.columns(), "{}: {} columns; {} {} needed on {}", o.samples, columns, d.columns(),
              d.columns() == 1 ? "is" : "are", d.name());
  return d;
}

struct Grid {
  std::size_t width = 0, height = 0;
  std::vector<double> density;

  std::uint32_t cell(const Vec2<double>& p) const { // p lies in the unit square
    const auto index = [](double at, std::size_t n) {
      return std::min(static_cast<std::size_t>(at * static_cast<double>(n)), n - 1);
    };
    return static_cast<std::uint32_t>(index(p[1], height) * width + index(p[0], width));
  }
};

Grid read_grid(const std::string& file) {
  Grid g;
  if (!file.ends_with(".exr") && !file.ends_with(".pfm")) {
    const CsvTable table = read_csv(file);
    for (std::size_t i = 0; i < table.values.size(); ++i)
      mc::require(table.values[i] >= 0, "{}:{}: number {} is {}; a density is >= 0", file,
                  table.lines[i / table.columns], i % table.columns + 1, table.values[i]);
    return {table.columns, table.rows(), table.values};
  }
  const render::Image image = mc::with_context(file, [&] { return render::read_image(file); });
  g.width = static_cast<std::size_t>(image.width);
  g.height = static_cast<std::size_t>(image.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const auto& p = image.pixels[i];
    const double value = static_cast<double>(p[0]);
    const auto where = [&] {
      return fmt::format("{}: pixel ({}, {}) is ({:g}, {:g}, {:g})", file, i % g.width, i / g.width, p[0], p[1], p[2]);
    };
    if (!(value >= 0 && std::isfinite(value))) throw mc::Error(where() + "; a density is finite and >= 0");
    if (!(p[0] == p[1] && p[1] == p[2])) throw mc::Error(where() + "; a density is grey, R = G = B");
    g.density.push_back(value);
  }
  return g;
}

// Data of the two files that the subject's functions share.
struct SamplesFile {
  std::string file;
  CsvTable table;
  GridDomain domain;
  Grid grid;                        // the density on the unit square
  std::vector<std::uint32_t> cells; // one for each sample
};

std::shared_ptr<const SamplesFile> load(const SamplesFileOptions& o) {
  mc::require(!o.pdf.empty(), "validate: --samples-file needs a density to compare the samples with: --pdf-file or "
                              "--pdf");
  CsvTable table = read_csv(o.samples);
  mc::require(table.rows() >= 2000, "{}: {} samples; at least 2000 are needed", o.samples, table.rows());
  mc::require(table.rows() < std::uint64_t{1} << 32, "{}: {} samples; fewer than 2^32 fit", o.samples, table.rows());
  GridDomain domain = domain_of(o, table.columns);
  Grid grid = read_grid(o.pdf);
  mc::require(domain.columns() > 1 || grid.height == 1, "{}: {} rows; the density on an interval is one row", o.pdf,
              grid.height);
  mc::require(grid.density.size() < std::uint64_t{1} << 32, "{}: {} cells; fewer than 2^32 fit", o.pdf,
              grid.density.size());

  mc::CompensatedSum mass;
  for (std::size_t i = 0; i < grid.density.size(); ++i) {
    grid.density[i] *= domain.measure(i / grid.width, grid.width, grid.height);
    mass.add(grid.density[i]);
  }
  mc::require(mass.value() > 0 && std::isfinite(mass.value()),
              "{}: the density integrates to {}; some cell must be positive, and none beyond doubles", o.pdf,
              mass.value());

  const auto cell_of = [&](const double* x) -> std::optional<std::uint32_t> {
    const auto p = domain.to_square(x);
    return p ? std::optional(grid.cell(*p)) : std::nullopt;
  };
  std::vector<std::uint32_t> cells;
  cells.reserve(table.rows());
  std::size_t off = 0, first_off = 0;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const double* x = table.row(i);
    auto cell = cell_of(x);
    if (!cell && off++ == 0) first_off = i;
    // A sample that rounding of the last printed digit moved across an edge of the support is no leak.
    if (cell && grid.density[*cell] == 0)
      for (std::size_t k = 0; k < table.columns; ++k)
        for (const double sign : {-1.0, 1.0}) {
          std::array<double, 3> moved{};
          std::copy(x, x + table.columns, moved.begin());
          moved[k] += sign * digits * (domain.sphere ? 1 : domain.sides[k].hi - domain.sides[k].lo);
          if (const auto beside = cell_of(moved.data()); beside && grid.density[*beside] > 0) cell = beside;
        }
    cells.push_back(cell.value_or(0));
  }
  if (off > 0) {
    const double* x = table.row(first_off);
    std::string point;
    for (std::size_t k = 0; k < table.columns; ++k) point += fmt::format("{}{}", k ? ", " : "", x[k]);
    throw mc::Error(
        fmt::format("{}:{}: ({}) is not covered by the grid of {}, {}; {} of {} samples are not (see --domain)",
                    o.samples, table.lines[first_off], point, o.pdf, domain.name(), off, table.rows()));
  }
  const double volume = 1 / static_cast<double>(grid.density.size()), unit = o.unnormalized ? mass.value() : 1;
  for (double& weight : grid.density) weight /= unit * volume;
  return std::make_shared<const SamplesFile>(
      SamplesFile{o.samples, std::move(table), std::move(domain), std::move(grid), std::move(cells)});
}

// Only the cell of a sample counts; its position in the cell is drawn uniformly.
Subject subject_of(const std::shared_ptr<const SamplesFile>& f, const std::string& title, std::uint64_t seed) {
  Subject s;
  s.name = title;
  s.dim = f->domain.columns() == 1 ? 1 : 2;
  s.mass_tolerance = mass_tolerance;
  s.axes = f->domain.axes();
  s.breaks = {mc::even_breaks(f->grid.width), mc::even_breaks(f->grid.height)};
  const auto shuffler = std::make_shared<RowShuffler>(static_cast<std::uint32_t>(f->table.rows()), seed);
  s.draw = [f, shuffler, seed](std::uint64_t stream, std::size_t n, std::vector<Subject::Draw>& out) {
    const std::uint64_t first = shuffler->open(stream, n);
    for (std::size_t k = 0; k < n; ++k) {
      const std::uint32_t row = shuffler->row(first + k), cell = f->cells[row];
      const std::size_t i = cell % f->grid.width, j = cell / f->grid.width;
      const std::uint64_t bits = mc::hash(seed, row);
      Subject::Draw& d = out.emplace_back();
      d.density = f->grid.density[cell];
      d.pdf_positive = d.density > 0;
      d.v[0] = (static_cast<double>(i) + mc::uniform<double>(bits)) / static_cast<double>(f->grid.width);
      if (f->domain.columns() > 1)
        d.v[1] = (static_cast<double>(j) + mc::uniform<double>(mc::mix64(bits))) / static_cast<double>(f->grid.height);
    }
  };
  s.density = [f](const Subject::Coordinates& v) { return f->grid.density[f->grid.cell({v[0], v[1]})]; };
  s.describe_draw = [f, shuffler](std::uint64_t stream, std::uint64_t index) {
    const std::uint32_t row = shuffler->row(shuffler->open(stream, 0) + index), cell = f->cells[row];
    std::string point;
    for (std::size_t k = 0; k < f->table.columns; ++k)
      point += fmt::format("{}{}", k ? ", " : "", f->table.row(row)[k]);
    return fmt::format("{}:{}: ({}) in cell ({}, {}) of the grid", f->file, f->table.lines[row], point,
                       cell % f->grid.width, cell / f->grid.width);
  };
  s.describe_point = [f](const Subject::Coordinates& v) { return f->domain.describe({v[0], v[1]}); };
  return s;
}

// The samples on the unit square of the grid, in the order of the file.
OrderedSamples in_order(const SamplesFile& f) {
  OrderedSamples samples{{}, f.domain.axes(), f.domain.columns() == 1 ? 1 : 2};
  mc::require_memory(double(f.table.rows()) * sizeof(Subject::Coordinates), fmt::format("{}: its samples", f.file));
  samples.points.reserve(f.table.rows());
  for (std::size_t i = 0; i < f.table.rows(); ++i) {
    const auto p = f.domain.to_square(f.table.row(i));
    samples.points.push_back(p ? Subject::Coordinates{(*p)[0], (*p)[1], 0} : Subject::Coordinates{});
  }
  return samples;
}

} // namespace

SamplesFileCase samples_file_case(const SamplesFileOptions& options) {
  if (!options.density.empty() || options.domain.starts_with("discrete=")) return samples_density_case(options);
  const std::shared_ptr<const SamplesFile> file = load(options);
  SamplesFileCase c;
  c.one.name = options.samples;
  c.one.parameters = options.pdf;
  c.one.scalar = "double";
  c.one.rerun_arguments = fmt::format("--samples-file '{}' --pdf-file '{}'", options.samples, options.pdf);
  if (!options.domain.empty()) c.one.rerun_arguments += fmt::format(" --domain '{}'", options.domain);
  if (options.unnormalized) c.one.rerun_arguments += " --unnormalized";
  const std::uint64_t rows = file->table.rows();
  c.samples = rows - mc::pilot_samples(rows - rows / 9);
  if (options.dependent) c.one.rerun_arguments += " --dependent";
  c.one.check = [file, title = c.one.title(), dependent = options.dependent](const CaseOptions& o) {
    return check_rows(subject_of(file, title, o.seed), in_order(*file), dependent, o);
  };
  return c;
}

} // namespace carlo

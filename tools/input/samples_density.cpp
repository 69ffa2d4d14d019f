#include <input/check_rows.h>
#include <input/csv.h>
#include <input/parsed_domain.h>
#include <input/row_shuffler.h>
#include <input/samples_density.h>
#include <integrands/expression.h>

#include <mc/check/check_subject.h>
#include <mc/check/fit/expected/cubature.h>
#include <mc/core/error.h>
#include <mc/core/sum.h>
#include <mc/random/hash.h>
#include <mc/random/uniform.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

namespace carlo {

namespace {

using mc::Subject;
using Density = std::function<double(std::span<const double>)>;

// Data shared by the subject's functions.
struct Samples {
  std::string file;
  CsvTable table;
  ParsedDomain domain;
  ParsedDomain strict; ///< the domain without tolerance for rounding
  Density density;
  double mass_tolerance = 1e-12;
  Breaks breaks = {};

  std::size_t columns() const { return table.columns; }

  // The row, with each number moved within its last digit so that the point lies in the domain. A number printed at an
  // edge came from the inside. Returns the row itself if no attempt hits the domain.
  std::vector<double> point(std::uint32_t row, std::uint64_t seed) const {
    std::vector<double> x(table.row(row), table.row(row) + columns());
    if (domain.outcomes > 0) return x;
    for (const std::uint64_t by : {seed, usual})
      for (std::uint64_t attempt = 0; attempt < 256; ++attempt) {
        std::vector<double> moved = x;
        for (std::size_t k = 0; k < columns(); ++k) moved[k] += shift(row, k, mc::hash(by, row, k, attempt));
        if (is_flat() ? strict.contains(moved.data()) : domain.contains(moved.data())) return moved;
      }
    return x;
  }
  // Whether the row or a moved point lies in the domain.
  bool is_inside(std::uint32_t row) const {
    return domain.contains(table.row(row)) || domain.contains(point(row, usual).data());
  }
  std::string text(std::uint32_t row) const {
    std::string all;
    for (std::size_t k = 0; k < columns(); ++k) all += fmt::format("{}{}", k ? ", " : "", table.row(row)[k]);
    return fmt::format("{}:{}: ({})", file, table.lines[row], all);
  }

 private:
  static constexpr std::uint64_t usual = 0;

  // Whether the domain has as many dimensions as columns. A point of a sphere leaves the sphere when its numbers move.
  bool is_flat() const { return static_cast<std::size_t>(domain.chart.dim) == columns(); }

  // A uniform offset within the numbers that print like this one.
  double shift(std::uint32_t row, std::size_t column, std::uint64_t hash) const {
    const std::size_t place = row * columns() + column;
    const double above = std::pow(10.0, table.digits[place]) / 2, below = std::pow(10.0, table.digits_below[place]) / 2;
    return std::copysign(1.0, table.values[place]) * (mc::uniform<double>(hash) * (above + below) - below);
  }
};

std::array<double, 3> quartiles(const CsvTable& table, std::size_t column) {
  mc::require(column < table.columns, "it has more columns than the samples, which have {}", table.columns);
  std::vector<double> values;
  for (std::size_t i = 0; i < table.rows(); ++i) values.push_back(table.row(i)[column]);
  return quartiles_of(std::move(values));
}

std::string default_domain(std::size_t columns) {
  if (columns == 1) return "x=0:1";
  return columns == 2 ? "x=0:1,y=0:1" : "sphere";
}

double checked(double value, const std::string& where, const std::string& what = "--pdf") {
  mc::require(value >= 0 && std::isfinite(value), "{} is {} at {}; a density is finite and >= 0", what, value, where);
  return value;
}

// The probabilities of the outcomes: from an expression or from a file.
std::vector<double> probabilities(const SamplesFileOptions& o, int outcomes) {
  std::vector<double> p;
  if (!o.pdf.empty()) {
    p = read_csv(o.pdf).values;
    mc::require(p.size() == static_cast<std::size_t>(outcomes), "{}: {} numbers; {} outcomes are named", o.pdf,
                p.size(), outcomes);
  } else {
    mc::require(!o.density.empty(), "validate: --samples-file needs the probabilities: --pdf-file or --pdf");
    const Density f = parse_function(o.density, {"i"});
    for (int i = 0; i < outcomes; ++i) {
      const double outcome = i;
      p.push_back(f(std::span(&outcome, 1)));
    }
  }
  mc::CompensatedSum sum;
  for (std::size_t i = 0; i < p.size(); ++i)
    sum.add(checked(p[i], fmt::format("outcome {}", i), o.pdf.empty() ? "--pdf" : o.pdf));
  mc::require(sum.value() > 0, "the probabilities are all 0");
  if (o.unnormalized)
    for (double& one : p) one /= sum.value();
  return p;
}

// The numbers of a point, one for each column.
std::span<const double> numbers(const ParsedDomain& domain, const mc::PointArray& x) {
  return std::span(x).first(domain.columns.size());
}

// The integral of an unnormalised density and its relative error. The tolerance of the cubature is absolute, so the
// density is divided by its integral until the quotient is of order 1.
std::pair<double, double> total(const ParsedDomain& domain, const Density& density) {
  double scale = 1;
  const auto f = [&](const mc::AnyDomain::Coordinates& v) {
    const mc::AnyDomain::DomainPoint at = domain.chart.from_unit(v);
    const double value = density(numbers(domain, at.x)) / scale * at.jacobian;
    return std::isfinite(value) ? value : 0.0; // 0 at the ends of infinite intervals
  };
  mc::CubatureResult r = mc::integrate_boxes(f, domain.chart.dim, {mc::UnitBox()});
  mc::require(r.total.value > 0, "--pdf: the expression was 0 at every point that was evaluated");
  for (int round = 0; round < 8 && (r.total.value < 0.5 || r.total.value > 2); ++round) {
    scale *= r.total.value;
    r = mc::integrate_boxes(f, domain.chart.dim, {mc::UnitBox()});
    mc::require(r.total.value > 0 && std::isfinite(scale), "--pdf: its integral, about {:g}, is beyond doubles", scale);
  }
  mc::require(r.total.error <= 1e-3 * r.total.value,
              "--pdf: its integral is {:.6g} to within {:.2g} only; give a density that integrates to 1 instead of "
              "--unnormalized",
              r.total.value * scale, r.total.error * scale);
  return {r.total.value * scale, r.total.error / r.total.value};
}

std::shared_ptr<const Samples> load(const SamplesFileOptions& o) {
  CsvTable table = read_csv(o.samples);
  mc::require(table.rows() >= 2000, "{}: {} samples; at least 2000 are needed", o.samples, table.rows());
  mc::require(table.rows() < std::uint64_t{1} << 32, "{}: {} samples; fewer than 2^32 fit", o.samples, table.rows());
  const std::string text = o.domain.empty() ? default_domain(table.columns) : o.domain;
  const auto quartiles_in = [&](std::size_t column) { return quartiles(table, column); };
  ParsedDomain domain = mc::with_context("--domain", [&] { return parse_domain(text, quartiles_in); });
  const std::vector<std::string> names = domain.columns;
  mc::require(names.size() == table.columns, "{}: {} columns; {} {} needed on {}", o.samples, table.columns,
              names.size(), names.size() == 1 ? "is" : "are", domain.text);
  ParsedDomain strict = parse_domain(text, quartiles_in, Rounding::doubles);
  Samples s{o.samples, std::move(table), std::move(domain), std::move(strict), {}};
  std::uint32_t off = 0, first_off = 0;
  for (auto i = static_cast<std::uint32_t>(s.table.rows()); i-- > 0;)
    if (!s.is_inside(i)) {
      ++off;
      first_off = i;
    }
  mc::require(off == 0, "{} is not in {}; {} of {} samples are not (see --domain)", s.text(first_off), s.domain.text,
              off, s.table.rows());
  if (s.domain.outcomes > 0) return std::make_shared<const Samples>(std::move(s));
  for (const std::string& name : names) mc::with_context("--domain", [&] { require_variable_name(name); });
  s.density = parse_function(o.density, names);
  s.breaks = parse_breaks(o.breaks, s.domain.chart);
  if (o.unnormalized) {
    const auto [mass, error] = total(s.domain, s.density);
    s.density = [f = s.density, mass = mass](std::span<const double> x) { return f(x) / mass; };
    s.mass_tolerance = std::max(1e-12, 2 * error);
  }
  return std::make_shared<const Samples>(std::move(s));
}

Subject discrete_subject(const std::shared_ptr<const Samples>& f, const std::vector<double>& probabilities,
                         std::uint64_t seed) {
  Subject s;
  s.mass_tolerance = 1e-4; // tolerance for printed probabilities
  s.atoms = probabilities;
  const auto shuffler = std::make_shared<RowShuffler>(static_cast<std::uint32_t>(f->table.rows()), seed);
  s.draw = [f, shuffler, probabilities](std::uint64_t stream, std::size_t n, std::vector<Subject::Draw>& out) {
    const std::uint64_t first = shuffler->open(stream, n);
    for (std::size_t k = 0; k < n; ++k) {
      Subject::Draw& d = out.emplace_back();
      d.kind = Subject::Draw::Kind::atom;
      d.atom = static_cast<int>(f->table.row(shuffler->row(first + k))[0]);
      d.pdf_positive = probabilities[static_cast<std::size_t>(d.atom)] > 0;
    }
  };
  s.describe_draw = [f, shuffler](std::uint64_t stream, std::uint64_t index) {
    return f->text(shuffler->row(shuffler->open(stream, 0) + index));
  };
  return s;
}

Subject continuous_subject(const std::shared_ptr<const Samples>& f, std::uint64_t seed) {
  Subject s;
  s.dim = f->domain.chart.dim;
  s.axes = f->domain.chart.axes;
  s.mass_tolerance = f->mass_tolerance;
  s.breaks = f->breaks;
  const auto shuffler = std::make_shared<RowShuffler>(static_cast<std::uint32_t>(f->table.rows()), seed);
  s.draw = [f, shuffler, seed](std::uint64_t stream, std::size_t n, std::vector<Subject::Draw>& out) {
    const std::uint64_t first = shuffler->open(stream, n);
    for (std::size_t k = 0; k < n; ++k) {
      const std::vector<double> x = f->point(shuffler->row(first + k), seed);
      const double density = f->density(x);
      Subject::Draw& d = out.emplace_back();
      d.pdf_positive = density > 0 && std::isfinite(density);
      mc::PointArray point{};
      std::copy(x.begin(), x.end(), point.begin());
      d.v = f->domain.chart.to_unit(point);
      d.density = density * f->domain.chart.jacobian(d.v);
    }
  };
  s.density = [f](const Subject::Coordinates& v) {
    const mc::AnyDomain::DomainPoint at = f->domain.chart.from_unit(v);
    return f->density(numbers(f->domain, at.x)) * at.jacobian;
  };
  s.resolution = [f, epsilon = s.epsilon](const Subject::Coordinates& v, int axis) {
    return mc::resolution(f->strict.chart, epsilon, v, static_cast<std::size_t>(axis));
  };
  s.describe_draw = [f, shuffler](std::uint64_t stream, std::uint64_t index) {
    const std::uint32_t row = shuffler->row(shuffler->open(stream, 0) + index);
    return fmt::format("{}, pdf = {:.9g}", f->text(row), f->density({f->table.row(row), f->columns()}));
  };
  s.describe_point = [f](const Subject::Coordinates& v) {
    return fmt::format("({:.6g})", fmt::join(numbers(f->domain, f->domain.chart.from_unit(v).x), ", "));
  };
  return s;
}

// The rows in the order of the file.
OrderedSamples in_order(const Samples& f, std::span<const double> probabilities) {
  OrderedSamples samples{{}, f.domain.chart.axes, f.domain.chart.dim, probabilities};
  if (!probabilities.empty()) {
    samples.axes = {{"i"}};
    samples.dim = 1;
  }
  for (std::uint32_t i = 0; i < f.table.rows(); ++i) {
    mc::PointArray x{};
    std::copy_n(f.table.row(i), f.columns(), x.begin());
    samples.points.push_back(probabilities.empty() ? f.domain.chart.to_unit(x) : Subject::Coordinates{x[0], 0, 0});
  }
  return samples;
}

} // namespace

SamplesFileCase samples_density_case(const SamplesFileOptions& o) {
  const std::shared_ptr<const Samples> file = load(o);
  std::vector<double> atoms;
  if (file->domain.outcomes > 0) atoms = probabilities(o, file->domain.outcomes);
  SamplesFileCase c;
  c.one.name = o.samples;
  c.one.parameters = o.density.empty() ? o.pdf : o.density;
  c.one.scalar = "double";
  c.one.rerun_arguments = fmt::format("--samples-file '{}' {} '{}'", o.samples,
                                      o.density.empty() ? "--pdf-file" : "--pdf", c.one.parameters);
  if (!o.domain.empty()) c.one.rerun_arguments += fmt::format(" --domain '{}'", o.domain);
  if (!o.breaks.empty()) c.one.rerun_arguments += fmt::format(" --breaks '{}'", o.breaks);
  if (o.unnormalized) c.one.rerun_arguments += " --unnormalized";
  const std::uint64_t rows = file->table.rows();
  c.samples = rows - mc::pilot_samples(rows - rows / 9);
  if (o.dependent) c.one.rerun_arguments += " --dependent";
  c.one.check = [file, atoms, title = c.one.title(), dependent = o.dependent](const CaseOptions& options) {
    Subject subject =
        atoms.empty() ? continuous_subject(file, options.seed) : discrete_subject(file, atoms, options.seed);
    subject.name = title;
    return check_rows(subject, in_order(*file, atoms), dependent, options);
  };
  return c;
}

} // namespace carlo

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
#include <mc/core/text.h>
#include <mc/estimate/integrate.h>
#include <mc/random/hash.h>
#include <mc/random/uniform.h>
#include <mc/stats/autocorrelation.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
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
  std::string note = {}; ///< how the rows were thinned

  std::size_t columns() const { return table.columns; }
  double density_at(const mc::PointArray& x) const {
    std::array<double, std::tuple_size_v<mc::PointArray> + 1> row{-1};
    std::copy(x.begin(), x.end(), row.begin() + (domain.is_mixed() ? 1 : 0));
    return density({row.data(), columns()});
  }

  // The row, with each number moved within its last digit so that the point lies in the domain. A number printed at an
  // edge came from the inside. Returns the row itself if no attempt hits the domain.
  std::vector<double> point(std::uint32_t row, std::uint64_t seed) const {
    std::vector<double> x(table.row(row), table.row(row) + columns());
    if (!domain.is_point(x.data())) return x;
    for (const std::uint64_t by : {seed, usual})
      for (std::uint64_t attempt = 0; attempt < 256; ++attempt) {
        std::vector<double> moved = x;
        for (std::size_t k = domain.is_mixed(); k < columns(); ++k)
          moved[k] += shift(row, k, mc::hash(by, row, k, attempt));
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
  bool is_flat() const { return domain.chart.dim == domain.chart.point_size; }

  // A uniform offset within the numbers that print like this one.
  double shift(std::uint32_t row, std::size_t column, std::uint64_t hash) const {
    const std::size_t place = row * columns() + column;
    const double above = std::pow(10.0, table.digits[place]) / 2, below = std::pow(10.0, table.digits_below[place]) / 2;
    return std::copysign(1.0, table.values[place]) * (mc::uniform<double>(hash) * (above + below) - below);
  }
};

std::vector<double> column_of(const CsvTable& table, std::size_t column) {
  std::vector<double> values(table.rows());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = table.row(i)[column];
  return values;
}

std::array<double, 3> quartiles(const CsvTable& table, std::size_t column) {
  mc::require(column < table.columns, "it has more columns than the samples, which have {}", table.columns);
  return quartiles_of(column_of(table, column));
}

std::string default_domain(std::size_t columns) {
  if (columns == 1) return "x=0:1";
  return columns == 2 ? "x=0:1,y=0:1" : "sphere";
}

double checked(double value, const std::string& where, const std::string& what = "--pdf") {
  mc::require(value >= 0 && std::isfinite(value), "{} is {} at {}; a density is finite and >= 0", what, value, where);
  return value;
}

// The integral of an unnormalised density over the points, and its relative error. The tolerance of the cubature is
// absolute, so the density is divided by its integral until the quotient is of order 1. In more dimensions than a
// cubature has, points of libmc's integrator.
std::pair<double, double> integral_of_points(const Samples& s) {
  double scale = 1;
  const auto f = [&](const mc::AnyDomain::Coordinates& v) {
    const mc::AnyDomain::DomainPoint at = s.domain.chart.from_unit(v);
    const double value = s.density_at(at.x) / scale * at.jacobian;
    return std::isfinite(value) ? value : 0.0; // 0 at the ends of infinite intervals
  };
  if (s.domain.chart.dim > mc::max_cubature_dim) {
    const auto of_points = [&](std::span<const double> u) {
      mc::AnyDomain::Coordinates v{};
      std::copy(u.begin(), u.end(), v.begin());
      return f(v);
    };
    const mc::Integral r =
        mc::integrate_unit(of_points, s.domain.chart.dim, {.rel_error = 1e-4, .max_calls = 20'000'000});
    return {r.estimate.value, r.estimate.std_error / r.estimate.value};
  }
  mc::CubatureResult r = mc::integrate_boxes(f, s.domain.chart.dim, {mc::UnitBox()});
  for (int round = 0; round < 8 && r.total.value > 0 && (r.total.value < 0.5 || r.total.value > 2); ++round) {
    scale *= r.total.value;
    r = mc::integrate_boxes(f, s.domain.chart.dim, {mc::UnitBox()});
    mc::require(r.total.value > 0 && std::isfinite(scale), "--pdf: its integral, about {:g}, is beyond doubles", scale);
  }
  return {r.total.value * scale, r.total.error / r.total.value};
}

// The sum of the density over the outcomes from, from + step, ... until the terms vanish.
double sum_from(const Samples& s, double from, double step, double so_far) {
  constexpr int most_terms = 10'000'000;
  constexpr double negligible = 1e-17;
  mc::CompensatedSum sum;
  for (int i = 0; i < most_terms; ++i) {
    const double k = from + step * i;
    if (s.domain.outcomes.index(k) < 0) return sum.value();
    const double term = checked(s.density({&k, 1}), fmt::format("outcome {}", k));
    sum.add(term);
    if (term <= negligible * (so_far + sum.value())) return sum.value();
  }
  throw mc::Error(fmt::format("--pdf: the sum over the outcomes from {} on does not converge within {} terms; give "
                              "probabilities that add up to 1 instead of --unnormalized",
                              from, most_terms));
}

// Divides the density by its integral over the points and its sum over the outcomes.
void normalize(Samples& s) {
  mc::CompensatedSum sum;
  const mc::Outcomes& outcomes = s.domain.outcomes;
  for (int i = 0; i < outcomes.listed(); ++i)
    sum.add(checked(s.density(s.domain.row_of(i)), fmt::format("outcome {}", outcomes.first + i)));
  if (outcomes.last < outcomes.hi) sum.add(sum_from(s, outcomes.last + 1, 1, sum.value()));
  if (outcomes.first > outcomes.lo) sum.add(sum_from(s, outcomes.first - 1, -1, sum.value()));
  double mass = sum.value(), error = 0;
  if (s.domain.chart.dim > 0) {
    const auto [points, relative] = integral_of_points(s);
    mass += points;
    error = relative * points / mass;
  }
  mc::require(mass > 0, "--pdf: the expression was 0 at every point that was evaluated");
  mc::require(error <= 1e-3,
              "--pdf: its integral is {:.6g} to within {:.2g} only; give a density that integrates to 1 instead of "
              "--unnormalized",
              mass, error * mass);
  s.density = [f = s.density, mass](std::span<const double> x) { return f(x) / mass; };
  s.mass_tolerance = std::max(1e-12, 2 * error);
}

// The density of a logarithm. An unnormalised one is divided by its largest value at the rows, which may be beyond
// doubles.
Density exponential(const Density& log_density, const CsvTable& table, bool unnormalized) {
  double shift = unnormalized ? -HUGE_VAL : 0;
  for (std::size_t i = 0; unnormalized && i < table.rows(); ++i) {
    const double here = log_density({table.row(i), table.columns});
    if (here < HUGE_VAL) shift = std::max(shift, here);
  }
  mc::require(std::isfinite(shift), "--log-density: the expression is finite at no sample");
  return [log_density, shift](std::span<const double> x) { return std::exp(log_density(x) - shift); };
}

// The probabilities of the outcomes, from the density or from a file. The rest of infinitely many is the rest of 1.
std::vector<double> probabilities(const SamplesFileOptions& o, const Samples& s) {
  const mc::Outcomes& outcomes = s.domain.outcomes;
  std::vector<double> p;
  if (!o.pdf.empty()) {
    p = read_csv(o.pdf).values;
    mc::require(p.size() == static_cast<std::size_t>(outcomes.count()) && !outcomes.has_rest(),
                "{}: {} numbers; {} outcomes are named", o.pdf, p.size(),
                outcomes.has_rest() ? "infinitely many" : std::to_string(outcomes.count()));
  } else {
    for (int i = 0; i < outcomes.listed(); ++i) p.push_back(s.density(s.domain.row_of(i)));
  }
  mc::CompensatedSum sum;
  for (std::size_t i = 0; i < p.size(); ++i)
    sum.add(checked(p[i], fmt::format("outcome {}", outcomes.first + static_cast<double>(i)),
                    o.pdf.empty() ? "--pdf" : o.pdf));
  mc::require(sum.value() > 0 || s.domain.is_mixed(), "the probabilities are all 0");
  if (o.unnormalized && !o.pdf.empty())
    for (double& one : p) one /= sum.value();
  outcomes.add_rest(p);
  return p;
}

// The autocorrelation time of the rows: the largest of the columns and of their squared deviations.
double autocorrelation_time(const CsvTable& table) {
  double largest = 1;
  for (std::size_t k = 0; k < table.columns; ++k) {
    std::vector<double> column = column_of(table, k);
    largest = std::max(largest, mc::autocorrelation_time(column));
    const double mean = std::accumulate(column.begin(), column.end(), 0.0) / static_cast<double>(column.size());
    for (double& x : column) x = mc::sqr(x - mean);
    largest = std::max(largest, mc::autocorrelation_time(column));
  }
  return largest;
}

// Keeps the rows of a chain that are nearly independent. Returns a sentence for the user; empty if all rows stay.
std::string thin(const SamplesFileOptions& o, CsvTable& table) {
  if (o.thin.empty()) return {};
  const std::size_t all = table.rows();
  const double time = autocorrelation_time(table);
  std::size_t step = mc::thinning_distance(time, all);
  if (o.thin != "auto") {
    const std::optional<double> given = mc::parse_double(o.thin);
    mc::require(given && *given >= 1 && *given <= double(all) && *given == std::floor(*given),
                "--thin '{}' must be auto or a whole number of rows", o.thin);
    step = static_cast<std::size_t>(*given);
  }
  mc::require(all / step >= 2000,
              "{}: {} rows with an autocorrelation time of {:.3g} rows; one in {} leaves {}, and 2000 are needed: "
              "{:.2g} times as many rows",
              o.samples, all, time, step, all / step, 2000 * double(step) / double(all));
  table.keep_every(step);
  return fmt::format("{}: autocorrelation time {:.3g} rows; {} of {} rows are checked, one in {}", o.samples, time,
                     table.rows(), all, step);
}

std::shared_ptr<const Samples> load(const SamplesFileOptions& o) {
  CsvTable table = read_csv(o.samples);
  mc::require(table.rows() >= 2000, "{}: {} samples; at least 2000 are needed", o.samples, table.rows());
  mc::require(table.rows() < std::uint64_t{1} << 32, "{}: {} samples; fewer than 2^32 fit", o.samples, table.rows());
  const std::string note = thin(o, table);
  const std::string text = o.domain.empty() ? default_domain(table.columns) : o.domain;
  const auto quartiles_in = [&](std::size_t column) { return quartiles(table, column); };
  ParsedDomain domain = mc::with_context("--domain", [&] { return parse_domain(text, quartiles_in); });
  const std::vector<std::string> names = domain.columns;
  mc::require(names.size() == table.columns, "{}: {} columns; {} {} needed on {}", o.samples, table.columns,
              names.size(), names.size() == 1 ? "is" : "are", domain.text);
  ParsedDomain strict = parse_domain(text, quartiles_in, Rounding::doubles);
  if (!std::isfinite(domain.outcomes.hi - domain.outcomes.lo)) {
    domain.outcomes.list(column_of(table, 0));
    strict.outcomes = domain.outcomes;
  }
  Samples s{o.samples, std::move(table), std::move(domain), std::move(strict), {}};
  s.note = note;
  std::uint32_t off = 0, first_off = 0;
  for (auto i = static_cast<std::uint32_t>(s.table.rows()); i-- > 0;)
    if (!s.is_inside(i)) {
      ++off;
      first_off = i;
    }
  mc::require(off == 0, "{} is not in {}; {} of {} samples are not (see --domain)", s.text(first_off), s.domain.text,
              off, s.table.rows());
  if (!o.pdf.empty()) return std::make_shared<const Samples>(std::move(s)); // probabilities from a file
  mc::require(!o.density.empty(), "validate: --samples-file needs the probabilities: --pdf-file or --pdf");
  for (const std::string& name : names) mc::with_context("--domain", [&] { require_variable_name(name); });
  s.density = parse_function(o.density, names);
  if (o.is_log) s.density = exponential(s.density, s.table, o.unnormalized);
  s.breaks = parse_breaks(o.breaks, s.domain.chart);
  if (o.unnormalized) normalize(s);
  return std::make_shared<const Samples>(std::move(s));
}

// Sets the density of the points.
void add_points(const std::shared_ptr<const Samples>& f, Subject& s) {
  s.dim = f->domain.chart.dim;
  s.axes = f->domain.chart.axes;
  s.mass_tolerance = f->mass_tolerance;
  s.breaks = f->breaks;
  s.density = [f](const Subject::Coordinates& v) {
    const mc::AnyDomain::DomainPoint at = f->domain.chart.from_unit(v);
    return f->density_at(at.x) * at.jacobian;
  };
  s.resolution = [f, epsilon = s.epsilon](const Subject::Coordinates& v, int axis) {
    return mc::resolution(f->strict.chart, epsilon, v, static_cast<std::size_t>(axis));
  };
  s.describe_point = [f](const Subject::Coordinates& v) {
    const mc::PointArray x = f->domain.chart.from_unit(v).x;
    return fmt::format("({:.6g})", fmt::join(x.begin(), x.begin() + f->domain.chart.point_size, ", "));
  };
}

Subject::Draw draw_of(const Samples& f, const std::vector<double>& row, std::span<const double> probabilities) {
  Subject::Draw d;
  if (const int outcome = f.domain.outcome_of(row.data()); outcome >= 0) {
    d.kind = Subject::Draw::Kind::atom;
    d.atom = outcome;
    d.pdf_positive = probabilities[static_cast<std::size_t>(outcome)] > 0;
    return d;
  }
  const double density = f.density(row);
  d.pdf_positive = density > 0 && std::isfinite(density);
  d.v = f.domain.chart.to_unit(f.domain.point_of(row.data()));
  d.density = density * f.domain.chart.jacobian(d.v);
  return d;
}

Subject subject_of(const std::shared_ptr<const Samples>& f, const std::vector<double>& probabilities,
                   std::uint64_t seed) {
  constexpr double of_printed_probabilities = 1e-4;
  Subject s;
  if (f->domain.chart.dim > 0) add_points(f, s);
  else s.mass_tolerance = of_printed_probabilities;
  s.atoms = probabilities;
  const auto shuffler = std::make_shared<RowShuffler>(static_cast<std::uint32_t>(f->table.rows()), seed);
  s.draw = [f, shuffler, probabilities, seed](std::uint64_t stream, std::size_t n, std::vector<Subject::Draw>& out) {
    const std::uint64_t first = shuffler->open(stream, n);
    for (std::size_t k = 0; k < n; ++k)
      out.push_back(draw_of(*f, f->point(shuffler->row(first + k), seed), probabilities));
  };
  s.describe_draw = [f, shuffler](std::uint64_t stream, std::uint64_t index) {
    const std::uint32_t row = shuffler->row(shuffler->open(stream, 0) + index);
    if (f->domain.outcome_of(f->table.row(row)) >= 0) return f->text(row);
    return fmt::format("{}, pdf = {:.9g}", f->text(row), f->density({f->table.row(row), f->columns()}));
  };
  return s;
}

// The rows in the order of the file. With points and outcomes, the number of the outcome is a further coordinate.
OrderedSamples in_order(const Samples& f, std::span<const double> probabilities) {
  const ParsedDomain& domain = f.domain;
  const bool only_outcomes = domain.chart.dim == 0;
  const auto beside = static_cast<std::size_t>(domain.is_mixed() && domain.chart.dim < int(mc::max_chart_dim));
  OrderedSamples samples{{}, domain.chart.axes, domain.chart.dim + int(beside)};
  if (only_outcomes) samples = {{}, {{"i"}}, 1, probabilities};
  if (beside) samples.axes.insert(samples.axes.begin(), mc::Axis{"outcome"});
  for (std::uint32_t i = 0; i < f.table.rows(); ++i) {
    const double* row = f.table.row(i);
    const int outcome = domain.outcome_of(row);
    Subject::Coordinates own{}, v{};
    if (outcome < 0) own = domain.chart.to_unit(domain.point_of(row));
    std::copy(own.begin(), own.end() - static_cast<std::ptrdiff_t>(beside),
              v.begin() + static_cast<std::ptrdiff_t>(beside));
    if (only_outcomes || beside) v[0] = outcome;
    samples.points.push_back(v);
  }
  return samples;
}

} // namespace

SamplesFileCase samples_density_case(const SamplesFileOptions& o) {
  const std::shared_ptr<const Samples> file = load(o);
  std::vector<double> atoms;
  if (file->domain.outcomes.any()) atoms = probabilities(o, *file);
  SamplesFileCase c;
  c.one.name = o.samples;
  c.one.parameters = o.density.empty() ? o.pdf : o.density;
  c.one.scalar = "double";
  c.one.rerun_arguments = fmt::format("--samples-file '{}' {} '{}'", o.samples,
                                      o.density.empty() ? "--pdf-file" : "--pdf", c.one.parameters);
  if (!o.domain.empty()) c.one.rerun_arguments += fmt::format(" --domain '{}'", o.domain);
  if (!o.breaks.empty()) c.one.rerun_arguments += fmt::format(" --breaks '{}'", o.breaks);
  if (o.unnormalized) c.one.rerun_arguments += " --unnormalized";
  if (o.is_log) c.one.rerun_arguments += " --log-density";
  if (!o.thin.empty()) c.one.rerun_arguments += " --thin " + o.thin;
  if (o.dependent) c.one.rerun_arguments += " --dependent";
  const std::uint64_t rows = file->table.rows();
  c.samples = rows - mc::pilot_samples(rows - rows / 9);
  c.note = file->note;
  c.one.check = [file, atoms, title = c.one.title(), dependent = o.dependent](const CaseOptions& options) {
    Subject subject = subject_of(file, atoms, options.seed);
    subject.name = title;
    return check_rows(subject, in_order(*file, atoms), dependent, options);
  };
  return c;
}

} // namespace carlo

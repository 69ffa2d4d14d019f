#include <input/parsed_domain.h>
#include <plugin/check_request.h>
#include <plugin/command.h>
#include <plugin/program.h>
#include <report/report_json.h>

#include <mc/check/laws.h>
#include <mc/core/error.h>
#include <mc/random/pcg.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace carlo {

using mc::AnyDistribution;
using nlohmann::json;

namespace {

using Rows = std::vector<double>;

void append(const Rows& row, Rows& rows) { rows.insert(rows.end(), row.begin(), row.end()); }

// A program that samples a distribution on a domain, in batches.
class SamplingProgram {
 public:
  using Samples = std::vector<std::optional<AnyDistribution::Sample>>;

  //   uniforms : numbers for one sample; 0: it takes a seed.
  SamplingProgram(const CommandDistribution& d, std::size_t uniforms, CallMonitor& monitor)
      : program_(d.command, monitor), uniforms_(uniforms), is_log_(d.is_log), domain_(parse_domain(d.domain)) {}

  std::size_t uniforms() const { return uniforms_; }
  const ParsedDomain& domain() const { return domain_; }
  void set_domain(ParsedDomain domain) { domain_ = std::move(domain); }

  // Rows of samples for rows of uniform numbers or for seeds.
  Rows rows(const Rows& u) {
    return uniforms_ > 0 ? ask("sample", "u", u, uniforms_, domain_.columns.size())
                         : ask("draw", "seed", u, 1, domain_.columns.size());
  }
  Rows densities(const Rows& x) {
    Rows all = ask("pdf", "x", x, domain_.columns.size(), 1);
    if (is_log_)
      for (double& one : all) one = std::exp(one);
    return all;
  }
  std::vector<double> pdf(std::span<const mc::PointArray> x) {
    Rows rows;
    for (const mc::PointArray& one : x) append(domain_.row_of(one), rows);
    return densities(rows);
  }

  // Samples with their densities.
  Samples sample(const Rows& u) {
    const std::size_t columns = domain_.columns.size();
    const Rows x = rows(u);
    Samples drawn(x.size() / columns, AnyDistribution::Sample{});
    std::vector<mc::PointArray> points;
    std::vector<std::size_t> owners;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const double* row = &x[i * columns];
      AnyDistribution::Sample& d = *drawn[i];
      if (!domain_.is_point(row)) {
        d.atom = domain_.outcomes.index(row[0]);
        if (d.atom < 0) d.x[0] = row[0];
        mc::require(d.atom >= 0 || !std::isfinite(row[0]) || !domain_.is_mixed(),
                    "it returned outcome {}; the domain has {}", row[0], domain_.text);
        continue;
      }
      d.x = domain_.point_of(row);
      if (!domain_.chart.contains(d.x)) continue;
      points.push_back(d.x);
      owners.push_back(i);
    }
    const std::vector<double> density = pdf(points);
    for (std::size_t k = 0; k < owners.size(); ++k) drawn[owners[k]]->pdf = density[k];
    return drawn;
  }

 private:
  Rows ask(const char* what, const char* argument, const Rows& in, std::size_t width, std::size_t answer_width) {
    Rows out(in.size() / width * answer_width);
    program_.ask(what, argument, in, width, out);
    return out;
  }

  Program program_;
  std::size_t uniforms_;
  bool is_log_;
  ParsedDomain domain_;
};

Rows rows_of(std::span<const AnyDistribution::Uniforms> u, std::size_t width) {
  Rows rows;
  rows.reserve(u.size() * width);
  for (const AnyDistribution::Uniforms& one : u)
    rows.insert(rows.end(), one.begin(), one.begin() + static_cast<std::ptrdiff_t>(width));
  return rows;
}

Rows seeds(mc::Pcg& random, std::size_t n) {
  Rows all(n);
  for (double& one : all) one = static_cast<double>(random.next64() >> 11);
  return all;
}

// The input of n samples: uniform numbers or seeds.
Rows input_of(const SamplingProgram& program, std::uint64_t seed, std::size_t n) {
  mc::Pcg random(seed);
  if (program.uniforms() == 0) return seeds(random, n);
  Rows u(n * program.uniforms());
  for (double& one : u) one = random.uniform<double>();
  return u;
}

double time_of(SamplingProgram& program) {
  const Rows u = input_of(program, 3, mc::timing_inputs);
  const auto start = std::chrono::steady_clock::now();
  program.sample(u);
  return 1e9 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / mc::timing_inputs;
}

// The probabilities of the outcomes.
std::vector<double> probabilities(SamplingProgram& program) {
  const mc::Outcomes& outcomes = program.domain().outcomes;
  if (!outcomes.any()) return {};
  Rows rows;
  for (int i = 0; i < outcomes.listed(); ++i) append(program.domain().row_of(i), rows);
  std::vector<double> p = program.densities(rows);
  outcomes.add_rest(p);
  return p;
}

AnyDistribution distribution_of(const std::shared_ptr<SamplingProgram>& program) {
  AnyDistribution s;
  s.domain = program->domain().chart;
  s.uniforms = static_cast<int>(program->uniforms());
  if (s.uniforms > 0) {
    s.sample_many = [program](std::span<const AnyDistribution::Uniforms> u) {
      return program->sample(rows_of(u, program->uniforms()));
    };
    s.sample = [many = s.sample_many](const AnyDistribution::Uniforms& u) { return many(std::span(&u, 1))[0]; };
  } else {
    s.sample_stream = [program](mc::Pcg& random) { return program->sample(seeds(random, 1))[0]; };
    s.sample_stream_many = [program](std::uint64_t seed, std::size_t n) {
      mc::Pcg random(seed);
      return program->sample(seeds(random, n));
    };
  }
  s.pdf_many = [program](std::span<const mc::PointArray> x) { return program->pdf(x); };
  s.pdf = [program](const mc::PointArray& x) { return program->pdf(std::span(&x, 1))[0]; };
  s.ns_per_sample = [program] { return time_of(*program); };
  s.atoms = probabilities(*program);
  return s;
}

// Charts of infinite intervals are centred on pilot samples, and infinitely many outcomes end at their extremes.
void adapt_domain(SamplingProgram& program, const std::string& text, std::uint64_t seed) {
  constexpr std::size_t of_points = 1000, of_outcomes = 1 << 16;
  const bool has_outcomes = program.domain().outcomes.any();
  const std::size_t columns = program.domain().columns.size();
  std::optional<Rows> pilot;
  const auto numbers = [&](std::size_t column) {
    if (!pilot) pilot = program.rows(input_of(program, mc::hash(seed, 42), has_outcomes ? of_outcomes : of_points));
    std::vector<double> all;
    for (std::size_t i = 0; i < pilot->size(); i += columns)
      if (!program.domain().is_mixed() || column == 0 || (*pilot)[i] < 0) all.push_back((*pilot)[i + column]);
    return all;
  };
  ParsedDomain domain = parse_domain(
      text, [&](std::size_t column) { return quartiles_of(numbers(column)); }, Rounding::doubles);
  if (!std::isfinite(domain.outcomes.hi - domain.outcomes.lo)) domain.outcomes.list(numbers(0));
  program.set_domain(std::move(domain));
}

CommandDistribution requested(const json& request) {
  return {request["who"], request["domain"], request["breaks"], request["uniforms"], request["is_log"]};
}

} // namespace

json run_command_task(const json& request, CallMonitor& monitor) {
  const CommandDistribution d = requested(request);
  const auto program = std::make_shared<SamplingProgram>(d, static_cast<std::size_t>(std::max(d.uniforms, 0)), monitor);
  CaseOptions o = requested_options(request);
  o.max_evaluations = 1'000'000; // each evaluation is an exchange with the program
  adapt_domain(*program, d.domain, o.seed);
  AnyDistribution distribution = distribution_of(program);
  distribution.breaks = parse_breaks(d.breaks, program->domain().chart);
  distribution.name = request["title"];
  return to_json(check_laws(distribution, {.statistics = o}));
}

Case command_case(const CommandDistribution& distribution, const WorkerOptions& worker) {
  const ParsedDomain domain = mc::with_context("--domain", [&] { return parse_domain(distribution.domain); });
  parse_breaks(distribution.breaks, domain.chart);
  const int uniforms =
      distribution.uniforms != 0 ? distribution.uniforms : std::max(domain.chart.dim + int(domain.is_mixed()), 1);
  mc::require(uniforms <= CallMonitor::max_arguments, "validate: --uniforms {}; at most {} are possible", uniforms,
              CallMonitor::max_arguments);
  Case c;
  c.name = distribution.command;
  c.parameters = distribution.domain;
  c.scalar = "double";
  c.rerun_arguments = fmt::format("--command '{}' --domain '{}'", distribution.command, distribution.domain);
  if (!distribution.breaks.empty()) c.rerun_arguments += fmt::format(" --breaks '{}'", distribution.breaks);
  if (distribution.uniforms > 0) c.rerun_arguments += fmt::format(" --uniforms {}", distribution.uniforms);
  if (distribution.uniforms < 0) c.rerun_arguments += " --uniforms own";
  if (distribution.is_log) c.rerun_arguments += " --log-density";
  c.check = [=, title = c.title()](const CaseOptions& o) {
    json request = check_request("command", distribution.command, title, o);
    request["domain"] = distribution.domain;
    request["breaks"] = distribution.breaks;
    request["uniforms"] = uniforms;
    request["is_log"] = distribution.is_log;
    return report_from_json(call_worker(std::move(request), worker));
  };
  return c;
}

} // namespace carlo

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
#include <span>
#include <vector>

namespace carlo {

using mc::AnyDistribution;
using nlohmann::json;

namespace {

using Rows = std::vector<double>;

// A program that samples a distribution.
class SamplingProgram {
 public:
  SamplingProgram(const std::string& command, std::size_t uniforms, std::size_t columns, CallMonitor& monitor)
      : program_(command, monitor), uniforms_(uniforms), columns_(columns) {}

  std::size_t uniforms() const { return uniforms_; }
  std::size_t columns() const { return columns_; }

  Rows sample(const Rows& u) { return ask("sample", "u", u, uniforms_, columns_); }
  Rows pdf(const Rows& x) { return ask("pdf", "x", x, columns_, 1); }

 private:
  Rows ask(const char* what, const char* argument, const Rows& in, std::size_t width, std::size_t answer_width) {
    Rows out(in.size() / width * answer_width);
    program_.ask(what, argument, in, width, out);
    return out;
  }

  Program program_;
  std::size_t uniforms_, columns_;
};

// The first `width` numbers of each array as one row.
template <class Arrays> Rows rows_of(const Arrays& arrays, std::size_t width) {
  Rows rows;
  rows.reserve(arrays.size() * width);
  for (const auto& a : arrays) rows.insert(rows.end(), a.begin(), a.begin() + static_cast<std::ptrdiff_t>(width));
  return rows;
}

// The program's sampler on a domain; it draws samples in batches.
class CommandOnDomain {
 public:
  CommandOnDomain(const std::shared_ptr<SamplingProgram>& program, const ParsedDomain& domain)
      : program_(program), domain_(domain) {}

  std::vector<std::optional<AnyDistribution::Sample>> sample(std::span<const AnyDistribution::Uniforms> u) const {
    const Rows x = program_->sample(rows_of(u, program_->uniforms()));
    std::vector<std::optional<AnyDistribution::Sample>> drawn(u.size(), AnyDistribution::Sample{});
    std::vector<mc::PointArray> points;
    std::vector<std::size_t> owners;
    for (std::size_t i = 0; i < u.size(); ++i) {
      AnyDistribution::Sample& d = *drawn[i];
      std::copy_n(x.begin() + static_cast<std::ptrdiff_t>(i * program_->columns()), program_->columns(), d.x.begin());
      const bool inside = domain_.chart.contains(d.x);
      if (domain_.outcomes > 0 && inside) d.atom = static_cast<int>(d.x[0]);
      if (domain_.outcomes > 0 || !inside) continue;
      points.push_back(d.x);
      owners.push_back(i);
    }
    const std::vector<double> density = pdf(points);
    for (std::size_t k = 0; k < owners.size(); ++k) drawn[owners[k]]->pdf = density[k];
    return drawn;
  }
  std::vector<double> pdf(std::span<const mc::PointArray> x) const {
    return program_->pdf(rows_of(x, program_->columns()));
  }

 private:
  std::shared_ptr<SamplingProgram> program_;
  ParsedDomain domain_;
};

double time_of(const CommandOnDomain& command, const AnyDistribution& s) {
  mc::Pcg random(3);
  std::vector<AnyDistribution::Uniforms> u(mc::timing_inputs);
  for (AnyDistribution::Uniforms& one : u) one = random_uniforms(s, random);
  const auto start = std::chrono::steady_clock::now();
  command.sample(u);
  return 1e9 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() /
         static_cast<double>(u.size());
}

AnyDistribution plugin_distribution(const std::shared_ptr<SamplingProgram>& program, const ParsedDomain& domain) {
  const CommandOnDomain command(program, domain);
  AnyDistribution s;
  s.domain = domain.chart;
  s.uniforms = static_cast<int>(program->uniforms());
  s.sample = [command](const AnyDistribution::Uniforms& u) { return command.sample(std::span(&u, 1))[0]; };
  s.sample_many = [command](std::span<const AnyDistribution::Uniforms> u) { return command.sample(u); };
  s.pdf = [command](const mc::PointArray& x) { return command.pdf(std::span(&x, 1))[0]; };
  s.pdf_many = [command](std::span<const mc::PointArray> x) { return command.pdf(x); };
  s.ns_per_sample = [command, s] { return time_of(command, s); };
  std::vector<mc::PointArray> outcomes(static_cast<std::size_t>(domain.outcomes));
  for (std::size_t i = 0; i < outcomes.size(); ++i) outcomes[i][0] = static_cast<double>(i);
  if (!outcomes.empty()) s.atoms = command.pdf(outcomes);
  return s;
}

// The domain, with charts of infinite intervals centred on pilot samples.
ParsedDomain charted(SamplingProgram& program, const std::string& text, std::uint64_t seed) {
  mc::Pcg random(mc::hash(seed, 42));
  Rows u(1000 * program.uniforms());
  for (double& one : u) one = random.uniform<double>();
  const auto quartiles = [&](std::size_t column) {
    const Rows x = program.sample(u);
    std::vector<double> numbers;
    for (std::size_t i = column; i < x.size(); i += program.columns()) numbers.push_back(x[i]);
    return quartiles_of(std::move(numbers));
  };
  return parse_domain(text, quartiles, Rounding::doubles);
}

} // namespace

json run_command_task(const json& request, CallMonitor& monitor) {
  const std::string text = request["domain"];
  const auto program =
      std::make_shared<SamplingProgram>(request["who"].get<std::string>(), request["uniforms"].get<std::size_t>(),
                                        parse_domain(text).columns.size(), monitor);
  CaseOptions o = requested_options(request);
  o.max_evaluations = 1'000'000; // each evaluation is an exchange with the program
  const ParsedDomain domain = charted(*program, text, o.seed);
  AnyDistribution distribution = plugin_distribution(program, domain);
  distribution.breaks = parse_breaks(request["breaks"], domain.chart);
  distribution.name = request["title"];
  return to_json(check_laws(distribution, {.statistics = o}));
}

Case command_case(const CommandDistribution& distribution, const WorkerOptions& worker) {
  const ParsedDomain domain = mc::with_context("--domain", [&] { return parse_domain(distribution.domain); });
  parse_breaks(distribution.breaks, domain.chart);
  const int uniforms = distribution.uniforms > 0 ? distribution.uniforms : std::max(domain.chart.dim, 1);
  mc::require(uniforms <= CallMonitor::max_arguments, "validate: --uniforms {}; at most {} are possible", uniforms,
              CallMonitor::max_arguments);
  Case c;
  c.name = distribution.command;
  c.parameters = distribution.domain;
  c.scalar = "double";
  c.rerun_arguments = fmt::format("--command '{}' --domain '{}'", distribution.command, distribution.domain);
  if (!distribution.breaks.empty()) c.rerun_arguments += fmt::format(" --breaks '{}'", distribution.breaks);
  if (distribution.uniforms > 0) c.rerun_arguments += fmt::format(" --uniforms {}", distribution.uniforms);
  c.check = [=, title = c.title()](const CaseOptions& o) {
    json request = check_request("command", distribution.command, title, o);
    request["domain"] = distribution.domain;
    request["breaks"] = distribution.breaks;
    request["uniforms"] = uniforms;
    return report_from_json(call_worker(std::move(request), worker));
  };
  return c;
}

} // namespace carlo

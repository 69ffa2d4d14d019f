#include <input/any_domain.h>
#include <plugin/command.h>
#include <process/child.h>
#include <report/report_json.h>

#include <mc/check/check_subject.h>
#include <mc/core/error.h>
#include <mc/random/pcg.h>

#include <nlohmann/json.hpp>

#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace carlo {

using mc::Subject;
using nlohmann::json;

namespace {

using Numbers = std::vector<double>;

// The program, asked in batches of rows.
class Program {
 public:
  Program(const std::string& command, std::size_t uniforms, std::size_t columns, Watch& watch)
      : child_({{"/bin/sh", "-c", command}}), uniforms_(uniforms), columns_(columns), watch_(watch) {}

  std::size_t uniforms() const { return uniforms_; }
  std::size_t columns() const { return columns_; }

  Numbers sample(const Numbers& u) { return ask("sample", "u", u, uniforms_, columns_); }
  Numbers pdf(const Numbers& x) { return ask("pdf", "x", x, columns_, 1); }

 private:
  static constexpr std::size_t batch = 4096; // rows: neither side waits with a full pipe for the other

  Numbers ask(const char* what, const char* argument, const Numbers& in, std::size_t width, std::size_t answer_width) {
    static_assert(std::endian::native == std::endian::little);
    Numbers out;
    out.reserve(in.size() / width * answer_width);
    for (std::size_t at = 0; at < in.size(); at += batch * width) {
      const std::size_t n = std::min(batch, (in.size() - at) / width);
      watch_.enter(what, argument, in.data() + at,
                   static_cast<int>(std::min<std::size_t>(width, Watch::max_arguments)));
      const std::string line = fmt::format("{} {} {}\n", what, n, width);
      if (!write_all(child_.input(), line.data(), line.size()) ||
          !write_all(child_.input(), in.data() + at, n * width * sizeof(double)))
        ended(what);
      read(what, out, n * answer_width);
      watch_.leave();
    }
    return out;
  }

  void read(const char* what, Numbers& out, std::size_t count) {
    const std::size_t before = out.size();
    out.resize(before + count);
    char* to = reinterpret_cast<char*>(out.data() + before);
    for (std::size_t left = count * sizeof(double); left > 0;) {
      if (!child_.has_output()) ended(what);
      const ssize_t n = ::read(child_.output(), to, left);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) ended(what);
      to += n;
      left -= static_cast<std::size_t>(n);
    }
  }

  [[noreturn]] void ended(const char* what) {
    watch_.leave();
    throw mc::Error(fmt::format("the program ended with code {} instead of answering '{}'", child_.wait(), what));
  }

  Child child_;
  std::size_t uniforms_, columns_;
  Watch& watch_;
};

Numbers random_rows(std::uint64_t seed, std::size_t n, std::size_t width) {
  mc::Pcg random(seed);
  Numbers u(n * width);
  for (double& one : u) one = random.uniform<double>();
  return u;
}

std::string row_text(const Numbers& rows, std::size_t row, std::size_t width) {
  const auto first = rows.begin() + static_cast<std::ptrdiff_t>(row * width);
  return fmt::format("({:.17g})", fmt::join(first, first + static_cast<std::ptrdiff_t>(width), ", "));
}

std::array<double, 3> quartiles(const Numbers& rows, std::size_t width, std::size_t column) {
  Numbers values;
  for (std::size_t i = column; i < rows.size(); i += width)
    if (std::isfinite(rows[i])) values.push_back(rows[i]);
  if (values.empty() || column >= width) return {-1, 0, 1};
  std::sort(values.begin(), values.end());
  return {values[values.size() / 4], values[values.size() / 2], values[values.size() * 3 / 4]};
}

// The same question twice.
mc::Check purity(Program& p, std::uint64_t seed) {
  constexpr std::size_t n = 1000;
  const Numbers u = random_rows(mc::hash(seed, 41), n, p.uniforms()), x = p.sample(u), again = p.sample(u);
  mc::Check check{"same u, same sample", mc::Verdict::pass, {}, 0, 0, 0, mc::Fault::precision, {}};
  for (std::size_t i = n; i-- > 0;) {
    const auto at = static_cast<std::ptrdiff_t>(i * p.columns()), end = at + static_cast<std::ptrdiff_t>(p.columns());
    const auto same = [](double a, double b) {
      return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
    };
    if (std::equal(x.begin() + at, x.begin() + end, again.begin() + at, same)) continue;
    check.verdict = mc::Verdict::fail;
    check.statistic += 1;
    check.detail = fmt::format("u = {}: x = {}, then {}", row_text(u, i, p.uniforms()), row_text(x, i, p.columns()),
                               row_text(again, i, p.columns()));
  }
  return check;
}

// What one row of samples is.
Subject::Draw draw_of(const AnyDomain& domain, const double* x, std::size_t columns, double density) {
  Subject::Draw d;
  if (!std::all_of(x, x + columns, [](double one) { return std::isfinite(one); })) {
    d.kind = Subject::Draw::Kind::not_finite;
  } else if (!domain.contains(x)) {
    d.kind = Subject::Draw::Kind::outside;
  } else {
    d.pdf_positive = density > 0 && std::isfinite(density);
    d.v = domain.to_unit(x);
  }
  return d;
}

mc::Check edges(Program& p, const AnyDomain& domain) {
  constexpr double places[] = {0, 0x1p-24, 0.5, 1 - 0x1p-24, 1 - 0x1p-53};
  Numbers u;
  const auto rows = static_cast<std::size_t>(std::pow(5, p.uniforms()));
  for (std::size_t k = 0; k < rows; ++k)
    for (std::size_t i = 0, rest = k; i < p.uniforms(); ++i, rest /= 5) u.push_back(places[rest % 5]);
  const Numbers x = p.sample(u), density = p.pdf(x);
  mc::Check check{"edges of the unit cube", mc::Verdict::pass, {}, 0, 0, 0, mc::Fault::edge, {}};
  for (std::size_t k = 0; k < rows; ++k) {
    const Subject::Draw d = draw_of(domain, x.data() + k * p.columns(), p.columns(), density[k]);
    if (d.kind == Subject::Draw::Kind::point && d.pdf_positive) continue;
    if (check.detail.empty())
      check.detail = fmt::format("not a point of the domain with a positive, finite pdf: u = {}, x = {}, pdf = {:.9g}",
                                 row_text(u, k, p.uniforms()), row_text(x, k, p.columns()), density[k]);
    check.verdict = mc::Verdict::fail;
    check.statistic += 1;
  }
  return check;
}

Subject subject_of(Program& p, const AnyDomain& domain) {
  Subject s;
  s.dim = domain.dim();
  s.axes = domain.axes();
  s.mass_tolerance = 64 * 0x1p-52;
  s.draw = [&](std::uint64_t seed, std::size_t n, std::vector<Subject::Draw>& out) {
    const Numbers x = p.sample(random_rows(seed, n, p.uniforms())), density = p.pdf(x);
    for (std::size_t i = 0; i < n; ++i)
      out.push_back(draw_of(domain, x.data() + i * p.columns(), p.columns(), density[i]));
  };
  s.density = [&](const Subject::Coordinates& v) { return p.pdf(domain.from_unit(v))[0] * domain.jacobian(v); };
  s.describe_draw = [&](std::uint64_t seed, std::uint64_t index) {
    const Numbers u = random_rows(seed, index + 1, p.uniforms());
    const Numbers last(u.end() - static_cast<std::ptrdiff_t>(p.uniforms()), u.end());
    const Numbers x = p.sample(last);
    return fmt::format("u = {}, x = {}, pdf = {:.9g}", row_text(last, 0, p.uniforms()), row_text(x, 0, p.columns()),
                       p.pdf(x)[0]);
  };
  s.describe_point = [&](const Subject::Coordinates& v) {
    return fmt::format("({:.6g})", fmt::join(domain.from_unit(v), ", "));
  };
  return s;
}

AnyDomain domain_of(const std::string& text, const Quartiles& quartiles) {
  AnyDomain domain = parse_domain(text, quartiles);
  mc::require(domain.outcomes() == 0, "--domain: a --command draws from a continuous domain");
  return domain;
}

} // namespace

json run_command_task(const json& request, Watch& watch) {
  std::signal(SIGPIPE, SIG_IGN); // a program that ended is an error of the write
  const auto start = std::chrono::steady_clock::now();
  const std::string text = request["domain"];
  const std::size_t columns = domain_of(text,
                                        [](std::size_t) {
                                          return std::array<double, 3>{-1, 0, 1};
                                        })
                                  .names()
                                  .size();
  Program program(request["who"], request["uniforms"], columns, watch);
  const Numbers pilot =
      program.sample(random_rows(mc::hash(request["seed"].get<std::uint64_t>(), 42), 1000, program.uniforms()));
  const AnyDomain domain = domain_of(text, [&](std::size_t column) { return quartiles(pilot, columns, column); });
  mc::SubjectOptions o;
  o.samples = request["samples"];
  o.seed = request["seed"];
  o.alpha = request["alpha"];
  o.evidence = request["evidence"];
  o.max_evaluations = 1'000'000; // each is an exchange with the program
  Subject subject = subject_of(program, domain);
  subject.name = request["title"];
  mc::Report report = mc::check_subject(subject, o);
  report.checks.insert(report.checks.begin(), {purity(program, o.seed), edges(program, domain)});
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return to_json(report);
}

Case command_case(const CommandSampler& sampler, const WorkerOptions& worker) {
  const AnyDomain domain = domain_of(sampler.domain, [](std::size_t) { return std::array<double, 3>{-1, 0, 1}; });
  const int uniforms = sampler.uniforms > 0 ? sampler.uniforms : domain.dim();
  mc::require(uniforms <= Watch::max_arguments, "validate: --uniforms {}; at most {} are possible", uniforms,
              Watch::max_arguments);
  Case c;
  c.name = sampler.command;
  c.parameters = sampler.domain;
  c.scalar = "double";
  c.again = fmt::format("--command '{}' --domain '{}'", sampler.command, sampler.domain);
  if (sampler.uniforms > 0) c.again += fmt::format(" --uniforms {}", sampler.uniforms);
  c.check = [=, title = c.title()](const CaseOptions& o) {
    return report_from_json(call_worker({{"task", "command"},
                                         {"who", sampler.command},
                                         {"domain", sampler.domain},
                                         {"uniforms", uniforms},
                                         {"title", title},
                                         {"samples", o.samples},
                                         {"seed", o.seed},
                                         {"alpha", o.alpha},
                                         {"evidence", o.evidence}},
                                        worker));
  };
  return c;
}

} // namespace carlo

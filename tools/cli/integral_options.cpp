#include <cli/integral_options.h>
#include <integrands/find.h>
#include <integrands/genz.h>
#include <integrands/rate_integrals.h>
#include <plugin/integrands.h>

#include <mc/core/error.h>
#include <mc/core/file.h>

#include <fmt/format.h>

#include <algorithm>

namespace carlo {

namespace {

struct Group {
  const char *name, *title;
  const std::vector<Experiment>& (*list)();
};
constexpr Group groups[] = {{"books", "the integrals of the books", experiments},
                            {"genz", "Genz's families", genz_integrals},
                            {"rates", "each class of smoothness in 1 to 8 dimensions", rate_integrals}};

} // namespace

std::vector<Option> integral_rows(IntegralOptions& o) {
  return {
      {"INTEGRAND", "", &o.integrands,
       "Names (see --list), groups (books, genz, rates), or an expression, e.g. \"exp(-x*x)*cos(y)\" [books]"},
      {"-d,--domain", "BOUNDS", &o.domain, "Bounds of an expression's variables, e.g. \"x=0:1,y=-inf:inf\""},
      {"--plugin",
       "FILE",
       &o.plugin,
       "Integrands of this shared object, compiled against <mc/check/plugin.h>",
       false,
       {"--domain"}},
      {"--timeout", "SECONDS", &o.timeout, "Time that a plugin may take for the repetitions at one N"},
      {"--memory", "GIB", &o.memory, "Memory that a plugin may take"},
      {"--list", "", &o.list, "List the integrands and the samplers, and stop"},
  };
}

std::vector<Target> targets_of(const IntegralOptions& o) {
  mc::require(o.timeout > 0 && o.timeout <= 1e6, "--timeout {} must lie in (0, 1e6] seconds", o.timeout);
  mc::require(o.memory >= 0.25 && o.memory <= 1e6, "--memory {} must lie in [0.25, 1e6] GiB", o.memory);
  if (!o.plugin.empty()) {
    mc::require(o.domain.empty(), "a plugin states its own bounds; --domain is for an expression");
    return plugin_targets(o.plugin, o.integrands, {.limits = {.seconds = o.timeout, .gigabytes = o.memory}});
  }
  mc::require(o.domain.empty() || o.integrands.size() == 1, "--domain belongs to one expression");
  std::vector<Target> targets;
  const std::vector<std::string> words = o.integrands.empty() ? std::vector<std::string>{"books"} : o.integrands;
  for (const std::string& word : words) {
    const Group* group = nullptr;
    for (const Group& g : groups)
      if (word == g.name) group = &g;
    if (!group) targets.push_back(here(find_integrand(word, o.domain)));
    else
      for (const Experiment& e : group->list()) targets.push_back(here(e));
  }
  return targets;
}

int list_integrals() {
  for (const Group& g : groups) {
    fmt::print("{}: {}\n", g.name, g.title);
    for (const Experiment& e : g.list()) fmt::print("  {:<24} {}\n", e.name, e.title);
  }
  fmt::print("samplers:\n");
  for (const Way& w : ways()) fmt::print("  {:<24} {}\n", w.name, w.title);
  return exit_ok;
}

} // namespace carlo

#include <options/help.h>

#include <terminal/columns.h>

#include <fmt/format.h>

#include <algorithm>
#include <concepts>
#include <iterator>

namespace carlo {

const char* const carlo_summary =
    "carlo checks distributions, measures how fast estimates converge, integrates, and renders scenes. Every result "
    "carries an error bar.";

namespace {

constexpr std::size_t indent = 2, hang = 26; // columns of terms and of their texts
constexpr const char* help_option = "-h, --help";
constexpr const char* help_meaning = "Print this help, and stop.";

bool is_positional(const Option& o) { return !o.names.starts_with('-'); }

// "-o, --output FILE".
std::string term_of(const Option& o) {
  std::string term = o.names;
  if (const std::size_t comma = term.find(','); comma != std::string::npos) term.insert(comma + 1, " ");
  return o.value.empty() || is_positional(o) ? term : term + " " + o.value;
}

// " Default: 64." if the field has a default that can be shown.
std::string default_of(const Option& o) {
  const auto text = [](auto* field) -> std::string {
    using T = std::remove_pointer_t<decltype(field)>;
    if constexpr (std::same_as<T, std::string>) return *field;
    else if constexpr (std::same_as<T, int> || std::same_as<T, std::uint64_t> || std::same_as<T, double>)
      return fmt::format("{}", *field);
    else return {};
  };
  const std::string value = std::visit(text, o.destination);
  return value.empty() ? "" : fmt::format(" Default: {}.", value);
}

// " Not with --spp."
std::string exclusions_of(const Option& o) {
  std::string names;
  for (const Exclusion& e : o.excludes) names += (names.empty() ? "" : ", ") + e.option;
  return names.empty() ? "" : fmt::format(" Not with {}.", names);
}

HelpEntry entry(const Option& o) { return {term_of(o), o.help + exclusions_of(o) + default_of(o)}; }

// The titles of the groups, in the order of their first options.
std::vector<std::string> groups_of(const std::vector<Option>& options) {
  std::vector<std::string> titles;
  for (const Option& o : options)
    if (!is_positional(o) && std::find(titles.begin(), titles.end(), o.group) == titles.end())
      titles.push_back(o.group);
  return titles;
}

std::vector<HelpSection> option_sections(const std::vector<Option>& options) {
  std::vector<HelpSection> sections;
  HelpSection arguments{"Arguments", {}};
  for (const Option& o : options)
    if (is_positional(o)) arguments.entries.push_back(entry(o));
  if (!arguments.entries.empty()) sections.push_back(std::move(arguments));
  const std::vector<std::string> titles = groups_of(options);
  for (const std::string& title : titles) {
    HelpSection group{title, {}};
    for (const Option& o : options)
      if (!is_positional(o) && !o.hidden && o.group == title) group.entries.push_back(entry(o));
    if (title == titles.front()) group.entries.push_back({help_option, help_meaning});
    sections.push_back(std::move(group));
  }
  return sections;
}

std::string section_text(const HelpSection& section, std::size_t columns) {
  if (section.title.empty()) return "\n" + wrapped(section.entries.front().text, columns);
  std::string text = fmt::format("\n{}:\n", section.title);
  for (const HelpEntry& e : section.entries)
    text += e.term.empty() ? wrapped(e.text, columns, indent) : term_row(e.term, e.text, columns, indent, hang);
  return text;
}

std::string examples_text(const std::vector<HelpEntry>& examples, std::size_t columns) {
  std::string text = "\nExamples:\n";
  for (const HelpEntry& e : examples) text += wrapped(e.term, columns, indent) + wrapped(e.text, columns, 3 * indent);
  return text;
}

HelpSection exit_codes(const std::string& failure) {
  HelpSection codes{"Exit codes", {{"0", "done"}}};
  if (!failure.empty()) codes.entries.push_back({"1", failure});
  codes.entries.push_back({"2", "bad usage, file or value; one line says what to do"});
  codes.entries.push_back(
      {"130, 143", "interrupted by Ctrl-C, by SIGTERM (by signal N: 128 + N); the results so far are kept"});
  codes.entries.push_back({"141", "nothing reads the output any more, as behind | head"});
  return codes;
}

// "carlo render [OPTIONS] SCENE".
std::string usage_of(const Subcommand& c) {
  std::string text = fmt::format("carlo {} [OPTIONS]", c.about.name);
  for (const Option& o : c.options) {
    if (!is_positional(o)) continue;
    const bool is_list = std::holds_alternative<std::vector<std::string>*>(o.destination);
    const std::string name = o.names + (is_list ? "..." : "");
    text += o.required ? " " + name : " [" + name + "]";
  }
  return text;
}

} // namespace

std::vector<Option> in_groups(std::vector<OptionGroup> groups) {
  std::vector<Option> all;
  for (OptionGroup& group : groups)
    for (Option& o : group.options) {
      o.group = group.title;
      all.push_back(std::move(o));
    }
  return all;
}

HelpPage help_page(const Subcommand& c) {
  HelpPage page{c.about.summary, usage_of(c), c.about.examples, option_sections(c.options)};
  page.sections.insert(page.sections.end(), c.about.sections.begin(), c.about.sections.end());
  page.sections.push_back(exit_codes(c.about.failure));
  return page;
}

HelpPage help_page(const std::vector<Subcommand>& subcommands) {
  HelpPage page{carlo_summary,
                "carlo COMMAND [OPTIONS]",
                {{"carlo validate CosineHemisphere", "checks a distribution of the library"},
                 {"carlo integrate \"exp(-x*x)*cos(y)\" -d \"x=0:1,y=-1:2\"", "integrates an expression"},
                 {"carlo render cbox --spp 64", "renders the Cornell box to cbox.exr"}},
                {}};
  HelpSection commands{"Commands", {}};
  for (const Subcommand& c : subcommands)
    if (!c.about.hidden) commands.entries.push_back({c.about.name, c.about.summary + "."});
  page.sections = {std::move(commands),
                   {"Options", {{help_option, help_meaning}, {"--version", "Print the version, and stop."}}},
                   {"", {{"", "carlo COMMAND --help explains a command with its options."}}},
                   exit_codes("a check failed, or a wanted error was not reached")};
  return page;
}

namespace {

std::string terminal_text(const HelpPage& page, std::size_t columns) {
  const std::string stop = page.summary.ends_with('.') ? "" : ".";
  std::string text = wrapped(page.summary + stop, columns) + "\n" + wrapped("Usage: " + page.usage, columns);
  if (!page.examples.empty()) text += examples_text(page.examples, columns);
  for (const HelpSection& s : page.sections) text += section_text(s, columns);
  return text;
}

} // namespace

std::string help_of(const Subcommand& subcommand, std::size_t columns) {
  return terminal_text(help_page(subcommand), columns);
}

std::string help_of(const std::vector<Subcommand>& subcommands, std::size_t columns) {
  return terminal_text(help_page(subcommands), columns);
}

} // namespace carlo

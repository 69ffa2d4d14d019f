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

std::string row(const Option& o, std::size_t columns) {
  return term_row(term_of(o), o.help + exclusions_of(o) + default_of(o), columns, indent, hang);
}

// The titles of the groups, in the order of their first options.
std::vector<std::string> groups_of(const std::vector<Option>& options) {
  std::vector<std::string> titles;
  for (const Option& o : options)
    if (!is_positional(o) && std::find(titles.begin(), titles.end(), o.group) == titles.end())
      titles.push_back(o.group);
  return titles;
}

std::string options_text(const std::vector<Option>& options, std::size_t columns) {
  std::string text;
  for (const Option& o : options)
    if (is_positional(o)) text += (text.empty() ? "\nArguments:\n" : "") + row(o, columns);
  const std::vector<std::string> titles = groups_of(options);
  for (const std::string& title : titles) {
    text += fmt::format("\n{}:\n", title);
    for (const Option& o : options)
      if (!is_positional(o) && o.group == title) text += row(o, columns);
    if (title == titles.front()) text += term_row(help_option, help_meaning, columns, indent, hang);
  }
  return text;
}

std::string section_text(const HelpSection& section, std::size_t columns) {
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

std::string exit_codes(const std::string& failure, std::size_t columns) {
  HelpSection codes{"Exit codes", {{"0", "done"}}};
  if (!failure.empty()) codes.entries.push_back({"1", failure});
  codes.entries.push_back({"2", "bad usage, file or value; one line says what to do"});
  codes.entries.push_back(
      {"130, 143", "interrupted by Ctrl-C, by SIGTERM (by signal N: 128 + N); the results so far are kept"});
  codes.entries.push_back({"141", "nothing reads the output any more, as behind | head"});
  return section_text(codes, columns);
}

// "carlo render [OPTIONS] SCENE".
std::string usage_of(const Subcommand& c) {
  std::string text = fmt::format("Usage: carlo {} [OPTIONS]", c.about.name);
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

std::string help_of(const Subcommand& subcommand, std::size_t columns) {
  const About& about = subcommand.about;
  std::string text = wrapped(about.summary + ".", columns) + "\n" + wrapped(usage_of(subcommand), columns);
  if (!about.examples.empty()) text += examples_text(about.examples, columns);
  text += options_text(subcommand.options, columns);
  for (const HelpSection& s : about.sections) text += section_text(s, columns);
  return text + exit_codes(about.failure, columns);
}

std::string help_of(const std::vector<Subcommand>& subcommands, std::size_t columns) {
  std::string text = wrapped(carlo_summary, columns) + "\nUsage: carlo COMMAND [OPTIONS]\n";
  text += examples_text({{"carlo validate CosineHemisphere", "checks a distribution of the library"},
                         {"carlo integrate \"exp(-x*x)*cos(y)\" -d \"x=0:1,y=-1:2\"", "integrates an expression"},
                         {"carlo render cbox --spp 64", "renders the Cornell box to cbox.exr"}},
                        columns);
  HelpSection commands{"Commands", {}};
  for (const Subcommand& c : subcommands)
    if (!c.about.hidden) commands.entries.push_back({c.about.name, c.about.summary + "."});
  text += section_text(commands, columns);
  text +=
      section_text({"Options", {{help_option, help_meaning}, {"--version", "Print the version, and stop."}}}, columns);
  text += "\n" + wrapped("carlo COMMAND --help explains a command with its options.", columns);
  return text + exit_codes("a check failed, or a wanted error was not reached", columns);
}

} // namespace carlo

#include <documents/completion.h>

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace carlo {

namespace {

// "-o" and "--output" of "-o,--output"; nothing of a positional argument.
std::vector<std::string> names_of(const Option& o) {
  std::vector<std::string> names;
  if (!o.names.starts_with('-') || o.hidden) return names;
  for (std::size_t begin = 0; begin < o.names.size();) {
    const std::size_t comma = std::min(o.names.find(',', begin), o.names.size());
    names.push_back(o.names.substr(begin, comma - begin));
    begin = comma + 1;
  }
  return names;
}

bool is_folder(const Option& o) { return o.use == FileUse::output_folder; }
bool is_file(const Option& o) { return o.use == FileUse::input || o.use == FileUse::output || o.value == "FILE"; }

// "picture" and "worst" of "picture|worst".
std::vector<std::string> choices_of(const Option& o) {
  std::vector<std::string> choices;
  if (o.value.find('|') == std::string::npos) return choices;
  for (std::size_t begin = 0; begin <= o.value.size();) {
    const std::size_t bar = std::min(o.value.find('|', begin), o.value.size());
    choices.push_back(o.value.substr(begin, bar - begin));
    begin = bar + 1;
  }
  return choices;
}

// The text up to the first full stop.
std::string first_sentence(const std::string& text) {
  const std::size_t stop = text.find(". ");
  return text.substr(0, std::min(stop, text.ends_with('.') ? text.size() - 1 : text.size()));
}

std::string quoted(std::string_view text, std::string_view special) {
  std::string out;
  for (const char c : text) {
    if (special.find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}
// In single quotes for bash and zsh.
std::string single(std::string_view text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::vector<const Subcommand*> shown(const std::vector<Subcommand>& all) {
  std::vector<const Subcommand*> list;
  for (const Subcommand& c : all)
    if (!c.about.hidden) list.push_back(&c);
  return list;
}

} // namespace

std::string bash_completion(const std::vector<Subcommand>& subcommands) {
  std::string commands, options, values;
  for (const Subcommand* c : shown(subcommands)) {
    commands += (commands.empty() ? "" : " ") + c->about.name;
    std::string names = "--help";
    for (const Option& o : c->options) {
      const std::vector<std::string> own = names_of(o);
      for (const std::string& name : own) names += " " + name;
      if (own.empty() || o.value.empty()) continue;
      std::string words = "COMPREPLY=()";
      if (is_folder(o)) words = "compopt -o filenames; COMPREPLY=($(compgen -d -- \"$word\"))";
      else if (is_file(o)) words = "compopt -o filenames; COMPREPLY=($(compgen -f -- \"$word\"))";
      else if (const auto choices = choices_of(o); !choices.empty())
        words = fmt::format("COMPREPLY=($(compgen -W '{}' -- \"$word\"))", fmt::join(choices, " "));
      for (const std::string& name : own)
        values += fmt::format("    {}:{}) {}; return ;;\n", c->about.name, name, words);
    }
    options += fmt::format("    {}) options='{}' ;;\n", c->about.name, names);
  }
  return fmt::format(R"(# Completion of carlo for bash.
_carlo() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} command=${{COMP_WORDS[1]}} options=
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W '{} --help --version' -- "$word"))
    return
  fi
  case $command:$before in
{}  esac
  case $command in
{}  esac
  case $word in
    -*) COMPREPLY=($(compgen -W "$options" -- "$word")) ;;
    *) compopt -o filenames; COMPREPLY=($(compgen -f -- "$word")) ;;
  esac
}}
complete -F _carlo carlo
)",
                     commands, values, options);
}

std::string zsh_completion(const std::vector<Subcommand>& subcommands) {
  std::string commands, cases;
  for (const Subcommand* c : shown(subcommands)) {
    commands += fmt::format("    {}\n", single(c->about.name + ":" + quoted(c->about.summary, ":")));
    std::string arguments = "      '(- *)'{-h,--help}'[Print this help, and stop]'";
    for (const Option& o : c->options) {
      const std::vector<std::string> names = names_of(o);
      std::string action;
      if (is_folder(o)) action = "_files -/";
      else if (is_file(o)) action = "_files";
      else if (const auto choices = choices_of(o); !choices.empty())
        action = fmt::format("({})", fmt::join(choices, " "));
      const std::string value = o.value.empty() ? "" : fmt::format(":{}:{}", quoted(o.value, ":"), action);
      const bool repeats = std::holds_alternative<std::vector<std::string>*>(o.destination);
      for (const std::string& name : names)
        arguments += " \\\n      " + single(fmt::format("{}{}[{}]{}", repeats ? "*" : "", name,
                                                        quoted(first_sentence(o.help), "[]:"), value));
    }
    cases +=
        fmt::format("    {})\n      _arguments {} \\\n      '*:file:_files' ;;\n", c->about.name, arguments.substr(6));
  }
  return fmt::format(R"(#compdef carlo
# Completion of carlo for zsh.
local -a commands
commands=(
{})
if (( CURRENT == 2 )); then
  _describe -t commands 'carlo command' commands
  _arguments '--help[Print this help, and stop]' '--version[Print the version, and stop]'
else
  local command=${{words[2]}}
  shift words
  (( CURRENT-- ))
  case $command in
{}  esac
fi
)",
                     commands, cases);
}

std::string fish_completion(const std::vector<Subcommand>& subcommands) {
  std::string text = "# Completion of carlo for fish.\n"
                     "complete -c carlo -n __fish_use_subcommand -l version -d 'Print the version, and stop'\n"
                     "complete -c carlo -s h -l help -d 'Print this help, and stop'\n";
  for (const Subcommand* c : shown(subcommands)) {
    text += fmt::format("complete -c carlo -n __fish_use_subcommand -f -a {} -d '{}'\n", c->about.name,
                        quoted(c->about.summary, "\\'"));
    for (const Option& o : c->options) {
      std::string line;
      for (const std::string& name : names_of(o))
        line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      if (line.empty()) continue;
      if (is_folder(o)) line += " -r -f -a '(__fish_complete_directories)'";
      else if (is_file(o)) line += " -r -F";
      else if (const auto choices = choices_of(o); !choices.empty())
        line += fmt::format(" -x -a '{}'", fmt::join(choices, " "));
      else if (!o.value.empty()) line += " -x";
      text += fmt::format("complete -c carlo -n '__fish_seen_subcommand_from {}'{} -d '{}'\n", c->about.name, line,
                          quoted(first_sentence(o.help), "\\'"));
    }
  }
  return text;
}

} // namespace carlo

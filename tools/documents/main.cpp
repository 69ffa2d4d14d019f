/// carlo_documents FOLDER: writes manual pages and completions, which are installed with carlo.

#include <documents/completion.h>
#include <documents/manual.h>
#include <terminal/version.h>

#include <mc/core/error.h>
#include <mc/core/file.h>

#include <cstdio>
#include <filesystem>

namespace {

void write_all(const std::string& folder) {
  const std::vector<carlo::Subcommand> all = carlo::subcommands();
  std::vector<std::string> pages;
  for (const carlo::Subcommand& c : all)
    if (!c.about.hidden) pages.push_back("carlo-" + c.about.name);
  const auto write = [&](const std::string& name, const std::string& text) {
    mc::write_file((std::filesystem::path(folder) / name).string(), text);
  };
  write("carlo.1", carlo::manual_page("carlo", carlo::help_page(all), carlo::version, pages));
  for (const carlo::Subcommand& c : all)
    if (!c.about.hidden)
      write("carlo-" + c.about.name + ".1",
            carlo::manual_page("carlo-" + c.about.name, carlo::help_page(c), carlo::version, {"carlo"}));
  write("carlo.bash", carlo::bash_completion(all));
  write("_carlo", carlo::zsh_completion(all));
  write("carlo.fish", carlo::fish_completion(all));
}

} // namespace

int main(int argc, char** argv) {
  try {
    mc::require(argc == 2, "usage: carlo_documents FOLDER");
    std::filesystem::create_directories(argv[1]);
    write_all(argv[1]);
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "carlo_documents: %s\n", e.what());
    return 2;
  }
}

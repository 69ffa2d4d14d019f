#include <process/child.h>
#include <process/temporary_folder.h>
#include <report/plot.h>

#include <mc/core/error.h>
#include <mc/core/file.h>

#include <string_view>
#include <system_error>

namespace carlo {

namespace fs = std::filesystem;

namespace {

std::string_view trimmed(std::string_view text) {
  return text.substr(0, text.find_last_not_of(" \n") + 1); // empty for blanks alone
}

// Returns the last line of gnuplot's output, the error message; earlier lines show the context.
std::string last_line(const std::string& log) {
  const std::string_view text = trimmed(log);
  return std::string(text.substr(text.rfind('\n') + 1)); // starts at 0 if there is no line feed
}

// Whether a picture is complete. On a full disk gnuplot writes a part and exits with 0.
bool is_whole(std::string_view picture, std::string_view kind) {
  return kind == "svg" ? trimmed(picture).ends_with("</svg>") : picture.ends_with("IEND\xAE\x42\x60\x82");
}

} // namespace

void remove_plot(const fs::path& folder, const std::string& name) {
  for (const char* kind : {".svg", ".png"}) {
    std::error_code none; // ignored: the file does not exist, or cannot be removed and so could not be written either
    fs::remove(folder / (name + kind), none);
  }
}

bool draw_plot(const fs::path& folder, const std::string& name, const std::vector<std::string>& data) {
  const TemporaryFolder own;
  const std::string script = name + ".gp", log = own.file("log");
  fs::create_symlink(fs::absolute(folder / script), own.file(script));
  for (const std::string& file : data) fs::create_symlink(fs::absolute(folder / file), own.file(file));
  // One process draws both, since gnuplot takes long to start.
  const std::optional<int> code =
      run_program({{"gnuplot", "-e", "kind=\"svg\"", script, "-e", "reset; kind=\"png\"", script}, own.file(""), log});
  if (!code) {
    remove_plot(folder, name);
    return false;
  }
  mc::require(*code == 0, "gnuplot cannot draw '{}': {}; run gnuplot {} there to see more", (folder / script).string(),
              last_line(mc::read_file(log)), script);
  for (const std::string kind : {"svg", "png"}) {
    const std::string picture = fmt::format("{}.{}", name, kind);
    const std::string bytes = fs::exists(own.file(picture)) ? mc::read_file(own.file(picture)) : std::string();
    mc::require(is_whole(bytes, kind),
                "gnuplot drew only a part of '{}' in '{}'; is the disk full? Set TMPDIR to a folder on another",
                picture, own.file(""));
    mc::write_file((folder / picture).string(), bytes);
  }
  return true;
}

std::string plot_header(const std::string& name, int width, int height) {
  return fmt::format(R"(# gnuplot {0}.gp writes {0}.svg and {0}.png
if (!exists("kind")) kind = "svg"
if (kind eq "svg") set terminal svg size {1},{2} font "sans-serif,13" background "white"; set output "{0}.svg"
if (kind eq "png") set terminal pngcairo size {1},{2} font "sans-serif,11" background "white"; set output "{0}.png"
set datafile separator ","
set border 3 lc rgb "#666666"
set tics nomirror out
set grid lc rgb "#e6e6e6" lt 1
)",
                     name, width, height);
}

} // namespace carlo

#include <process/child.h>
#include <report/plot.h>

#include <mc/core/error.h>

namespace carlo {

bool draw_plot(const std::filesystem::path& folder, const std::string& name) {
  const std::filesystem::path log = std::filesystem::absolute(folder) / (name + ".log");
  for (const char* kind : {"svg", "png"}) {
    const std::optional<int> code =
        run_program({{"gnuplot", "-e", fmt::format("kind=\"{}\"", kind), name + ".gp"}, folder.string(), log.string()});
    if (!code) return false;
    mc::require(*code == 0, "gnuplot failed on {}; see {}", (folder / (name + ".gp")).string(), log.string());
  }
  std::filesystem::remove(log);
  return true;
}

std::string plot_head(const std::string& name, int width, int height) {
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

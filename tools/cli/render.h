#pragma once
/// carlo render: a scene to an image with an error bar.

#include <options/checkpoint_options.h>
#include <options/subcommand.h>

#include <cstddef>

namespace carlo {

struct RenderCommandOptions {
  std::string scene;                  ///< a file, or the name of a scene of the gallery
  bool help_scene = false;            ///< print the reference of scene files, and stop
  bool list_strategies = false;       ///< print the strategies, and stop
  std::string dialect = "mitsuba";    ///< the renderer whose defaults apply to the scene
  std::vector<std::string> variables; ///< "name=value" of the scene's $name
  std::string output;                 ///< empty: the scene's name with .exr in the current folder
  std::optional<int> spp;             ///< samples per pixel
  std::optional<double> seconds;      ///< wall-clock budget [s]
  std::optional<double> target_error; ///< mean relative standard error to reach
  std::string error_of;               ///< "picture" or "worst"; empty: picture
  std::string adaptive;               ///< on or off; empty: on
  std::string report;                 ///< folder of a page; empty: none
  std::string intervals;              ///< file for the half widths of 95 % intervals; empty: none
  std::string size;                   ///< "WxH"; empty: the scene's
  std::string crop;                   ///< "X,Y,W,H"; empty: the whole picture
  std::string strategy, sampler;      ///< empty: mis+lt, sobol
  std::optional<int> max_depth;       ///< longest path in edges; -1: unlimited
  std::optional<int> branches;        ///< of a path; none: librender's default
  std::uint64_t seed = 0;
  int threads = 0;                   ///< 0: all
  std::optional<double> memory;      ///< [GiB]
  std::string splat;                 ///< on or off: samples count for all pixels under the filter; empty: on
  std::string tiles;                 ///< on or off: 2x2 pixels share paths; empty: the pilot chooses
  std::string tone;                  ///< curve of a PNG; empty: the gallery's, or clamp
  std::string exposure;              ///< of a PNG: stops, or auto; empty: the gallery's, or 0
  bool layers = false;               ///< EXR only: more channels
  std::optional<std::string> resume; ///< a checkpoint, or a picture to add to; "": the picture of `output`
  CheckpointFiles checkpoint;        ///< its field `resume` is not used
  bool compare_strategies = false;
  bool allow_invalid = false; ///< write the image although samples were not finite
  std::string command;        ///< the command line, for the metadata
};

/// The options as rows of --help, and its texts.
std::vector<Option> render_rows(RenderCommandOptions& options);
About render_about();

/// A row for each strategy: its name, how it finds light, and when to use it.
std::string strategies_text(std::size_t columns);

} // namespace carlo

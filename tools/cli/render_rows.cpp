/// The options of carlo render and the texts of its help.

#include <cli/render.h>
#include <options/memory_option.h>
#include <terminal/columns.h>

#include <render/integrator/strategy.h>

#include <fmt/format.h>

namespace carlo {

namespace {

constexpr const char* spp_reason = "--time and --target-error choose the number of samples";
constexpr const char* strip_reason = "--compare-strategies writes a strip of small pictures with equal work";

OptionGroup common_group(RenderCommandOptions& o) {
  return {
      common_options,
      {
          input_file({"SCENE", "FILE", &o.scene,
                      "Scene file (Mitsuba XML), a mesh alone (.obj, .ply, .serialized), or a name from carlo gallery "
                      "--list."}),
          output_file({"-o,--output", "FILE", &o.output,
                       "Image to write: .exr (radiance and variance), .pfm or .png (sRGB). Default: SCENE.exr in this "
                       "folder."}),
          {"--spp", "N", &o.spp, "Samples per pixel. Default: the scene's."},
          {"--time", "SECONDS", &o.seconds, "Render for this wall-clock time.", false, {{"--spp", spp_reason}}},
          {"--target-error",
           "RATIO",
           &o.target_error,
           "Render until the mean relative standard error of the pixels is at most this: 0.02 is 2 %. May take long; "
           "--time bounds it.",
           false,
           {{"--spp", spp_reason}}},
          {"--size", "WxH", &o.size, "Image size in pixels. Default: the scene's."},
          {"--seed", "N", &o.seed,
           "Seed of the random numbers. The same seed gives the same bits, for any number of threads."},
          {"--list-strategies", "", &o.list_strategies, "Explain each strategy in a line, and stop."},
          {"--help-scene", "", &o.help_scene, "Print the reference of scene files as Markdown, and stop."},
      }};
}

OptionGroup sampling_group(RenderCommandOptions& o) {
  return {"Sampling",
          {
              {"--strategy", "NAME", &o.strategy,
               fmt::format("How paths find light: {}; see --list-strategies. Default: mis+lt.",
                           fmt::join(render::strategy_names(), ", "))},
              {"--sampler", "NAME", &o.sampler,
               "Point set of the pixels: independent, stratified or sobol. Default: sobol."},
              {"--adaptive", "on|off", &o.adaptive,
               "Take more samples where the error is larger, as the first 16 of every pixel (the pilot) estimate it. "
               "Default: on."},
              {"--splat", "on|off", &o.splat,
               "Add each sample to all pixels under the scene's filter: less noise for filters wider than a pixel, "
               "but correlated between neighbours. Default: on."},
              {"--tiles", "on|off", &o.tiles,
               "Share paths within tiles of 2x2 pixels: less time to an error on diffuse walls, with noise correlated "
               "within a tile. Default: on where the pilot of --adaptive finds that it pays."},
              {"--branches", "N", &o.branches,
               "Split each path N ways at its first hit that is neither mirror nor smooth glass. Not with --tiles on. "
               "Default: 1 or 2, whichever the pilot finds better; 2 without one."},
              {"--max-depth", "N", &o.max_depth,
               "Longest path in edges: 1 is light seen directly, -1 no limit. Default: the scene's."},
          }};
}

OptionGroup image_group(RenderCommandOptions& o) {
  return {"Image",
          {
              {"--crop", "X,Y,W,H", &o.crop,
               "Render only this part, from pixel X, Y counted from the upper left corner. With --spp and --adaptive "
               "off the pixels are those of the whole picture, bit for bit."},
              {"--tone", "CURVE", &o.tone,
               "Curve of a PNG for bright light: clamp, reinhard or filmic. Default: the gallery scene's, else clamp."},
              {"--exposure", "STOPS", &o.exposure,
               "Brightness of a PNG in stops, or auto. Default: the gallery scene's, else 0."},
              output_file({"--intervals", "FILE", &o.intervals,
                           "Write half the widths of the pixels' 95 % confidence intervals to this image."}),
              output_folder({"--report",
                             "FOLDER",
                             &o.report,
                             "Keep a page in this folder (index.html) while the render runs: the picture so far, the "
                             "error against time, and what remains.",
                             false,
                             {{"--compare-strategies", "--compare-strategies has no page"}}},
                            {"index.html"}),
              {"--layers", "", &o.layers,
               "Add channels to an EXR: normal N, position P, depth Z, albedo and shape id at the centre of each "
               "pixel."},
          }};
}

OptionGroup expert_group(RenderCommandOptions& o) {
  OptionGroup group = {
      expert_options,
      {
          {"--resume", "[FILE]", &o.resume,
           "Go on from this file: from a checkpoint, also with a larger --spp, or from a picture (.exr) of the same "
           "scene and size, whose samples are averaged with the new ones of --spp or --time. Default: the picture "
           "of -o."},
          {"--compare-strategies",
           "",
           &o.compare_strategies,
           "Print the error of every strategy with equal samples and with equal time, and write a PNG strip of "
           "their pictures with 1 to 1024 samples per pixel.",
           false,
           {{"--resume", strip_reason},
            {"--layers", strip_reason},
            {"--intervals", strip_reason},
            {"--target-error", strip_reason},
            {"--checkpoint", strip_reason}}},
          {"--error-of", "picture|worst", &o.error_of,
           "The error that --target-error bounds: of the picture, or of its worst block of 16x16 pixels. Default: "
           "picture."},
          {"-D", "NAME=VALUE", &o.variables, "Value of $NAME in the scene. May be repeated."},
          {"--dialect", "NAME", &o.dialect, "Renderer whose defaults apply to the scene: mitsuba or lajolla."},
          {"--threads", "N", &o.threads, "Threads; 0 is all processors."},
          memory_option(o.memory),
          {"--allow-invalid", "", &o.allow_invalid,
           "Write the image although some samples were not finite. They are left out."},
      }};
  const std::vector<Option> files = checkpoint_rows(o.checkpoint, {"--time", "--compare-strategies"});
  group.options.insert(group.options.begin(), files.begin(), files.end());
  return group;
}

std::vector<HelpSection> render_sections() {
  return {
      {"Which option when",
       {
           {"--strategy", "mis+lt for any scene; mis to compare with other path tracers; nee for diffuse rooms with "
                          "small lights. The others show how a single technique works or fails."},
           {"--adaptive off", "The same number of samples in every pixel, as to compare with other programs."},
           {"--splat off", "Noise that is independent between pixels, as denoisers expect it; with --tiles off."},
           {"--tiles on", "Rooms with diffuse walls. Not for many small objects, where neighbouring pixels show "
                          "different ones."},
           {"--branches", "2 for indirect light on diffuse surfaces; 1 for the most samples per second."},
           {"", "docs/methods/choosing.md tells more."},
       }},
      {"The target error",
       {
           {"",
            "The error of the picture is the root mean square of the pixels' standard errors, each relative to the "
            "radiance around the pixel, at least half of the picture's mean. It is reached when an upper bound with "
            "95 % confidence is below --target-error. The bound allows for brighter samples than any so far. A picture "
            "takes at least 16 samples per pixel and 100,000 in all, so that rare bright light is met. Where --time "
            "ends first, the picture is written, and the exit code is 0."},
       }},
  };
}

} // namespace

std::vector<Option> render_rows(RenderCommandOptions& options) {
  return in_groups({common_group(options), sampling_group(options), image_group(options), expert_group(options)});
}

About render_about() {
  return {.name = "render",
          .summary = "Render a scene to EXR, PFM or PNG, with an error bar for every pixel",
          .examples = {{"carlo render cbox --spp 64", "renders the Cornell box with 64 samples per pixel to cbox.exr"},
                       {"carlo render scene.xml --target-error 0.02 --time 600 -o a.exr",
                        "renders until the error is 2 %, at most ten minutes"},
                       {"carlo render cbox --compare-strategies -o strip.png",
                        "compares the strategies by their errors and pictures"}},
          .sections = render_sections()};
}

std::string strategies_text(std::size_t columns) {
  std::string text;
  for (const render::Strategy& s : render::strategies)
    text += term_row(s.name, fmt::format("{}\n{}", s.summary, s.use), columns, 0, 12);
  return text;
}

} // namespace carlo

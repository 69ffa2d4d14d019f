#pragma once
/// Options that the subcommands which measure integrals and scenes have in common.

#include <converge/pictures.h>
#include <options/subcommand.h>

#include <optional>
#include <string>
#include <vector>

namespace carlo {

struct IntegralOptions {
  std::vector<std::string> integrands; ///< names, groups, or an expression
  std::string domain;                  ///< of an expression
  std::string plugin;                  ///< or the integrands of this shared object
  std::optional<double> timeout;       ///< seconds that its process may take; see Limits
  std::optional<double> memory;        ///< GiB likewise
  std::uint64_t max_n = 1 << 18;       ///< evaluations at most
  bool list = false;
  bool operator==(const IntegralOptions&) const = default;
};

/// Rows for the common options, and the options of plugins.
std::vector<Option> integral_rows(IntegralOptions& o);
OptionGroup plugin_group(IntegralOptions& o);

/// The integrands asked for; those of the books when none is.
///   throws : Error for what means nothing, a bad number, and for what find_integrand and plugin_targets refuse
std::vector<Target> targets_of(const IntegralOptions& o);

/// Prints the integrands and the ways to sample them.
int list_integrals();

struct SceneOptions {
  std::string strategies; ///< empty: of mixture, nee, mis and mis+lt those that find every light
  std::string depths;     ///< longest paths; empty: the scene's
  std::string size;       ///< "WxH"; empty: 48 pixels wide
  int max_spp = 64;
  std::string cost = "cpu"; ///< or rays
  bool operator==(const SceneOptions&) const = default;
};

OptionGroup scene_group(SceneOptions& o);

/// Throws Error where one of them is given for an integral.
void refuse_scene_options(const SceneOptions& o);

/// Throws Error where any other of them than the target is given, for a scene.
void refuse_integral_options(const IntegralOptions& o);

/// Whether the one word that stands for a target is a scene file: it ends in .xml.
bool is_scene(const std::vector<std::string>& words);

/// Everything of a run that is not the scene's own.
struct SceneRun {
  std::string path;
  std::string samplers;   ///< comma-separated; empty: all
  bool to_choose = false; ///< every way with adaptive spending, splats and tiles, too, and plain_way
  bool all = false;       ///< every strategy that finds every light, adaptive spending, splats and tiles, too
  int pictures = 0;       ///< behind each error; 0: as many as make it known to 10 %
  double seconds = 0;     ///< stop at fewer samples where these run out; 0: never
  std::uint64_t seed = 1;
  int threads = 0;
  const std::atomic<bool>* cancel = nullptr;
};

/// What summary and the tables call the scene.
Target scene_target(const std::string& path);

/// Measures every strategy, sampler and longest path, with progress on a terminal.
///   throws : Error for a scene that cannot be read or is black, an unknown name, or a bad number
Pictures measure_scene(const SceneOptions& o, const SceneRun& run);

/// "  reference: ..." and a line for each way whose bias is told from 0.
std::string about_pictures(const Pictures& pictures);

/// How far they came that were interrupted.
std::string interrupted_pictures(const Pictures& pictures);

} // namespace carlo

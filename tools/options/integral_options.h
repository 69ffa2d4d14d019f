#pragma once
/// Options shared by the subcommands that measure integrals and scenes.

#include <converge/picture_measurement.h>
#include <integrands/expression_integral.h>
#include <options/foreign_options.h>
#include <options/subcommand.h>

#include <optional>
#include <string>
#include <vector>

namespace carlo {

struct IntegralOptions {
  std::vector<std::string> integrands; ///< names, groups, or an expression
  ExpressionContext expression;        ///< domain and names of an expression
  ForeignOptions foreign;              ///< integrands of the user's own code instead
  std::uint64_t max_n = 1 << 18;       ///< evaluations at most
  bool list = false;
  bool operator==(const IntegralOptions&) const = default;
};

/// Rows for the common options. `names` begins the description of the integrands.
std::vector<Option> integral_option_rows(IntegralOptions& o, const std::string& names);

/// The named integrands; without a name the group books.
///   throws : Error for an unknown name, a bad number, and as find_integrand and foreign_targets.
std::vector<IntegralTarget> targets_of(const IntegralOptions& o);

/// Prints the integrands and the methods.
int list_integrals();

struct SceneOptions {
  std::string strategies; ///< empty: the subset of mixture, nee, mis, mis+lt that finds every light
  std::string depths;     ///< longest paths; empty: the scene's
  std::string size;       ///< "WxH"; empty: 48 pixels wide
  int max_spp = 64;
  std::string cost = "cpu"; ///< or rays
  bool operator==(const SceneOptions&) const = default;
};

OptionGroup scene_group(SceneOptions& o);

/// Throws Error where an option of scenes is given for an integral.
void refuse_scene_options(const SceneOptions& o);

/// Throws Error where an option of integrals is given for a scene.
void refuse_integral_options(const IntegralOptions& o);

/// Whether the target is a scene file: one word that ends in .xml.
bool is_scene(const std::vector<std::string>& words);

/// A request to measure a scene.
struct SceneMeasureRequest {
  std::string path;
  std::string samplers;   ///< comma-separated; empty: all
  bool for_trade = false; ///< also adaptive sampling, splats and tiles, and plain_mc_method
  bool all = false;       ///< every strategy that finds every light, adaptive sampling, splats and tiles
  int pictures = 0;       ///< pictures per error; 0: enough for a relative error of 10 %
  double seconds = 0;     ///< wall-clock budget; 0: none
  std::uint64_t seed = 1;
  int threads = 0;
  const std::atomic<bool>* cancel = nullptr;
  mc::Checkpoint* checkpoint = nullptr;
  mc::Executor executor = {};
};

/// Everything that a measurement depends on, for its checkpoints: the options, and the files of a scene.
///   words : the integrands, or the scene.
mc::RunIdentity measurement_identity(const std::vector<Option>& options, const std::vector<std::string>& words);

/// A placeholder target for a scene in summaries and tables.
IntegralTarget scene_target(const std::string& path);

/// Measures every strategy, sampler and longest path, with progress on a terminal.
///   throws : Error for a scene that cannot be read or is black, an unknown name, or a bad number.
PictureMeasurement measure_scene(const SceneOptions& o, const SceneMeasureRequest& run);

/// A line about the reference, and one for each method with a significant bias.
std::string bias_summary(const PictureMeasurement& pictures);

/// A line about the progress of interrupted measurements.
std::string interruption_summary(const PictureMeasurement& pictures);

} // namespace carlo

#include <cli/validate_input.h>
#include <input/samples_file.h>
#include <plugin/command.h>
#include <plugin/plugin.h>

#include <mc/check/check_subject.h>
#include <mc/core/error.h>
#include <mc/core/text.h>

#include <cmath>

namespace carlo {

namespace {

int uniforms_of(const ValidateCommandOptions& o) {
  if (o.uniforms.empty()) return 0;
  mc::require(!o.sampler_command.empty(), "validate: --uniforms {} is for a --command", o.uniforms);
  if (o.uniforms == "own") return CommandDistribution::own_numbers;
  const std::optional<double> n = mc::parse_double(o.uniforms);
  mc::require(n && *n >= 0 && *n == std::floor(*n) && *n < 1e6,
              "validate: --uniforms '{}' must be a number, or own for random numbers of the program", o.uniforms);
  return static_cast<int>(*n);
}

} // namespace

UserInput read_user_input(const ValidateCommandOptions& o, const std::atomic<bool>* cancel) {
  mc::require(int(!o.plugin.empty()) + int(!o.samples_file.empty()) + int(!o.sampler_command.empty()) <= 1,
              "validate: give one of --plugin, --command and --samples-file");
  mc::require(o.sampler_command.empty() || !o.domain.empty(), "validate: --command needs the --domain of its samples");
  mc::require(o.domain.empty() || !o.samples_file.empty() || !o.sampler_command.empty(),
              "validate: --domain is for a --command or a --samples-file");
  mc::require(!o.unnormalized || !o.pdf.empty() || !o.pdf_file.empty(),
              "validate: --unnormalized is for a density of a --samples-file, from --pdf or --pdf-file");
  mc::require(!o.dependent || !o.samples_file.empty(), "validate: --dependent is for the rows of a --samples-file");
  const int uniforms = uniforms_of(o);
  mc::require(!o.log_density || !o.pdf.empty() || !o.sampler_command.empty(),
              "validate: --log-density is for a --pdf or a --command");
  mc::require(o.thin.empty() || !o.samples_file.empty(), "validate: --thin is for the rows of a --samples-file");
  mc::require(o.thin.empty() || o.pdf_file.empty(), "validate: --thin needs a --pdf");
  mc::require(o.parameters.empty() || !o.plugin.empty(), "validate: --params sets parameters of a --plugin");
  mc::require(o.random_parameters >= 0 && o.random_parameters <= 10000 &&
                  (o.random_parameters == 0 || !o.plugin.empty()),
              "validate: --random-params {} is for a --plugin, and at most 10000", o.random_parameters);
  mc::require((o.pdf_file.empty() && o.pdf.empty()) || !o.samples_file.empty(),
              "validate: {} needs samples to compare with: --samples-file", o.pdf.empty() ? "--pdf-file" : "--pdf");
  mc::require(o.pdf_file.empty() || o.pdf.empty(), "validate: give --pdf-file or --pdf, not both");
  mc::require(o.breaks.empty() || !o.pdf.empty() || !o.sampler_command.empty(),
              "validate: --breaks is for a --pdf or a --command");
  UserInput user_input;
  const bool is_foreign = !o.plugin.empty() || !o.sampler_command.empty();
  std::optional<double> timeout = o.timeout;
  // A wanted error decides the number of samples, so it also decides the time that they may take.
  if (o.detect && !timeout && is_foreign && *o.detect > 0)
    timeout = 60 + 1e-5 * static_cast<double>(mc::samples_to_detect(*o.detect, o.alpha));
  const WorkerOptions worker{
      .limits = resource_limits(timeout, o.memory, is_foreign), .program = o.worker, .cancel = cancel};
  if (!o.plugin.empty())
    user_input.cases = plugin_cases(o.plugin, o.parameters, o.names, worker, {o.random_parameters, o.seed});
  if (!o.sampler_command.empty())
    user_input.cases.push_back(command_case({o.sampler_command, o.domain, o.breaks, uniforms, o.log_density}, worker));
  if (!o.samples_file.empty()) {
    const SamplesFileCase file = samples_file_case(
        {o.samples_file, o.pdf_file, o.pdf, o.domain, o.breaks, o.unnormalized, o.dependent, o.log_density, o.thin});
    if (!file.note.empty()) fmt::print("{}\n", file.note);
    user_input.cases.push_back(file.one);
    user_input.samples = file.samples;
  }
  return user_input;
}

} // namespace carlo

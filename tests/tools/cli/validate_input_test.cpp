#include <cli/validate_input.h>

#include <support/files.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using carlo::ValidateCommandOptions;
using testing::HasSubstr;

std::string refusal_of_input(const ValidateCommandOptions& o) {
  const std::atomic<bool> cancel = false;
  return support::error_of([&] { carlo::read_user_input(o, &cancel); });
}

TEST(ValidateInput, WithoutCodeOrSamples_IsEmpty) {
  const std::atomic<bool> cancel = false;
  EXPECT_TRUE(carlo::read_user_input({}, &cancel).cases.empty());
}

// One line for each option that needs another.
TEST(ValidateInput, LonelyOptions_AreRefused) {
  ValidateCommandOptions program, file;
  program.sampler_command = "true";
  file.samples_file = "s.csv";
  EXPECT_THAT(refusal_of_input(program), HasSubstr("--command needs the --domain of its samples"));
  program.domain = "disk";
  program.thin = "auto";
  EXPECT_THAT(refusal_of_input(program), HasSubstr("--thin is for the rows of a --samples-file"));
  program.thin.clear();
  program.random_parameters = 3;
  EXPECT_THAT(refusal_of_input(program), HasSubstr("--random-params 3 is for a --plugin"));
  program.random_parameters = 0;
  program.uniforms = "2.5";
  EXPECT_THAT(refusal_of_input(program), HasSubstr("--uniforms '2.5' must be a number, or own"));
  file.uniforms = "own";
  EXPECT_THAT(refusal_of_input(file), HasSubstr("--uniforms own is for a --command"));
  file.uniforms.clear();
  file.log_density = true;
  EXPECT_THAT(refusal_of_input(file), HasSubstr("--log-density is for a --pdf or a --command"));
  file.log_density = false;
  file.pdf_file = "p.csv";
  file.thin = "10";
  EXPECT_THAT(refusal_of_input(file), HasSubstr("--thin needs a --pdf"));
}

} // namespace

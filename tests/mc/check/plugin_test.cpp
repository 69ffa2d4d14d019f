#include <mc/check/plugin.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdlib>
#include <string>

namespace {

// Plugins in other languages copy this layout: a change requires a new MC_PLUGIN_ABI.
TEST(PluginHeader, LayoutOfVersionOne) {
  ASSERT_EQ(sizeof(void*), 8u);
  EXPECT_EQ(sizeof(mc_parameter), 32u);
  EXPECT_EQ(offsetof(mc_sampler, name), 0u);
  EXPECT_EQ(offsetof(mc_sampler, domain), 8u);
  EXPECT_EQ(offsetof(mc_sampler, lo), 16u);
  EXPECT_EQ(offsetof(mc_sampler, hi), 40u);
  EXPECT_EQ(offsetof(mc_sampler, uniforms), 64u);
  EXPECT_EQ(offsetof(mc_sampler, parameters), 80u);
  EXPECT_EQ(offsetof(mc_sampler, pdf_tolerance), 88u);
  EXPECT_EQ(offsetof(mc_sampler, create), 112u);
  EXPECT_EQ(offsetof(mc_sampler, sample), 128u);
  EXPECT_EQ(offsetof(mc_sampler, weight), 160u);
  EXPECT_EQ(offsetof(mc_sampler, parts), 168u);
  EXPECT_EQ(offsetof(mc_plugin_info, integrand_size), 24u);
}

TEST(PluginHeader, LayoutOfVersionTwo) {
  EXPECT_EQ(offsetof(mc_sampler, outcomes), 176u);
  EXPECT_EQ(offsetof(mc_sampler, probability), 184u);
  EXPECT_EQ(offsetof(mc_sampler, breaks), 192u);
  EXPECT_EQ(offsetof(mc_integrand, dim), 16u);
  EXPECT_EQ(offsetof(mc_integrand, truth), 24u);
  EXPECT_EQ(offsetof(mc_integrand, eval), 48u);
  EXPECT_EQ(sizeof(mc_plugin_info), 40u);
}

TEST(PluginHeader, LayoutOfVersionThree) {
  EXPECT_EQ(offsetof(mc_integrand, outputs), 64u); // the size of version 2
  EXPECT_EQ(offsetof(mc_integrand, uniforms), 68u);
  EXPECT_EQ(offsetof(mc_integrand, output_names), 72u);
  EXPECT_EQ(offsetof(mc_integrand, truths), 80u);
  EXPECT_EQ(offsetof(mc_integrand, eval_outputs), 88u);
  EXPECT_EQ(offsetof(mc_integrand, sample), 96u);
  EXPECT_EQ(offsetof(mc_integrand, pdf), 104u);
  EXPECT_EQ(sizeof(mc_integrand), 112u);
}

TEST(PluginHeader, LayoutOfVersionFour) {
  ASSERT_EQ(MC_PLUGIN_ABI, 4);
  EXPECT_EQ(offsetof(mc_sampler, sample_stream), 200u); // the size of versions 2 and 3
  EXPECT_EQ(sizeof(mc_sampler), 208u);
}

TEST(PluginHeader, CompilesAsC99) {
  const std::string command =
      "printf '#include <mc/check/plugin.h>\\n' | '" MC_CXX_COMPILER
      "' -x c -std=c99 -pedantic-errors -Wall -Wextra -Werror -fsyntax-only -I'" MC_SOURCE_DIR "/libmc' -";
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
}

} // namespace

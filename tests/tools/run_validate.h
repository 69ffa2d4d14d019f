#pragma once
// Calls carlo validate and keeps what it says.

#include <cli/commands.h>

#include <support/files.h>

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace support {

struct Output {
  int code;
  std::string text;
};
inline Output run(const carlo::ValidateOptions& o) {
  testing::internal::CaptureStdout();
  const int code = carlo::validate(o);
  std::fflush(stdout);
  return {code, testing::internal::GetCapturedStdout()};
}

/// What carlo complains about, a single line; "" when it does not.
inline std::string refusal(const carlo::ValidateOptions& o) {
  testing::internal::CaptureStdout();
  const std::string text = error_of([&] { carlo::validate(o); });
  std::fflush(stdout);
  testing::internal::GetCapturedStdout();
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  return text;
}

} // namespace support

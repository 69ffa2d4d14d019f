#pragma once
// Calls a subcommand's function and keeps what it says.

#include <cli/slips.h>
#include <cli/validate.h>

#include <support/files.h>

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace support {

struct Output {
  int code;
  std::string text;
};

inline int call(carlo::ValidateOptions o) {
  o.worker = CARLO_PATH; // a test is no carlo
  return carlo::validate(o);
}
inline int call(const carlo::SlipsOptions& o) { return carlo::slips(o); }

template <class Options> Output run(const Options& o) {
  testing::internal::CaptureStdout();
  const int code = call(o);
  std::fflush(stdout);
  return {code, testing::internal::GetCapturedStdout()};
}

/// What carlo complains about, a single line; "" when it does not.
template <class Options> std::string refusal(const Options& o) {
  testing::internal::CaptureStdout();
  const std::string text = error_of([&] { call(o); });
  std::fflush(stdout);
  testing::internal::GetCapturedStdout();
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  return text;
}

} // namespace support

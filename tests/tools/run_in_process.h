#pragma once
// Calls a subcommand's function and captures its output.

#include <cli/known_bugs.h>
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

inline int call(carlo::ValidateCommandOptions o) {
  o.worker = CARLO_PATH; // the test program cannot act as a worker
  return carlo::run_validate(o);
}
inline int call(const carlo::KnownBugsCommandOptions& o) { return carlo::run_known_bugs(o); }

template <class Options> Output run(const Options& o) {
  testing::internal::CaptureStdout();
  const int code = call(o);
  std::fflush(stdout);
  return {code, testing::internal::GetCapturedStdout()};
}

/// The one-line error message; "" if there is no error.
template <class Options> std::string refusal(const Options& o) {
  testing::internal::CaptureStdout();
  const std::string text = error_of([&] { call(o); });
  std::fflush(stdout);
  testing::internal::GetCapturedStdout();
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  return text;
}

} // namespace support

// The file of a result, and standard output instead of a file.

#include <terminal/result_file.h>

#include <support/files.h>

#include <mc/core/file.h>

#include <cstdio>

namespace {

using carlo::ResultFile;

struct ResultFileTest : support::ScratchTest {};

TEST_F(ResultFileTest, Dash_IsStandardOutputWithNothingElse) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  std::printf("before ");
  carlo::ResultWriter results;
  {
    const ResultFile file("-");
    std::printf("words");
    file.write(results, true, "result");
    std::printf(" more");
  }
  std::printf(" after");
  std::fflush(stdout);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "before result after");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "words more");
}

TEST_F(ResultFileTest, Name_IsAFile) {
  const ResultFile file(path("r.json"));
  EXPECT_TRUE(file.is_wanted());
  EXPECT_FALSE(std::filesystem::exists(path("r.json"))) << "nothing is known yet";
  carlo::ResultWriter results;
  file.write(results, false, "result");
  results.finish();
  EXPECT_EQ(mc::read_file(path("r.json")), "result");
  EXPECT_FALSE(ResultFile("").is_wanted());
  EXPECT_NE(support::error_of([] { ResultFile("/nonexistent/r.json"); }), "");
}

} // namespace

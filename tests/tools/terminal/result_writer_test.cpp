// Results that are partial, and results that cannot be written.

#include <terminal/result_writer.h>

#include <mc/core/file.h>

#include <support/files.h>

#include <gmock/gmock.h>

#include <regex>

namespace {

namespace fs = std::filesystem;

using carlo::ResultWriter;

struct ResultWriterTest : support::ScratchTest {};

TEST_F(ResultWriterTest, PartialPath) {
  EXPECT_EQ(carlo::partial_path("a/b.exr"), "a/b.partial.exr");
  EXPECT_EQ(carlo::partial_path("b"), "b.partial");
  EXPECT_EQ(carlo::partial_path("b.tar.json"), "b.tar.partial.json");
}

TEST_F(ResultWriterTest, PartialResult_ReplacesNoFile) {
  ResultWriter results;
  EXPECT_EQ(results.write(path("a.json"), true, "first"), path("a.json")) << "nothing was there";
  testing::internal::CaptureStderr();
  EXPECT_EQ(results.write(path("a.json"), true, "second"), path("a.partial.json"));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "carlo: '" + path("a.json") +
                                                        "' stays as it was; this partial result is '" +
                                                        path("a.partial.json") + "'\n");
  EXPECT_EQ(results.write(path("a.json"), true, "third"), path("a.partial.json"));
  EXPECT_EQ(mc::read_file(path("a.json")), "first");
  EXPECT_EQ(mc::read_file(path("a.partial.json")), "third");
  EXPECT_EQ(results.write(path("a.json"), false, "whole"), path("a.json"));
  EXPECT_EQ(mc::read_file(path("a.json")), "whole");
  results.write("/dev/null", true, "nothing beside a device");
  results.finish();
}

TEST_F(ResultWriterTest, PartialFolder) {
  EXPECT_EQ(carlo::result_folder(folder, "a.csv", true), folder);
  write("a.csv", "whole");
  EXPECT_EQ(carlo::result_folder(folder, "a.csv", false), folder);
  EXPECT_EQ(carlo::result_folder(folder, "a.csv", true), folder / "partial");
  EXPECT_TRUE(fs::is_directory(folder / "partial"));
}

TEST_F(ResultWriterTest, VanishedFolder_ResultIsSavedAndTheNextIsWritten) {
  ResultWriter results;
  setenv("TMPDIR", folder.c_str(), 1);
  const std::string saved = results.write(path("gone/a.json"), false, "result");
  unsetenv("TMPDIR");
  EXPECT_EQ(mc::read_file(saved), "result");
  EXPECT_THAT(saved, testing::StartsWith(path("carlo.")));
  results.write(path("b.json"), false, "next");
  EXPECT_EQ(mc::read_file(path("b.json")), "next");
  results.attempt([] { throw mc::Error("no plot"); });
  EXPECT_EQ(support::error_of([&] { results.finish(); }),
            "cannot write '" + path("gone/a.json") + "': the folder '" + path("gone") +
                "' does not exist; create it first; the result is in '" + saved + "'\nno plot");
}

TEST_F(ResultWriterTest, Device_IsNotSavedElsewhere) {
  ResultWriter results;
  results.write("/dev/full", false, "result");
  EXPECT_EQ(support::error_of([&] { results.finish(); }), "cannot write '/dev/full': No space left on device");
}

} // namespace

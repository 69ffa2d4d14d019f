// Locks of files.

#include <terminal/file_lock.h>

#include <mc/core/file.h>

#include <support/files.h>

namespace {

struct FileLockTest : support::ScratchTest {};

TEST_F(FileLockTest, SecondLock_IsRefusedUntilTheFirstEnds) {
  const std::string file = write("a.exr", "x");
  const auto refusal = [&] { return support::error_of([&] { const carlo::FileLock second(file); }); };
  {
    const carlo::FileLock first(file);
    EXPECT_EQ(refusal(), "another run is working on '" + file + "'; wait for its end");
    mc::write_file(file, "a new file has a lock of its own");
    EXPECT_EQ(refusal(), "");
  }
  EXPECT_EQ(refusal(), "");
  EXPECT_EQ(support::error_of([&] { const carlo::FileLock none(path("none")); }),
            "cannot read '" + path("none") + "': No such file or directory");
}

} // namespace

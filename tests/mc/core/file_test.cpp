#include <mc/core/file.h>

#include <mc/core/error.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace fs = std::filesystem;

namespace {

struct FileTest : testing::Test {
  fs::path folder = fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }
  std::size_t files() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {})); }
};

std::string message(const std::function<void()>& f) {
  try {
    f();
  } catch (const mc::Error& e) {
    return e.what();
  }
  return "no error";
}

TEST_F(FileTest, WritesAndReadsBack) {
  const std::string path = folder / "a.txt", bytes("one\0two", 7);
  mc::write_file(path, bytes);
  EXPECT_EQ(mc::read_file(path), bytes);
  mc::write_file(path, "new");
  EXPECT_EQ(mc::read_file(path), "new");
  EXPECT_EQ(files(), 1u);
}

TEST_F(FileTest, AFailedWriteLeavesTheOldFile) {
  const std::string path = folder / "a.txt";
  mc::write_file(path, "old");
  EXPECT_THROW(mc::replace_file(path,
                                [](const std::string& temporary) {
                                  std::ofstream(temporary) << "half";
                                  throw mc::Error("interrupted");
                                }),
               mc::Error);
  EXPECT_EQ(mc::read_file(path), "old");
  EXPECT_EQ(files(), 1u) << "the temporary file is gone";
}

TEST_F(FileTest, SaysWhatToDo) {
  const std::string missing = folder / "none" / "a.txt";
  EXPECT_EQ(message([&] { mc::write_file(missing, "x"); }), "cannot write '" + missing + "': the folder '" +
                                                                (folder / "none").string() +
                                                                "' does not exist; create it first");
  EXPECT_EQ(message([&] { mc::write_file(folder, "x"); }),
            "cannot write '" + folder.string() + "': it is a folder; name a file in it");
  EXPECT_EQ(message([&] { mc::read_file(missing); }), "cannot read '" + missing + "': no such file");
}

TEST_F(FileTest, AskingWhetherAPlaceIsWritableLeavesNoTrace) {
  const std::string path = folder / "a.txt", missing = folder / "none" / "a.txt";
  mc::require_writable(path);
  EXPECT_EQ(files(), 0u);
  mc::write_file(path, "old");
  mc::require_writable(path);
  EXPECT_EQ(mc::read_file(path), "old");
  EXPECT_EQ(message([&] { mc::require_writable(missing); }), message([&] { mc::write_file(missing, "x"); }));
}

// /dev/full accepts the open and refuses the bytes, as a full disk does.
TEST_F(FileTest, AFullDiskIsAnError) {
  const std::string path = folder / "a.txt";
  EXPECT_EQ(message([&] {
              mc::replace_file(path, [&](const std::string& temporary) {
                fs::create_symlink("/dev/full", temporary);
                std::ofstream out(temporary);
                out << "x" << std::flush;
                mc::require(out.good(), "cannot write '{}': disk full", "a.txt");
              });
            }),
            "cannot write 'a.txt': disk full");
  EXPECT_EQ(files(), 0u);
}

} // namespace

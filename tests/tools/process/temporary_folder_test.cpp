// Temporary folders.

#include <process/temporary_folder.h>

#include <support/files.h>

namespace {

namespace fs = std::filesystem;

struct TemporaryFolderTest : support::ScratchTest {
  void TearDown() override {
    unsetenv("TMPDIR");
    ScratchTest::TearDown();
  }
};

TEST_F(TemporaryFolderTest, LiesInTmpdirAndIsRemoved) {
  setenv("TMPDIR", folder.c_str(), 1);
  std::string made;
  {
    const carlo::TemporaryFolder temporary;
    made = temporary.file("a");
    std::ofstream(made) << "x";
    EXPECT_EQ(fs::path(made).parent_path().parent_path(), folder);
  }
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST_F(TemporaryFolderTest, MissingTmpdir_TmpIsTaken) {
  setenv("TMPDIR", path("none").c_str(), 1);
  const carlo::TemporaryFolder temporary;
  EXPECT_TRUE(fs::is_directory(temporary.file("")));
}

} // namespace

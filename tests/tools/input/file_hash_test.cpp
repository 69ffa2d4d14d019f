#include <input/file_hash.h>

#include <support/files.h>

namespace {

using carlo::hash_of_files;

struct FileHash : support::ScratchTest {};

TEST_F(FileHash, DependsOnBytesAlone) {
  std::filesystem::create_directory(folder / "b");
  const std::string a = write("a", "12345678901"), same = write("b/c", "12345678901"),
                    other = write("d", "12345678902");
  EXPECT_EQ(hash_of_files({a}).size(), 16u);
  EXPECT_EQ(hash_of_files({a}), hash_of_files({same}));
  EXPECT_NE(hash_of_files({a}), hash_of_files({other}));
  EXPECT_EQ(hash_of_files({a, other}), hash_of_files({same, other}));
  EXPECT_NE(hash_of_files({a}), hash_of_files({a, same}));
  EXPECT_NE(hash_of_files({a}), hash_of_files({write("e", std::string("12345678901\0", 12))}));
  EXPECT_EQ(hash_of_files({path("none")}), "");
}

} // namespace

#include <mc/core/file.h>

#include <mc/core/error.h>

#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>
#include <thread>

namespace fs = std::filesystem;

namespace {

struct FileTest : testing::Test {
  fs::path folder = fs::path(testing::TempDir()) /
                    fmt::format("{}.{}", testing::UnitTest::GetInstance()->current_test_info()->name(), ::getpid());
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

TEST_F(FileTest, ExtensionsAreLowercase) {
  EXPECT_EQ(mc::lowercase_extension("a.b/c.tar.EXR"), ".exr");
  EXPECT_EQ(mc::lowercase_extension("a.b/c"), "");
  EXPECT_EQ(mc::lowercase_extension(""), "");
  EXPECT_EQ(mc::lowercase_extension("ü.Ü1"), ".Ü1");
}

TEST_F(FileTest, IsSamePathResolvesLinksAndDots) {
  const auto path = [&](const char* name) { return (folder / name).string(); };
  mc::write_file(path("a"), "a");
  fs::create_symlink(path("a"), path("link"));
  fs::create_directory(path("b"));
  EXPECT_TRUE(mc::is_same_path(path("a"), path("./b/../a")));
  EXPECT_TRUE(mc::is_same_path(path("a"), path("link")));
  EXPECT_TRUE(mc::is_same_path(path("none"), path("./none")));
  EXPECT_FALSE(mc::is_same_path(path("a"), path("none")));
  fs::create_hard_link(path("a"), path("hard"));
  EXPECT_TRUE(mc::is_same_path(path("a"), path("hard")));
  fs::create_symlink("new", path("to new"));
  EXPECT_TRUE(mc::is_same_path(path("new"), path("to new")));
  fs::create_symlink("circle", path("circle"));
  EXPECT_FALSE(mc::is_same_path(path("circle"), path("circle")));
  EXPECT_FALSE(mc::is_same_path(path("no folder/a"), path("a")));
}

TEST_F(FileTest, ReadTextDropsTheByteOrderMark) {
  const std::string path = folder / "a.txt";
  for (const char* text : {"", "a", "\xEF\xBB"}) {
    mc::write_file(path, text);
    EXPECT_EQ(mc::read_text(path), text);
    mc::write_file(path, std::string("\xEF\xBB\xBF") + text);
    EXPECT_EQ(mc::read_text(path), text);
  }
}

TEST_F(FileTest, AFailedWriteLeavesTheOldFile) {
  const std::string path = folder / "a.txt";
  mc::write_file(path, "old");
  EXPECT_THROW(mc::replace_file(path,
                                [](std::FILE* stream) {
                                  mc::write_bytes(stream, "half");
                                  throw mc::Error("interrupted");
                                }),
               mc::Error);
  EXPECT_EQ(mc::read_file(path), "old");
  EXPECT_EQ(files(), 1u) << "the temporary file is gone";
}

TEST_F(FileTest, ErrorsNameTheRemedy) {
  const std::string missing = folder / "none" / "a.txt";
  EXPECT_EQ(message([&] { mc::write_file(missing, "x"); }), "cannot write '" + missing + "': the folder '" +
                                                                (folder / "none").string() +
                                                                "' does not exist; create it first");
  EXPECT_EQ(message([&] { mc::write_file(folder, "x"); }),
            "cannot write '" + folder.string() + "': it is a folder; name a file in it");
  EXPECT_EQ(message([&] { mc::read_file(missing); }), "cannot read '" + missing + "': no such file");
  EXPECT_EQ(message([] { mc::read_file("/dev/zero"); }),
            "cannot read '/dev/zero': it is a device, which may have no end; name a file or a pipe");
}

TEST_F(FileTest, RequireWritableCreatesNothing) {
  const std::string path = folder / "a.txt", missing = folder / "none" / "a.txt";
  mc::require_writable(path);
  EXPECT_EQ(files(), 0u);
  mc::write_file(path, "old");
  mc::require_writable(path);
  EXPECT_EQ(mc::read_file(path), "old");
  EXPECT_EQ(message([&] { mc::require_writable(missing); }), message([&] { mc::write_file(missing, "x"); }));
}

TEST_F(FileTest, AnOutputFolderIsMade) {
  const fs::path made = mc::make_output_folder(folder / "a" / "b", "c.txt");
  EXPECT_EQ(made, folder / "a" / "b");
  EXPECT_TRUE(fs::is_directory(made));
  mc::write_file(made / "c.txt", "x");
  EXPECT_EQ(mc::make_output_folder(made, "c.txt"), made);
  EXPECT_EQ(message([&] { mc::make_output_folder(made / "c.txt", "d.txt"); }),
            "'" + (made / "c.txt").string() + "' is no folder and cannot be made one (Not a directory); name another");
  fs::create_directory(made / "d.txt");
  EXPECT_EQ(message([&] { mc::make_output_folder(made, "d.txt"); }),
            "cannot write '" + (made / "d.txt").string() + "': it is a folder; name a file in it");
}

// A limit of the file size fails a write as a full disk does.
TEST_F(FileTest, FullDisk_ThrowsAndKeepsTheOldFile) {
  const std::string path = folder / "a.txt";
  mc::write_file(path, "old");
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  for (const std::size_t size : {100u, 10'000u, 1'000'000u}) { // fails in a flush at the end, or before
    const rlimit limit{10, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
    const std::string text = message([&] { mc::write_file(path, std::string(size, 'x')); });
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_EQ(text, "cannot write '" + path + "': File too large");
    EXPECT_EQ(mc::read_file(path), "old");
    EXPECT_EQ(files(), 1u);
  }
}

TEST_F(FileTest, TheStreamCanSeek) {
  const std::string path = folder / "a.txt";
  const auto write = [](std::FILE* stream) {
    mc::write_bytes(stream, "0123");
    ASSERT_EQ(std::fseek(stream, 1, SEEK_SET), 0);
    mc::write_bytes(stream, "x");
    std::fseek(stream, 0, SEEK_END);
  };
  mc::replace_file(path, write);
  EXPECT_EQ(mc::read_file(path), "0x23");
  const int log = open(path.c_str(), O_WRONLY | O_TRUNC);
  mc::replace_file("/dev/fd/" + std::to_string(log), write);
  close(log);
  EXPECT_EQ(mc::read_file(path), "0x23");
}

// The name of the temporary file is random, the file is new and nobody else may write it.
TEST_F(FileTest, TheTemporaryFileCannotBePredicted) {
  const std::string path = folder / "a.txt";
  std::set<std::string> names;
  for (int i = 0; i < 20; ++i)
    mc::replace_file(path, [&](std::FILE* stream) {
      for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path() != path) names.insert(entry.path().filename());
      EXPECT_EQ(std::fputc('x', stream), 'x');
    });
  EXPECT_EQ(names.size(), 20u);
  for (const std::string& name : names) EXPECT_EQ(name.substr(0, 4), ".mc-");
  EXPECT_EQ(files(), 1u);
}

TEST_F(FileTest, RequireWritableTriesTheRealThing) {
  EXPECT_EQ(message([] { mc::require_writable("/proc/a.txt"); }).substr(0, 27), "cannot write '/proc/a.txt':");
  const std::string long_name = folder / std::string(250, 'a'), too_long = folder / std::string(256, 'a');
  mc::require_writable(long_name);
  mc::write_file(long_name, "x");
  EXPECT_EQ(files(), 1u);
  EXPECT_EQ(message([&] { mc::require_writable(too_long); }), "cannot write '" + too_long + "': File name too long");
}

TEST_F(FileTest, Link_IsFollowedAndKept) {
  const std::string path = folder / "a.txt", link = folder / "link.txt", chain = folder / "chain.txt";
  fs::create_directories(folder / "deep");
  fs::create_symlink("a.txt", link);
  fs::create_symlink("../link.txt", folder / "deep" / "up.txt");
  fs::create_symlink("deep/up.txt", chain);
  mc::write_file(chain, "through four names"); // the last target does not exist yet
  EXPECT_EQ(mc::read_file(path), "through four names");
  EXPECT_FALSE(fs::is_symlink(path));
  EXPECT_TRUE(fs::is_symlink(link) && fs::is_symlink(chain));
  fs::create_symlink("circle", folder / "circle");
  EXPECT_EQ(message([&] { mc::write_file(folder / "circle", "x"); }),
            "cannot write '" + (folder / "circle").string() + "': its links lead in a circle");
}

TEST_F(FileTest, KeepsPermissions) {
  const std::string path = folder / "a.txt";
  mc::write_file(path, "old");
  fs::permissions(path, fs::perms(0640));
  mc::write_file(path, "new");
  EXPECT_EQ(fs::status(path).permissions(), fs::perms(0640));
}

TEST_F(FileTest, NamedPipe_ReceivesTheBytesAndIsKept) {
  const std::string path = folder / "pipe.txt";
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  const int reader = open(path.c_str(), O_RDONLY | O_NONBLOCK); // needs no thread, because a pipe buffers 64 KiB
  ASSERT_GE(reader, 0);
  std::array<char, 64> buffer{};
  const auto received = [&] {
    const ssize_t n = read(reader, buffer.data(), buffer.size());
    return std::string(buffer.data(), n > 0 ? static_cast<std::size_t>(n) : 0);
  };
  mc::write_file(path, "bytes");
  EXPECT_EQ(received(), "bytes");
  mc::replace_file(path, [](std::FILE* stream) { mc::write_bytes(stream, "by stream"); });
  EXPECT_EQ(received(), "by stream");
  close(reader);
  EXPECT_TRUE(fs::is_fifo(path));
  EXPECT_EQ(files(), 1u);
}

TEST_F(FileTest, NamedPipe_IsReadFromASlowWriterAndRefusedWithoutOne) {
  const std::string path = folder / "pipe.txt";
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  std::thread writer([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    std::ofstream pipe(path);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    pipe << "late";
  });
  EXPECT_EQ(mc::read_file(path), "late");
  writer.join();
  EXPECT_EQ(message([&] { mc::read_file(path); }),
            "cannot read '" + path + "': it is a pipe, and no program wrote to it within 5 s");
}

TEST_F(FileTest, OpenDescriptor_IsWrittenAtItsOffset) {
  const std::string path = folder / "log.txt";
  const int log = open(path.c_str(), O_WRONLY | O_CREAT, 0600);
  ASSERT_EQ(write(log, "before ", 7), 7);
  mc::write_file("/dev/fd/" + std::to_string(log), "bytes");
  ASSERT_EQ(write(log, " after", 6), 6);
  close(log);
  EXPECT_EQ(mc::read_file(path), "before bytes after");
  EXPECT_EQ(message([&] { mc::write_file("/dev/fd/" + std::to_string(log), "x"); }),
            fmt::format("cannot write '/dev/fd/{0}': descriptor {0} is not open", log));
}

// Uses a device node like /dev/full, where opening succeeds and writing fails. Creating it needs root.
TEST_F(FileTest, Device_WriteFails_ThrowsAndKeepsTheDevice) {
  const std::string full = folder / "full.txt", null = folder / "null.txt";
  if (mknod(full.c_str(), S_IFCHR | 0666, makedev(1, 7)) != 0 ||
      mknod(null.c_str(), S_IFCHR | 0666, makedev(1, 3)) != 0 || !std::ofstream(null).is_open())
    GTEST_SKIP() << "device nodes cannot be made here";
  const std::string refused = "cannot write '" + full + "': No space left on device";
  EXPECT_EQ(message([&] { mc::write_file(full, "x"); }), refused);
  EXPECT_EQ(message([&] { mc::replace_file(full, [](std::FILE* stream) { mc::write_bytes(stream, "x"); }); }), refused);
  mc::write_file(null, "x");
  EXPECT_TRUE(fs::is_character_file(full) && fs::is_character_file(null));
  EXPECT_EQ(files(), 2u);
}

} // namespace

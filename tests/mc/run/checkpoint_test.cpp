#include <mc/run/checkpoint.h>

#include <mc/core/file.h>

#include <support/files.h>

#include <gmock/gmock.h>

#include <sys/resource.h>

#include <csignal>

namespace {

using mc::Checkpoint, mc::CheckpointOptions, mc::RunIdentity;
using support::error_of;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

const RunIdentity identity = {{"--seed", "1"}, {"the scene", "cbox"}, {"the build", "0.1"}};

struct CheckpointTest : support::ScratchTest {
  std::string file() const { return path("a.ckpt"); }
  CheckpointOptions to(std::vector<std::string>* warnings = nullptr) const {
    CheckpointOptions o{.file = file()};
    if (warnings) o.warn = [warnings](const std::string& text) { warnings->push_back(text); };
    return o;
  }
  CheckpointOptions from() const { return {.resume = file()}; }

  // Saves two numbers, the inner one within the section of the outer one.
  void save(int outer, int inner) const {
    Checkpoint checkpoint(to(), identity);
    const Checkpoint::Section a(&checkpoint, "outer", [&](auto& archive) { archive(outer); });
    const Checkpoint::Section b(&checkpoint, "inner", [&](auto& archive) { archive(inner); });
    checkpoint.save_and_wait();
  }
  std::string refusal(const RunIdentity& other) const {
    return error_of([&] { Checkpoint(from(), other); });
  }
};

TEST_F(CheckpointTest, RestoresNestedSections_OnceEach) {
  save(3, 4);
  Checkpoint checkpoint(from(), identity);
  int outer = 0, inner = 0, second = 0, next = 0;
  {
    const Checkpoint::Section a(&checkpoint, "outer", [&](auto& archive) { archive(outer); });
    EXPECT_TRUE(a.is_restored() && a.is_outermost());
    {
      const Checkpoint::Section b(&checkpoint, "inner", [&](auto& archive) { archive(inner); });
      EXPECT_TRUE(b.is_restored());
    }
    const Checkpoint::Section c(&checkpoint, "inner", [&](auto& archive) { archive(second); });
    EXPECT_FALSE(c.is_restored()) << "the file was saved in the first";
  }
  const Checkpoint::Section d(&checkpoint, "outer", [&](auto& archive) { archive(next); });
  EXPECT_FALSE(d.is_restored());
  EXPECT_EQ(outer, 3);
  EXPECT_EQ(inner, 4);
  EXPECT_EQ(second + next, 0);
}

TEST_F(CheckpointTest, AnotherSection_IsRefused) {
  save(3, 4);
  Checkpoint checkpoint(from(), identity);
  EXPECT_THAT(error_of([&] { Checkpoint::Section(&checkpoint, "other", [](auto&) {}); }),
              AllOf(HasSubstr("'outer'"), HasSubstr("'other'")));
}

TEST_F(CheckpointTest, AnotherRun_IsRefusedWithEveryFieldThatDiffers) {
  save(3, 4);
  EXPECT_EQ(refusal(identity), "");
  RunIdentity other = identity;
  other[0].second = "2";
  other[2].second = "0.2";
  EXPECT_EQ(refusal(other), "'" + file() +
                                "' is of another run: --seed was '1' and is '2' now; the build was '0.1' and is "
                                "'0.2' now; ask for the same, or start anew");
  other = identity;
  other.pop_back();
  other.push_back({"--size", "2x2\x1b[31m"});
  EXPECT_THAT(refusal(other), AllOf(HasSubstr("the build was '0.1' and is not given now"),
                                    HasSubstr("--size was not given and is '2x2?[31m' now")));
}

// A damaged bit, or a cut, at any place.
TEST_F(CheckpointTest, DamagedFiles_AreRefused) {
  save(3, 4);
  const std::string bytes = mc::read_file(file());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string damaged = bytes;
    damaged[i] = char(damaged[i] ^ (1 << i % 8));
    write("a.ckpt", damaged);
    EXPECT_THAT(refusal(identity), HasSubstr("a.ckpt' ")) << i;
    write("a.ckpt", bytes.substr(0, i));
    EXPECT_THAT(refusal(identity), HasSubstr("a.ckpt' ")) << i;
  }
  write("a.ckpt", bytes + '\0');
  EXPECT_THAT(refusal(identity), HasSubstr("is damaged: its checksum is wrong"));
  write("a.ckpt", "x,y\n1,2\n");
  EXPECT_THAT(refusal(identity), HasSubstr("is no checkpoint"));
  std::filesystem::remove(file());
  EXPECT_THAT(refusal(identity), HasSubstr("a.ckpt"));
}

TEST_F(CheckpointTest, UnwritableFile_IsRefusedBeforeTheWork) {
  EXPECT_THAT(error_of([&] { Checkpoint({.file = path("none/a.ckpt")}, identity); }), HasSubstr("none"));
  EXPECT_THAT(error_of([&] { Checkpoint({.file = file(), .every = -1}, identity); }), HasSubstr("-1"));
}

// A limit of the file size stands for the full disk.
TEST_F(CheckpointTest, FullDisk_KeepsTheOldFileAndWarns) {
  save(3, 4);
  const std::string old = mc::read_file(file());
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  std::vector<std::string> warnings;
  {
    Checkpoint checkpoint(to(&warnings), identity);
    const Checkpoint::Section a(&checkpoint, "big", [](auto& archive) {
      std::string big(100'000, 'x');
      archive(big);
    });
    const rlimit full{10'000, limit.rlim_max};
    setrlimit(RLIMIT_FSIZE, &full);
    checkpoint.save();
    checkpoint.save_and_wait();
    setrlimit(RLIMIT_FSIZE, &limit);
    EXPECT_EQ(warnings.size(), 2u);
    EXPECT_THAT(warnings.at(0), HasSubstr("a.ckpt"));
    EXPECT_EQ(mc::read_file(file()), old);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1) << "no temporary file stays";
    checkpoint.save_and_wait(); // the disk has room again
  }
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(warnings.size(), 2u);
  EXPECT_NE(mc::read_file(file()), old);
}

TEST_F(CheckpointTest, IsDue_AfterItsTimeAndWithAFile) {
  EXPECT_FALSE(Checkpoint({.file = file(), .every = 1e9}, identity).is_due());
  EXPECT_TRUE(Checkpoint({.file = file(), .every = 0}, identity).is_due());
  EXPECT_FALSE(Checkpoint({.every = 0}, identity).is_due());
  EXPECT_THAT(error_of([] { Checkpoint({}, {}).save_and_wait(); }), IsEmpty());
}

} // namespace

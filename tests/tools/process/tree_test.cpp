// The processes of a family and their memory: a parent that shares its memory with its fork, or does not.

#include <process/tree.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <vector>

namespace {

constexpr std::size_t held = 64 << 20;

// A child and a grandchild that live as long as the object. They hold `held` bytes, once if the grandchild shares them
// and twice if it writes its own copy.
class Family {
 public:
  explicit Family(bool shared) {
    int ready[2];
    if (pipe(ready) != 0) return;
    child_ = fork();
    if (child_ == 0) live(ready[1], shared);
    close(ready[1]);
    char byte;
    is_there_ = read(ready[0], &byte, 1) == 1;
    close(ready[0]);
  }
  ~Family() {
    for (const pid_t one : carlo::descendants(getpid())) kill(one, SIGKILL);
    waitpid(child_, nullptr, 0);
  }
  Family(const Family&) = delete;
  Family& operator=(const Family&) = delete;

  pid_t child() const { return child_; }
  bool is_there() const { return is_there_; }

 private:
  [[noreturn]] static void live(int ready, bool shared) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    auto* bytes = static_cast<volatile char*>(malloc(held));
    const auto fill = [&] {
      for (std::size_t i = 0; i < held; i += 4096) bytes[i] = 1;
    };
    fill();
    if (fork() == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (!shared) fill();
      for (const char byte = 1; write(ready, &byte, 1) != 1;) {
      }
    }
    for (;;) pause();
  }

  pid_t child_ = -1;
  bool is_there_ = false;
};

TEST(ProcessTree, DescendantsIncludeGrandchildren) {
  const Family family(true);
  ASSERT_TRUE(family.is_there());
  EXPECT_THAT(carlo::children(getpid()), testing::ElementsAre(family.child()));
  const std::vector<pid_t> all = carlo::descendants(getpid());
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0], family.child());
  EXPECT_THAT(carlo::children(all[0]), testing::ElementsAre(all[1]));
  EXPECT_THAT(carlo::descendants(all[1]), testing::IsEmpty());
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(ProcessTree, ProportionalBytesCountSharedMemoryOnce) {
  const Family family(true);
  ASSERT_TRUE(family.is_there());
  const std::vector<pid_t> all = carlo::descendants(getpid());
  EXPECT_GE(carlo::resident_bytes(all), 2 * held);
  EXPECT_GE(carlo::proportional_bytes(all), held);
  // Not twice; the memory of this program, shared with both, is added.
  EXPECT_LE(carlo::proportional_bytes(all), 1.5 * held + carlo::resident_bytes({getpid()}));
  EXPECT_LE(carlo::proportional_bytes(all), 0.75 * carlo::resident_bytes(all));
}

TEST(ProcessTree, ResidentBytesAreSummedOverProcesses) {
  const Family family(false);
  ASSERT_TRUE(family.is_there());
  const std::vector<pid_t> all = carlo::descendants(getpid());
  EXPECT_GE(carlo::resident_bytes(all), 2 * held);
  EXPECT_GE(carlo::proportional_bytes(all), 2 * held);
}
#endif

TEST(ProcessTree, EndedProcessesUseNoMemory) {
  EXPECT_EQ(carlo::resident_bytes({-1}), 0);
  EXPECT_EQ(carlo::proportional_bytes({-1}), 0);
}

} // namespace

// Signals as a flag.

#include <terminal/interrupt.h>

#include <gtest/gtest.h>

#include <csignal>

namespace {

using carlo::Interrupt;

TEST(Interrupt, EverySignalSetsTheFlag) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGXCPU}) {
    testing::internal::CaptureStdout(); // SIGHUP turns terminals off
    testing::internal::CaptureStderr();
    const Interrupt interrupt;
    EXPECT_FALSE(*interrupt.flag());
    EXPECT_EQ(Interrupt::signal(), 0);
    std::raise(signal);
    EXPECT_TRUE(*interrupt.flag());
    EXPECT_EQ(Interrupt::signal(), signal);
    testing::internal::GetCapturedStdout();
    testing::internal::GetCapturedStderr();
  }
}

TEST(Interrupt, TheFirstSignalCounts) {
  const Interrupt interrupt;
  std::raise(SIGTERM);
  std::raise(SIGUSR1);
  EXPECT_EQ(Interrupt::signal(), SIGTERM);
}

// As under nohup, and for SIGINT in a program that a shell started in the background.
TEST(Interrupt, IgnoredSignal_StaysIgnored) {
  for (const int signal : {SIGHUP, SIGINT}) {
    std::signal(signal, SIG_IGN);
    {
      const Interrupt interrupt;
      std::raise(signal);
      EXPECT_FALSE(*interrupt.flag());
      std::raise(SIGTERM);
      std::raise(signal); // would end this program otherwise
    }
    EXPECT_EQ(std::signal(signal, SIG_DFL), SIG_IGN);
  }
}

TEST(Interrupt, HandlersEndWithTheLifetime) {
  { const Interrupt interrupt; }
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGXCPU}) EXPECT_EQ(std::signal(signal, SIG_DFL), SIG_DFL);
}

} // namespace

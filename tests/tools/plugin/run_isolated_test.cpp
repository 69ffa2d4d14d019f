// Memory limits: for one process, and for all processes that a program starts.

#include <tools/run_in_process.h>

#include <gmock/gmock.h>

namespace {

using carlo::ValidateCommandOptions;
using support::refusal, support::run;
using testing::AllOf, testing::AnyOf;
using testing::HasSubstr;

const std::string sampler_program = MC_SOURCE_DIR "/examples/program-python/sampler.py";

struct Isolated : support::ScratchTest {
  // A program that runs these lines of Python before the sampler, with a limit of half a GiB.
  ValidateCommandOptions after(const std::string& lines) const {
    ValidateCommandOptions o;
    o.sampler_command =
        "python3 '" +
        write("program.py", "import os, time\n" + lines + "exec(open('" + sampler_program + "').read())\n") + "'";
    o.domain = "disk";
    o.samples = 20'000;
    o.memory = 0.5;
    o.timeout = 60;
    return o;
  }
};

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

// Each process is within the limit, their total is not.
TEST_F(Isolated, MemoryLimit_CoversAllProcesses) {
  EXPECT_THAT(refusal(after("for i in range(3):\n"
                            "    if os.fork() == 0:\n"
                            "        held = b'x' * (200 << 20)\n"
                            "        time.sleep(100)\n"
                            "time.sleep(100)\n")),
              AllOf(HasSubstr("it needs more than 0.5 GiB of memory in sample at u = ("), HasSubstr("(--memory)")));
}

TEST_F(Isolated, SharedMemory_CountsOnce) {
  const auto out = run(after("held = b'x' * (200 << 20)\n"
                             "for i in range(3):\n"
                             "    if os.fork() == 0: time.sleep(100)\n"
                             "time.sleep(0.5)\n"));
  EXPECT_EQ(out.code, carlo::exit_ok) << out.text;
}

// Whichever happens first: the check of the limit, or a failed allocation.
TEST_F(Isolated, OutOfMemoryExit_NamesMemoryLimit) {
  EXPECT_THAT(refusal(after("held = []\n"
                            "while True: held.append(b'x' * (1 << 20))\n")),
              AnyOf(HasSubstr("it needs more than 0.5 GiB of memory"),
                    testing::ContainsRegex("code 1 instead of answering 'sample'; it held 0.4[0-9]+ GiB of memory of "
                                           "the 0.5 that --memory allows")));
}

TEST_F(Isolated, OtherExit_DoesNotNameMemoryLimit) {
  EXPECT_THAT(refusal(after("exit(1)\n")), testing::EndsWith("ended with code 1 instead of answering 'sample'"));
}

#endif

} // namespace

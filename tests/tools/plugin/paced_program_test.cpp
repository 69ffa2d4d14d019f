// A program in this process's care: batches grow while it is fast.

#include <plugin/paced_program.h>
#include <support/files.h>

#include <mc/core/file.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>

namespace {

struct PacedProgramTest : support::ScratchTest {
  // Answers each number with itself, and writes the size of each question to a file.
  std::string program(const std::string& delay) const {
    return "exec python3 '" +
           write("echo.py", "import sys, time\n"
                            "sizes = open('" +
                                path("sizes") +
                                "', 'w')\n"
                                "for line in sys.stdin.buffer:\n"
                                "    what, rows, width = line.split()\n"
                                "    sizes.write(rows.decode() + '\\n')\n"
                                "    sizes.flush()\n"
                                "    x = sys.stdin.buffer.read(8 * int(rows) * int(width))\n"
                                "    time.sleep(" +
                                delay +
                                ")\n"
                                "    sys.stdout.buffer.write(x)\n"
                                "    sys.stdout.buffer.flush()\n") +
           "'";
  }
  // The sizes of the questions about `count` rows, all at once.
  std::vector<int> sizes(const std::string& delay, std::size_t count) const {
    carlo::CallMonitor monitor;
    carlo::PacedProgram p(program(delay), monitor);
    std::vector<double> x(count), answer(count);
    for (std::size_t i = 0; i < count; ++i) x[i] = static_cast<double>(i);
    p.ask("eval", "x", x, 1, answer);
    EXPECT_EQ(x, answer);
    EXPECT_GE(p.cpu_seconds(), 0);
    std::vector<int> all;
    std::istringstream text(mc::read_file(path("sizes")));
    for (int n; text >> n;) all.push_back(n);
    return all;
  }
};

TEST_F(PacedProgramTest, FastProgram_IsAskedAboutManyRows) {
  const std::vector<int> all = sizes("0", 20'000);
  EXPECT_EQ(all.front(), 1);
  EXPECT_GE(*std::max_element(all.begin(), all.end()), 64);
}

TEST_F(PacedProgramTest, SlowProgram_IsAskedAboutFewRows) {
  const std::vector<int> all = sizes("0.2 * int(rows)", 12);
  EXPECT_LE(*std::max_element(all.begin(), all.end()), 4);
}

} // namespace

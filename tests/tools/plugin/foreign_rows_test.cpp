// Sessions: concurrent calls, long rows, failures.

#include <plugin/foreign_rows.h>
#include <support/files.h>

#include <mc/core/parallel.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <atomic>
#include <chrono>
#include <thread>

namespace {

using carlo::ForeignRows, carlo::RowShape, carlo::WorkerOptions;
using nlohmann::json;
using testing::HasSubstr;

struct ForeignRowsTest : support::ScratchTest {
  // Answers each row of C numbers with its sum and its first number.
  std::string program(const std::string& line = "pass") const {
    return "python3 '" +
           write("sums.py", "import array, sys, time\n"
                            "for line in sys.stdin.buffer:\n"
                            "    what, rows, width = line.split()\n"
                            "    rows, width = int(rows), int(width)\n"
                            "    x = array.array('d')\n"
                            "    x.frombytes(sys.stdin.buffer.read(8 * rows * width))\n"
                            "    out = array.array('d')\n"
                            "    for at in range(0, rows * width, width):\n"
                            "        out.extend((sum(x[at:at + width]), x[at]))\n"
                            "    " +
                                line +
                                "\n"
                                "    sys.stdout.buffer.write(out.tobytes())\n"
                                "    sys.stdout.buffer.flush()\n") +
           "'";
  }
  static ForeignRows rows(const std::string& command, std::size_t dim, double seconds = 60) {
    WorkerOptions worker;
    worker.program = CARLO_PATH;
    worker.limits.seconds = seconds;
    return {json{{"task", "integrand command"}, {"who", command}, {"dim", dim}, {"outputs", 2}}, RowShape{dim, 2},
            worker};
  }
  // What each of several questions about one row costs, if the program runs this line for every question.
  std::vector<double> seconds_of_questions(const std::string& line, int count) const {
    ForeignRows f = rows(program(line), 1);
    const double x = 1;
    std::vector<double> values(2), seconds;
    for (int i = 0; i < count; ++i) seconds.push_back(f(std::span(&x, 1), values));
    return seconds;
  }
};

TEST_F(ForeignRowsTest, ConcurrentCalls_GetTheirOwnAnswers) {
  ForeignRows f = rows(program(), 3);
  std::atomic<int> wrong = 0;
  mc::parallel_for(64, 4, [&](std::size_t call) {
    const std::size_t count = 1 + 17 * call;
    std::vector<double> x(3 * count), values(2 * count);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = static_cast<double>(1000 * call + i);
    f(x, values);
    for (std::size_t i = 0; i < count; ++i)
      wrong += values[2 * i] != x[3 * i] + x[3 * i + 1] + x[3 * i + 2] || values[2 * i + 1] != x[3 * i];
  });
  EXPECT_EQ(wrong, 0);
}

TEST_F(ForeignRowsTest, LongRows_AreWhole) {
  ForeignRows f = rows(program(), 1024);
  std::vector<double> x(1024 * 700, 0.5), values(2 * 700);
  f(x, values);
  for (std::size_t i = 0; i < values.size(); i += 2) ASSERT_EQ(values[i], 512);
}

// The second question is answered while the processes of the first are known.
TEST_F(ForeignRowsTest, CpuSeconds_AreThoseOfTheProgram) {
  const std::vector<double> seconds = seconds_of_questions("end = time.process_time() + 0.3\n"
                                                           "    while time.process_time() < end: pass",
                                                           2);
  EXPECT_GE(seconds[1], 0.28);
  EXPECT_LE(seconds[1], 1.5);
}

// A helper for each question ends before the next one: its time stays in the sum.
TEST_F(ForeignRowsTest, CpuSeconds_NeverFall) {
  for (const double seconds : seconds_of_questions("import subprocess\n"
                                                   "    subprocess.run(['python3', '-c', 'sum(range(3000000))'])",
                                                   6))
    EXPECT_GE(seconds, 0);
}

// The limit is for one question; questions of a slow program become short.
TEST_F(ForeignRowsTest, SlowProgram_IsAskedAboutFewRows) {
  ForeignRows f = rows(program("time.sleep(0.02 * rows)"), 1, 2);
  std::vector<double> x(150, 1.0), values(300);
  EXPECT_EQ(support::error_of([&] { f(x, values); }), "");
  EXPECT_EQ(values[299], 1);
}

TEST_F(ForeignRowsTest, IdleTime_DoesNotCount) {
  ForeignRows f = rows(program(), 1, 3);
  double x = 1;
  std::vector<double> values(2);
  f(std::span(&x, 1), values);
  std::this_thread::sleep_for(std::chrono::seconds(4));
  EXPECT_EQ(support::error_of([&] { f(std::span(&x, 1), values); }), "");
}

TEST_F(ForeignRowsTest, FailureIsOneLine) {
  double x = 0.25;
  std::vector<double> values(2);
  const auto refusal = [&](const std::string& command, double seconds = 60) {
    ForeignRows f = rows(command, 1, seconds);
    return support::error_of([&] { f(std::span(&x, 1), values); });
  };
  EXPECT_THAT(refusal("exit 3"), HasSubstr("exit 3: the program ended with code 3 instead of answering 'eval'"));
  EXPECT_THAT(refusal(program("sys.exit(4)")), HasSubstr("the program ended with code 4 instead of answering 'eval'"));
  EXPECT_THAT(refusal("kill -SEGV $$"), HasSubstr("the program ended with code 139 instead of"));
  EXPECT_THAT(
      refusal(program("out.pop()"), 8),
      HasSubstr("it hangs in eval at x = (0.25), where 1 of 2 numbers have come (doubles of 8 bytes): no answer"));
  EXPECT_THAT(refusal(program("out.append(1)")),
              HasSubstr("it wrote 8 bytes more than the answer; it must write nothing else"));
  EXPECT_THAT(refusal("exec " + program("import os; os.close(1); time.sleep(100)"), 20),
              HasSubstr("the program closed a pipe instead of answering 'eval'"));
}

} // namespace

// carlo validate --command: a sampler in Python, right and wrong, and programs that misbehave.

#include <tools/run_in_process.h>

#include <mc/core/file.h>

#include <gmock/gmock.h>

#include <sys/stat.h>

#include <cerrno>
#include <chrono>
#include <csignal>

namespace {

using carlo::ValidateCommandOptions;
using support::Output, support::refusal, support::run;
using testing::AllOf;
using testing::HasSubstr;

const std::string script = MC_SOURCE_DIR "/examples/program-python/sampler.py";

struct Command : support::ScratchTest {
  static ValidateCommandOptions options(const std::string& command, const std::string& domain = "disk") {
    ValidateCommandOptions o;
    o.sampler_command = command;
    o.domain = domain;
    o.samples = 20'000;
    return o;
  }
  // The script with one replacement.
  ValidateCommandOptions changed(const std::string& from, const std::string& to) const {
    std::string text = mc::read_file(script);
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return options("python3 '" + write("changed.py", text.replace(at, from.size(), to)) + "'");
  }
};

TEST_F(Command, CorrectProgram_Passes) {
  const Output out = run(options("python3 '" + script + "'"));
  EXPECT_EQ(out.code, carlo::exit_ok) << out.text;
  EXPECT_THAT(out.text, HasSubstr("1 of 1 cases passed"));
}

// The same program at another path returns the same numbers.
TEST_F(Command, Result_IsIndependentOfPath) {
  const auto figures = [](const std::string& file) {
    const std::string text = run(options("python3 '" + file + "'")).text;
    return text.substr(text.find("double"), 40);
  };
  EXPECT_EQ(figures(script), figures(write("elsewhere.py", mc::read_file(script))));
}

TEST_F(Command, WrongPrograms_AreRejected) {
  Output out = run(changed("math.sqrt(u[0])", "u[0]"));
  EXPECT_EQ(out.code, carlo::exit_failed);
  EXPECT_THAT(out.text, AllOf(HasSubstr("likely cause: "), HasSubstr("again: carlo validate --command 'python3 ")));
  out = run(changed("(1 / math.pi,)", "(1.01 / math.pi,)"));
  EXPECT_THAT(out.text, HasSubstr("the density integrates to 1.01"));
  out = run(changed("math.sqrt(u[0])", "math.nan"));
  EXPECT_THAT(out.text, HasSubstr("likely cause: not finite"));
  out = run(changed("math.sqrt(u[0])", "math.sqrt(__import__('random').random())"));
  EXPECT_THAT(out.text, HasSubstr("law: determinism of sample"));
}

TEST_F(Command, EveryApplicableLaw_IsTested) {
  // A constant point: only a law that compares different u detects it.
  const Output stuck = run(changed("    r, phi = math.sqrt(u[0]), 2 * math.pi * u[1]\n", "    r, phi = 0.5, 0.25\n"));
  EXPECT_THAT(stuck.text, HasSubstr("law: sample depends on u"));
  // A logarithm of 0, which is accepted if u lies in (0,1).
  ValidateCommandOptions o = changed("math.sqrt(u[0])", "math.exp(0.5 * math.log(u[0]))");
  EXPECT_THAT(refusal(o), HasSubstr("ended with code 1"));
  o.open_interval = true;
  EXPECT_EQ(run(o).code, carlo::exit_ok);
}

// A program with random numbers of its own answers seeds.
TEST_F(Command, RejectionSampler_DrawsFromSeeds) {
  ValidateCommandOptions o = options("python3 '" + script + "'");
  o.uniforms = "own";
  const Output right = run(o);
  EXPECT_EQ(right.code, carlo::exit_ok) << right.text;
  const auto with = [&](const std::string& from, const std::string& to) {
    o.sampler_command = changed(from, to).sampler_command;
    return run(o);
  };
  EXPECT_EQ(with("x * x + y * y <= 1", "x * x + y * y <= 1 and x < 0.9").code, carlo::exit_failed);
  EXPECT_THAT(with("random.Random(int(seed[0]))", "random").text, HasSubstr("law: batch consistency of sample"))
      << "it ignores the seed";
  o.uniforms = "some";
  EXPECT_THAT(refusal(o), HasSubstr("--uniforms 'some' must be a number, or own"));
}

// A program over a domain, from the bodies of its functions sample(u) and pdf(x).
std::string program(const std::string& sample, const std::string& pdf) {
  std::string text = mc::read_file(script);
  const auto replace = [&](const char* from, const char* to, const std::string& by) {
    const std::size_t begin = text.find(from);
    text.replace(begin, text.find(to) - begin, by + "\n\n\n");
  };
  replace("def sample", "def draw", "def sample(u):\n    return " + sample);
  replace("def pdf", "def answer", "def pdf(x):\n    return (" + pdf + ",)");
  return text;
}

TEST_F(Command, OtherKindsOfDistributions) {
  struct Kind {
    std::string domain, sample, pdf, wrong;
    bool is_log = false;
  };
  const std::vector<Kind> kinds = {
      // A geometric distribution, without an end.
      {"discrete=0:inf", "(math.floor(math.log(1 - u[0]) / math.log(0.7)),)", "0.3 * 0.7 ** x[0]",
       "0.28 * 0.72 ** x[0]"},
      // A tenth of the samples is an outcome.
      {"outcome=1,x=0:1", "(0, 0) if u[0] < 0.1 else (-1, math.sqrt(u[1]))", "0.1 if x[0] == 0 else 1.8 * x[1]",
       "0.13 if x[0] == 0 else 1.74 * x[1]"},
      // Four independent exponentials, by the logarithm of their density.
      {"a=0:inf,b=0:inf,c=0:inf,d=0:inf", "[-math.log(1 - v) for v in u]", "-sum(x)",
       "-1.05 * sum(x) + 4 * math.log(1.05)", true},
  };
  for (const Kind& kind : kinds) {
    ValidateCommandOptions o =
        options("python3 '" + write("right.py", program(kind.sample, kind.pdf)) + "'", kind.domain);
    o.log_density = kind.is_log;
    const Output right = run(o);
    EXPECT_EQ(right.code, carlo::exit_ok) << right.text;
    o.sampler_command = "python3 '" + write("wrong.py", program(kind.sample, kind.wrong)) + "'";
    const Output wrong = run(o);
    EXPECT_EQ(wrong.code, carlo::exit_failed) << wrong.text;
  }
}

// A program that returns the right set of answers to a batch in the wrong order.
TEST_F(Command, BatchAnswers_EqualSingleAnswers) {
  const Output out = run(changed("    sink.write(results.tobytes())", "    sink.write(results[::-1].tobytes())"));
  EXPECT_EQ(out.code, carlo::exit_failed) << out.text;
  EXPECT_THAT(out.text, HasSubstr("law: batch consistency of sample"));
}

TEST_F(Command, OutcomesAndProductDomains_Pass) {
  ValidateCommandOptions o = changed("def sample(u):\n", "def sample(u):\n    return (float(int(4 * u[0])),)\n");
  o.domain = "discrete=4";
  EXPECT_EQ(run(o).code, carlo::exit_failed); // the stated probability is 1 / pi each
  o = changed("def sample(u):\n", "def sample(u):\n    return (float(int(math.pi * u[0])),)\n");
  o.domain = "discrete=3";
  EXPECT_EQ(run(o).code, carlo::exit_failed);
  o = changed("return r * math.cos(phi), r * math.sin(phi)", "return r * math.cos(phi), r * math.sin(phi), u[2]");
  o.domain = "disk,t=0:1";
  EXPECT_EQ(run(o).code, carlo::exit_ok);
}

// An exit, a hang or a partial answer is reported in one line of carlo, after the output of the program itself.
TEST_F(Command, MisbehavingProgram_IsOneLineError) {
  EXPECT_THAT(refusal(options("exit 3")),
              HasSubstr("exit 3: the program ended with code 3 instead of answering 'sample'"));
  EXPECT_THAT(refusal(options("read line; printf 12345678")), HasSubstr("instead of answering 'sample'"));
  EXPECT_THAT(refusal(options("no-such-program-here 2>/dev/null")), HasSubstr("ended with code 127"));
  ValidateCommandOptions o = options("sleep 1000");
  o.timeout = 2;
  EXPECT_THAT(refusal(o), AllOf(HasSubstr("it hangs in sample at u = (0."), HasSubstr("--timeout")));
  o = options("read line; printf 1234567812345678; sleep 1000", "hemisphere"); // two columns instead of three
  o.timeout = 1;
  EXPECT_THAT(refusal(o), testing::ContainsRegex(
                              "at u = .*, where 2 of [0-9]+ numbers have come .doubles of 8 bytes.: no answer in 1 s"));
}

// Extra output of a program, before or between its answers, would shift all numbers after it.
TEST_F(Command, ExtraOutput_IsRejected) {
  const char* more = "bytes more than the answer; it must write nothing else to standard output";
  EXPECT_THAT(refusal(changed("for line in", "print('ready', flush=True)\nfor line in")), HasSubstr(more));
  EXPECT_THAT(refusal(changed("    sink.flush()\n", "    sink.write(b'answered')\n    sink.flush()\n")),
              HasSubstr(more));
}

// The program ends after its child has sent its process id through a pipe.
TEST_F(Command, ChildProcesses_AreEnded) {
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  const std::string id = "\"" + path("id") + "\"", pipe = "\"" + path("pipe") + "\"";
  refusal(options("sh -c 'echo $$ > " + pipe + "; exec sleep 1000' & read id < " + pipe + "; echo $id > " + id +
                  "; exit 3"));
  EXPECT_EQ(kill(std::stoi(mc::read_file(path("id"))), 0), -1);
  EXPECT_EQ(errno, ESRCH);
}

TEST_F(Command, InvalidOptions_AreOneLineErrors) {
  EXPECT_THAT(refusal(options("true", "")), HasSubstr("--command needs the --domain"));
  EXPECT_THAT(refusal(options("true", "dsk")), HasSubstr("did you mean 'disk'"));
  ValidateCommandOptions o = options("true");
  o.uniforms = "7";
  EXPECT_THAT(refusal(o), HasSubstr("--uniforms 7; at most 6"));
  o.plugin = "a.so";
  EXPECT_THAT(refusal(o), HasSubstr("give one of --plugin, --command and --samples-file"));
  ValidateCommandOptions named;
  named.names = {"UniformDisk"};
  named.domain = "disk";
  EXPECT_THAT(refusal(named), HasSubstr("--domain is for a --command or a --samples-file"));
  named.domain = "";
  named.unnormalized = true;
  EXPECT_THAT(refusal(named), HasSubstr("--unnormalized is for a density of a --samples-file"));
}

} // namespace

// Messages with bytes of files.

#include <terminal/message.h>

#include <tools/run_carlo.h>

#include <mc/core/file.h>
#include <mc/core/text.h>

#include <support/files.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

struct MessageTest : support::ScratchTest {};

TEST_F(MessageTest, IsPrintableLineByLine) {
  testing::internal::CaptureStderr();
  carlo::print_message("a\x1b[2J\nb");
  carlo::warn("{} is \r bad", "x\ny");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "carlo: a?[2J\ncarlo: b\ncarlo: warning: x\ncarlo: y is ? bad\n");
}

// No byte of a file reaches the terminal as a control character, and no line is longer than a screen.
TEST_F(MessageTest, HostileFilesStayReadable) {
  const std::string evil = "\x1b]0;title\x07\x9b" + std::string(5000, 'A') + "\xff";
  const std::string scene = "<scene version=\"0.6.0\">";
  const std::pair<std::string, std::string> files[] = {
      {"a.xml", scene + "<shape type=\"" + evil + "\"/></scene>"},
      {"b.xml", scene + "<shape type=\"&#27;[31m&#10;x\"/></scene>"},
      {"c.xml", scene + "<shape type=\"obj\"><string name=\"filename\" value=\"" + evil + "\"/></shape></scene>"},
      {"d.xml", scene + "<" + std::string(5000, 'b') + " name=\"" + evil + "\"/></scene>"},
      {"e.xml", scene + evil + "</scene>"},
      {"a.obj", "v " + evil + " 0 0\n"},
      {"b.obj", "f 1/" + evil + " 2 3\n"},
      {"a.ply", "ply\nformat " + evil + " 1.0\nend_header\n"},
      {"b.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty " + evil + " x\nend_header\n0\n"},
  };
  for (const auto& [name, text] : files) {
    const std::string output = support::run_carlo("render " + write(name, text) + " -o " + path("o.exr")).output;
    EXPECT_THAT(output, testing::StartsWith("carlo: "));
    EXPECT_LE(output.size(), 3000u) << name;
    EXPECT_EQ(output, mc::printable(output.substr(0, output.size() - 1), 10'000) + "\n") << name;
  }
  for (const std::string& text : {evil + "\n0.1\n", "x," + evil + "\n0.1,0.2\n", "0.1," + evil + "\n"}) {
    const std::string output = support::run_carlo("validate --pdf 1 --samples-file " + write("s.csv", text)).output;
    EXPECT_EQ(output.find('\x1b'), std::string::npos) << output;
    EXPECT_LE(output.size(), 3000u);
  }
}

TEST_F(MessageTest, NamesThatAreNotUtf8_AreWrittenToJsonAndXml) {
  const std::string bad = path("\xff\x01");
  const support::ProcessResult run = support::run_carlo("converge pi --max-n 64 --replicates 8 -o '" + bad + "'");
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_TRUE(nlohmann::json::accept(mc::read_file(bad + "/pi.json")));
  std::string rows;
  for (int i = 0; i < 4000; ++i) rows += fmt::format("{}\n", i / 4000.0);
  const std::string samples = write("\xff\x01.csv", rows);
  support::run_carlo("validate --pdf 1 --samples-file '" + samples + "' --junit " + path("j.xml"));
  const std::string xml = mc::read_file(path("j.xml"));
  EXPECT_THAT(xml, testing::StartsWith("<?xml"));
  EXPECT_EQ(xml.find('\xff'), std::string::npos);
  EXPECT_EQ(xml.find('\x01'), std::string::npos);
}

} // namespace

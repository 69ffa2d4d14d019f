// Outputs over inputs and over each other, and the use of every option that names a file.

#include <options/files.h>

#include <support/files.h>

#include <gmock/gmock.h>

namespace {

using carlo::UsedFile;

struct FilesTest : support::ScratchTest {
  static std::string refusal(const std::vector<UsedFile>& files) {
    return support::error_of([&] { carlo::require_distinct_files(files); });
  }
};

// A new option that names a file must state whether it is read or written.
TEST(FileUse, EveryOptionWithAFileStatesItsUse) {
  for (const carlo::Subcommand& c : carlo::subcommands())
    for (const carlo::Option& o : c.options) {
      if (o.value != "FILE" && o.value != "FOLDER") continue;
      EXPECT_NE(o.use, carlo::FileUse::none)
          << c.about.name << " " << o.names << ": see input_file() and output_file()";
      EXPECT_EQ(o.use == carlo::FileUse::output_folder, o.value == "FOLDER") << c.about.name << " " << o.names;
    }
}

TEST_F(FilesTest, OutputOverInput_IsRefusedByAnyName) {
  const std::string in = write("in.csv", "1");
  std::filesystem::create_hard_link(in, path("hard.csv"));
  std::filesystem::create_symlink("in.csv", path("soft.csv"));
  for (const std::string& out : {in, path("./in.csv"), path("hard.csv"), path("soft.csv")}) {
    const std::string text = "--json would write '" + out + "' over the file of --plugin; name another file";
    EXPECT_EQ(refusal({{in, "the file of --plugin"}, {out, "--json", true}}), text);
    EXPECT_EQ(refusal({{out, "--json", true}, {in, "the file of --plugin"}}), text);
  }
  EXPECT_EQ(refusal({{in, "the file of --plugin"}, {path("new.csv"), "--json", true}, {"-", "--junit", true}}), "");
  EXPECT_EQ(refusal({{path("none"), "INTEGRAND"}, {path("none"), "--json", true}}), "") << "a name and no file";
  EXPECT_EQ(refusal({{in, "A"}, {in, "B"}}), "");
  EXPECT_EQ(refusal({{in, "--checkpoint", true, true}, {in, "--resume", true, true}}), "");
  EXPECT_NE(refusal({{in, "--checkpoint", true, true}, {in, "--json", true}}), "");
}

TEST_F(FilesTest, OutputOverOutput_IsRefusedUnlessItIsADevice) {
  const auto both = [&](const std::string& a, const std::string& b) {
    return refusal({{a, "--json", true}, {b, "--junit", true}});
  };
  EXPECT_EQ(both(path("q"), path("./q")), "--json and --junit would both write '" + path("q") + "'; name another file");
  std::filesystem::create_symlink("q", path("link"));
  EXPECT_NE(both(path("q"), path("link")), "");
  EXPECT_NE(both("-", "-"), "");
  EXPECT_EQ(both("/dev/null", "/dev/null"), "");
  EXPECT_EQ(both("-", path("-")), "");
  EXPECT_EQ(both(path("a"), path("b")), "");
}

TEST_F(FilesTest, RowsNameTheirFiles) {
  std::string json = "a.json", out = "out", plugin, command = "x";
  const std::vector<UsedFile> files = carlo::files_of({carlo::output_file({"-j,--json", "FILE", &json, ""}),
                                                       carlo::output_folder({"-o", "FOLDER", &out, ""}, {"p.csv"}),
                                                       carlo::input_file({"--plugin", "FILE", &plugin, ""}),
                                                       {"--command", "COMMAND", &command, ""}});
  ASSERT_EQ(files.size(), 2u) << "an option that is not given has no file";
  EXPECT_EQ(files[0].path, "a.json");
  EXPECT_EQ(files[0].origin, "--json");
  EXPECT_EQ(files[1].path, "out/p.csv");
  EXPECT_TRUE(files[1].is_output);
}

} // namespace

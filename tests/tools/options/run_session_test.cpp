#include <options/run_session.h>

#include <support/files.h>

#include <gmock/gmock.h>

namespace {

using namespace carlo;
using support::error_of;
using testing::HasSubstr;
using Words = std::vector<std::string>;

struct RunSessionTest : support::ScratchTest {};

TEST(WordsOf, UndoesTheQuotesOfAShell) {
  EXPECT_EQ(words_of("carlo render 'a b' -o x.exr"), (Words{"carlo", "render", "a b", "-o", "x.exr"}));
  EXPECT_EQ(words_of("a 'it'\\''s' '' b"), (Words{"a", "it's", "", "b"}));
  EXPECT_EQ(words_of(""), Words{});
}

TEST(WithoutOption, RemovesEverySpelling) {
  const Words names = {"-o", "--output"};
  for (const Words& given : {Words{"a", "-o", "x", "b"}, Words{"a", "-ox", "b"}, Words{"a", "--output", "x", "b"},
                             Words{"a", "b", "--output=x"}, Words{"a", "b"}, Words{"-o", "x", "a", "b", "-o"}})
    EXPECT_EQ(without_option(given, names), (Words{"a", "b"}));
  EXPECT_EQ(without_option({"--outputs", "x", "-p"}, names), (Words{"--outputs", "x", "-p"}));
}

TEST_F(RunSessionTest, Part_EndsBeforeItsResults) {
  const std::string file = path("p.ckpt");
  RunSession session({.part = "2/2"}, {}, file, "carlo x");
  EXPECT_EQ(session.checkpoint(), nullptr);
  EXPECT_TRUE(session.is_shared());
  EXPECT_NE(session.parts(), nullptr);
  EXPECT_EQ(session.run([&] {
    session.before_results();
    return 7;
  }),
            exit_ok);
  const mc::SavedPart saved = mc::read_part(file);
  EXPECT_TRUE(saved.part.is_whole);
  EXPECT_EQ(saved.part.number, 2u);
  EXPECT_EQ(saved.command, (Words{"carlo", "x"}));
}

TEST_F(RunSessionTest, WithoutPart_GivesTheCodeOfTheWork) {
  RunSession session({}, {}, "", "carlo x");
  EXPECT_FALSE(session.is_shared());
  EXPECT_EQ(session.parts(), nullptr);
  session.before_results();
  EXPECT_EQ(session.run([] { return 7; }), 7);
  EXPECT_THAT(error_of([] { RunSession({.part = "1/2"}, {}, "a.exr", ""); }), HasSubstr("give -o part1.ckpt"));
}

} // namespace

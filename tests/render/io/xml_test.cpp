#include <render/io/xml.h>

#include "support/files.h"

#include <chrono>

namespace {

struct Xml : support::ScratchTest {};

TEST_F(Xml, KnowsItsLines) {
  const auto root =
      render::read_xml(write("a.xml", "<scene version=\"0.6.0\">\n\n  <shape type=\"sphere\"/>\n</scene>\n"));
  EXPECT_EQ(root.tag, "scene");
  EXPECT_EQ(root.attribute("version"), "0.6.0");
  ASSERT_EQ(root.children.size(), 1u);
  EXPECT_EQ(root.children[0].line, 3);
  EXPECT_EQ(root.children[0].attribute_or("id", "none"), "none");
}

// The time is linear in the number of elements: counting lines from the start for each would take minutes.
TEST_F(Xml, ManyElements_AreReadInLinearTime) {
  std::string text = "<scene>\n";
  for (int i = 0; i < 200'000; ++i) text += "<shape type=\"sphere\"/>\n";
  const auto start = std::chrono::steady_clock::now();
  const auto root = render::read_xml(write("a.xml", text + "</scene>"));
  EXPECT_LE(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
  ASSERT_EQ(root.children.size(), 200'000u);
  EXPECT_EQ(root.children.back().line, 200'001);
}

TEST_F(Xml, UnusedElements_AreReported) {
  const auto root =
      render::read_xml(write("a.xml", "<scene>\n<shape type=\"x\" odd=\"1\"/>\n<film type=\"y\"/></scene>"));
  root.mark_used();
  root.children[0].mark_used();
  EXPECT_EQ(root.children[0].attribute("type"), "x");
  EXPECT_EQ(support::error_of([&] { root.require_all_used(); }),
            path("a.xml") + ":2: <shape>: attribute odd=\"1\" is not supported; remove it");
  EXPECT_EQ(root.children[0].attribute("odd"), "1");
  EXPECT_EQ(support::error_of([&] { root.require_all_used(); }),
            path("a.xml") + ":3: <film type=\"y\"> is not supported here; remove it");
}

TEST_F(Xml, BrokenXmlNamesTheLine) {
  write("b.xml", "<scene>\n<shape>\n</scene>\n");
  EXPECT_THAT(support::error_of([&] { render::read_xml(path("b.xml")); }), testing::HasSubstr("b.xml:3: broken XML"));
  write("c.xml", "<scene>\n text </scene>");
  EXPECT_THAT(support::error_of([&] { render::read_xml(path("c.xml")); }),
              testing::HasSubstr("<scene>: text between elements is not supported"));
  write("d.xml", "");
  EXPECT_NE(support::error_of([&] { render::read_xml(path("d.xml")); }), "");
  EXPECT_THAT(support::error_of([&] { render::read_xml(path("none.xml")); }), testing::HasSubstr("no such file"));
}

// Silently dropped content would change the scene.
TEST_F(Xml, NothingIsDroppedInSilence) {
  const auto said = [&](const std::string& text) {
    return support::error_of([&] { render::read_xml(write("a.xml", text)); });
  };
  const std::string at = path("a.xml") + ":";
  EXPECT_EQ(said("<scene>\n</scene>\n<shape/>\n"),
            at + "3: 'shape' stands outside of <scene>; a file holds one element");
  EXPECT_EQ(said("<scene/>\n rest"), at + "2: 'rest' stands outside of <scene>; a file holds one element");
  EXPECT_EQ(said("<scene/>\n\ntwo\nlines"), at + "3: 'two' stands outside of <scene>; a file holds one element");
  EXPECT_EQ(said("early<scene/>"), at + "1: 'early' stands outside of <scene>; a file holds one element");
  EXPECT_EQ(said("<scene>\n<float value=\"1\" value=\"2\"/></scene>"),
            at + "2: <float>: attribute value=\"2\" stands beside value=\"1\"; remove one");
  EXPECT_EQ(said("\xef\xbb\xbf<?xml version=\"1.0\"?>\n<!-- of -->\n<!DOCTYPE scene>\n<scene/>\n<!-- it -->\n"), "");
}

TEST_F(Xml, DeepNestingIsRefused) {
  std::string text;
  for (int i = 0; i < 20'000; ++i) text += "<a>";
  for (int i = 0; i < 20'000; ++i) text += "</a>";
  EXPECT_THAT(support::error_of([&] { render::read_xml(write("deep.xml", text)); }),
              testing::HasSubstr("nested more than 256 deep"));
}

} // namespace

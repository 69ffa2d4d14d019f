#include <mc/check/subject/subject.h>

#include <gtest/gtest.h>

namespace {

TEST(Subject, Draw_DefaultsToPointOfWeightOne) {
  const mc::Subject::Draw d;
  EXPECT_EQ(d.kind, mc::Subject::Draw::Kind::point);
  EXPECT_EQ(d.weight, 1);
  EXPECT_TRUE(d.pdf_positive);
  const mc::Subject s;
  EXPECT_FALSE(s.may_fail);
  EXPECT_TRUE(s.atoms.empty());
}

} // namespace

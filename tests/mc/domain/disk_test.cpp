#include <mc/domain/disk.h>

#include "support/domain_laws.h"

namespace {

TEST(Disk, Chart) {
  support::expect_domain_laws(mc::Disk<float>(), 4);
  support::expect_domain_laws(mc::Disk<double>(), 4);
}

TEST(Disk, Edges) {
  const mc::Disk<double> disk;
  EXPECT_TRUE(disk.contains({1, 0}));
  EXPECT_FALSE(disk.contains({1.0001, 0}));
  EXPECT_FALSE(disk.contains({NAN, 0}));
  EXPECT_EQ(disk.to_unit({0, 0}), mc::Vec2<double>(0, 0));
}

} // namespace

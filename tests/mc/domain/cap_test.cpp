#include <mc/domain/cap.h>

#include <gmock/gmock.h>

#include "support/domain_laws.h"
#include "support/files.h"

namespace {

TEST(Cap, ChartAtAnyAngle) {
  for (const float h : {1e-18f, 1e-6f, 0.3f, 1.0f, 2.0f}) support::expect_domain_laws(mc::Cap<float>(h), 16);
  for (const double h : {1e-30, 1e-6, 0.3, 1.0, 2.0}) support::expect_domain_laws(mc::Cap<double>(h), 16);
}

TEST(Cap, RefusesNonsense) {
  for (const double h : {0.0, -1.0, 2.1, double(NAN)})
    EXPECT_THAT(support::error_of([h] { mc::Cap<double>{h}; }), testing::HasSubstr("must lie in (0, 2]")) << h;
}

} // namespace

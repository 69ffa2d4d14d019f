#include <render/render_job.h>
#include <render/scene/builder.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

Scene lit_floor() {
  SceneBuilder builder;
  const BsdfId grey = builder.add(Lambert(Spectrum::Constant(Float(0.5))));
  builder.add(Sphere(Vec3d(0, -101, 0), 100), {grey});
  builder.add(Sphere(Vec3d(2, 1, 0), 0.4), {grey, Emission{Spectrum::Constant(10)}});
  builder.set(Filter(GaussianFilter()));
  builder.set(ThinLens(Transform::look_at({0, 3, 0}, {0, 0, 0}, {0, 0, 1}), {.fov = 30}));
  return builder.build();
}

bool same(const Image& a, const Image& b) {
  const auto equal = [](const std::vector<Spectrum>& x, const std::vector<Spectrum>& y) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                      [](const Spectrum& p, const Spectrum& q) { return (p == q).all(); });
  };
  return equal(a.pixels, b.pixels) && equal(a.variance, b.variance);
}

std::vector<RenderOptions> kinds_of_work() {
  RenderOptions plain;
  plain.width = 13;
  plain.height = 9;
  plain.spp = 24;
  std::vector<RenderOptions> all(5, plain);
  all[1].tiles = true;
  all[1].crop = Crop{3, 1, 8, 7};
  all[2].splat = true;
  all[3].adaptive = true;
  all[3].spp = 64;
  all[4].spp = 1;
  return all;
}

// The state moves to another job after every unit.
TEST(RenderJob, StateBetweenUnits_ContinuesWithTheSameBits) {
  const Scene scene = lit_floor();
  for (const RenderOptions& options : kinds_of_work()) {
    const RenderResult expected = render::render(scene, options);
    auto job = std::make_unique<RenderJob>(scene, options);
    std::size_t moves = 0;
    while (const std::size_t units = job->next_stage())
      for (std::size_t i = 0; i < units; ++i, ++moves) {
        job->absorb(i, *job->compute(i));
        mc::ArchiveWriter bytes;
        bytes(*job);
        job = std::make_unique<RenderJob>(scene, options);
        mc::ArchiveReader(bytes.text())(*job).require_end();
      }
    const RenderResult result = job->result(true);
    EXPECT_TRUE(same(result.image, expected.image));
    EXPECT_EQ(result.rays, expected.rays);
    EXPECT_EQ(result.samples, expected.samples);
    EXPECT_FALSE(result.partial);
    EXPECT_GE(moves, 9u);
  }
}

// More samples for a finished render.
TEST(RenderJob, LargerSampleCount_ContinuesWithTheSameBits) {
  const Scene scene = lit_floor();
  for (const auto& [adaptive, spp] : {std::pair(false, 8), std::pair(true, 8), std::pair(true, 64)}) {
    RenderOptions few = kinds_of_work()[0], many = few;
    few.adaptive = many.adaptive = adaptive;
    few.spp = spp;
    many.spp = 100;
    RenderJob first(scene, few);
    mc::run_job(first, {});
    mc::ArchiveWriter bytes;
    bytes(first);
    RenderJob second(scene, many);
    mc::ArchiveReader reader(bytes.text());
    reader(second);
    mc::run_job(second, {});
    EXPECT_TRUE(same(second.result(true).image, render::render(scene, many).image)) << adaptive << " " << spp;
  }
}

} // namespace

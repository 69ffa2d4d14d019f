// --memory: small files that ask for gigabytes.

#include <options/memory_option.h>

#include <tools/run_carlo.h>

#include <render/io/image/image_io.h>

#include <support/files.h>

#include <gmock/gmock.h>

namespace {

using testing::HasSubstr;

struct MemoryOption : support::ScratchTest {
  void SetUp() override {
    ScratchTest::SetUp();
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers reserve more memory than any limit allows";
#endif
  }
};

TEST_F(MemoryOption, OutOfRange_IsRefused) {
  for (const double gib : {0.0, -1.0, 2e6, double(NAN)})
    EXPECT_THAT(support::error_of([&] { carlo::limit_memory(gib); }), HasSubstr("must lie in (0, 1e6] GiB"));
}

TEST_F(MemoryOption, LargePicture_IsRefusedBeforeItIsDecoded) {
  render::write_image(path("a.png"), render::Image(3000, 3000));
  render::write_image(path("a.exr"), render::Image(3000, 3000));
  for (const std::string name : {"a.png", "a.exr"}) {
    const std::string line = "compare " + path(name) + " " + path(name) + " --metric rmse --memory ";
    const support::ProcessResult run = support::run_carlo(line + "0.1");
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_THAT(run.output, HasSubstr("carlo: " + path(name) + ": 3000x3000 pixels need "));
    EXPECT_THAT(run.output, HasSubstr("; 0.1 GiB are allowed; --memory sets another limit\n"));
    if (name == "a.png") {
      EXPECT_EQ(support::run_carlo(line + "3").output, "0\n");
    }
  }
}

TEST_F(MemoryOption, LargeSparseFile_IsRefusedBeforeItIsRead) {
  for (const std::string name : {"a.obj", "a.ply", "a.xml", "a.serialized"}) {
    write(name, "");
    std::filesystem::resize_file(path(name), std::uintmax_t{1} << 40);
    const support::ProcessResult run = support::run_carlo("render " + path(name));
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_THAT(run.output, HasSubstr("'" + path(name) + "': its bytes need 1.02e+03 GiB of memory; "));
  }
  EXPECT_THAT(support::run_carlo("render cbox --memory 0.001 -o " + path("a.exr")).output,
              HasSubstr("; 0.001 GiB are allowed; --memory sets another limit\n"));
}

} // namespace

#include <render/io/mesh/mtl.h>

#include <support/files.h>

#include <gmock/gmock.h>

namespace {

using namespace render;

struct Mtl : support::ScratchTest {
  std::string refusal(const std::string& statement) const {
    return support::error_of([&] { read_mtl(write("m.mtl", "newmtl a\n" + statement + "\n")); });
  }
};

TEST_F(Mtl, ReadsMaterialsByTheirNames) {
  const auto materials =
      read_mtl(write("m.mtl", "# made by hand\r\nKd 1 1 1\r\nnewmtl shiny red\r\n\tKd 0.5 .25 0 # dull\r\n"
                              "Ks 0.5\r\nNs 96.5\r\nmap_Bump b.png\r\nmap_Kd  my wood.png \r\n"
                              "newmtl b\r\nTr 0.75\r\nillum 7\r\nNi 1.33\r\nmap_Kd -o 1 1 w.png"));
  ASSERT_EQ(materials.size(), 2u);
  const MtlMaterial& red = materials.at("shiny red");
  EXPECT_TRUE((*red.Kd == Spectrum(Float(0.5), Float(0.25), 0)).all() && (*red.Ks == Float(0.5)).all());
  EXPECT_FALSE(red.Ke);
  EXPECT_EQ(red.Ns, 96.5);
  EXPECT_EQ(red.map_Kd, "my wood.png");
  EXPECT_FALSE(red.is_glass());
  const MtlMaterial& glass = materials.at("b");
  EXPECT_FALSE(glass.Kd);
  EXPECT_EQ(glass.d, 0.25);
  EXPECT_EQ(glass.Ni, 1.33);
  EXPECT_EQ(glass.map_Kd, "w.png");
  EXPECT_TRUE(glass.is_glass());
}

TEST_F(Mtl, ErrorsNameTheLine) {
  EXPECT_THAT(refusal("Kd 1 1"), testing::HasSubstr("m.mtl: line 2: Kd needs a finite number, but has ''"));
  EXPECT_THAT(refusal("Kd a"), testing::HasSubstr("line 2: Kd needs a finite number, but has 'a'"));
  EXPECT_THAT(refusal("Ke inf"), testing::HasSubstr("line 2: Ke needs a finite number, but has 'inf'"));
  EXPECT_THAT(refusal("Ks 1 -1 1"), testing::HasSubstr("line 2: Ks (1, -1, 1) must be >= 0"));
  EXPECT_THAT(refusal("Ns -2"), testing::HasSubstr("line 2: Ns -2 must be >= 0"));
  EXPECT_THAT(refusal("d 1.5"), testing::HasSubstr("line 2: d 1.5 must lie in [0, 1]"));
  EXPECT_THAT(refusal("Ni 0"), testing::HasSubstr("line 2: Ni 0 must be > 0"));
  EXPECT_THAT(refusal("Kd spectral file.rfl"), testing::HasSubstr("but has 'spectral'"));
  EXPECT_THAT(support::error_of([] { read_mtl("none.mtl"); }), testing::HasSubstr("none.mtl"));
}

} // namespace

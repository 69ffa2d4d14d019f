// The seed corpus of the fuzzers and the inputs that they found: each file is read, or rejected with a one-line error.

#include "fuzz/readers.h"

#include <mc/core/file.h>
#include <mc/random/pcg.h>

#include "support/files.h"

#include <filesystem>

namespace {

namespace fs = std::filesystem;

TEST(Corpus, EveryFileIsReadOrRefusedInOneLine) {
  for (const fuzz::Reader& reader : fuzz::readers) {
    int read = 0, refused = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(MC_SOURCE_DIR "/tests/fuzz/corpus") / reader.format)) {
      const std::string path = entry.path().string();
      EXPECT_EQ(entry.path().extension(), "." + std::string(reader.format)) << path;
      const std::string said = support::error_of([&] { reader.read(path); });
      EXPECT_EQ(said.find('\n'), std::string::npos) << said;
      const bool is_broken = entry.path().stem().string().starts_with("broken");
      EXPECT_EQ(!said.empty(), is_broken) << path << ": " << said;
      (said.empty() ? read : refused)++;
    }
    EXPECT_GE(read, 1) << reader.format;
    EXPECT_GE(refused, 1) << reader.format;
  }
}

// Every file of the corpus, truncated or with one byte changed, at a third of all positions.
struct NearlyCorpus : support::ScratchTest {};
TEST_F(NearlyCorpus, IsReadOrRefusedInOneLine) {
  mc::Pcg random(5);
  std::size_t tried = 0;
  for (const fuzz::Reader& reader : fuzz::readers)
    for (const auto& entry : fs::directory_iterator(fs::path(MC_SOURCE_DIR "/tests/fuzz/corpus") / reader.format)) {
      const std::string bytes = mc::read_file(entry.path().string());
      for (std::size_t n = tried % 3; n < bytes.size(); n += 3) {
        std::string changed = bytes;
        changed[n] = static_cast<char>(random.uniform<double>() * 256);
        for (const std::string& text : {bytes.substr(0, n), changed}) {
          const std::string file = write("near." + std::string(reader.format), text);
          const std::string said = support::error_of([&] { reader.read(file); });
          EXPECT_EQ(said.find('\n'), std::string::npos) << entry.path() << " at " << n << ": " << said;
          ++tried;
        }
      }
    }
  EXPECT_GT(tried, 2000u);
}

} // namespace

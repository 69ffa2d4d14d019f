#include <gmock/gmock.h>

#ifdef MC_TEST_MPI

#include <mc/run/mpi_links.h>

#include <mc/core/file.h>
#include <mc/run/mpi_program.h>

#include <csignal>

namespace {

using mc::detail::MpiLinks, mc::detail::MpiMessage, mc::detail::Pause;

MpiMessage next_message(MpiLinks& links) {
  for (Pause pause;; pause.wait())
    if (std::optional<MpiMessage> m = links.receive()) return *m;
}

// Rank r sends r bytes to rank 0, which sends all of them to every rank. Returns 0 if all is right.
int exchange_bytes() {
  MpiLinks links(MPI_COMM_WORLD);
  std::string all;
  if (links.rank() > 0) links.send(0, mc::detail::tag_result, std::string(std::size_t(links.rank()), 'a'));
  for (int left = links.rank() > 0 ? 0 : links.size() - 1; left > 0;) {
    const MpiMessage m = next_message(links);
    if (m.tag != mc::detail::tag_result) continue;
    if (m.bytes.size() != std::size_t(m.source)) return 1;
    all += m.bytes;
    --left;
  }
  links.broadcast(all);
  return all.size() == std::size_t(links.size() * (links.size() - 1) / 2) ? 0 : 2;
}

// Rank 1 dies after its hello; rank 0 writes what it notices.
int lose_a_rank() {
  MpiLinks links(MPI_COMM_WORLD);
  if (links.rank() == 1) std::raise(SIGKILL);
  const MpiMessage hello = next_message(links);
  mc::ArchiveReader reader(hello.bytes);
  reader(links.others()[1].host, links.others()[1].process);
  try {
    for (Pause pause;; pause.wait()) links.require_alive();
  } catch (const mc::LostRank& e) {
    mc::write_file(std::string(std::getenv("MC_TEST_FOLDER")) + "/lost", e.what());
  }
  MPI_Abort(MPI_COMM_WORLD, links.is_lost ? 3 : 4);
  return 0;
}

const bool has_link_programs =
    support::add_mpi_program("exchange bytes", exchange_bytes) && support::add_mpi_program("lose a rank", lose_a_rank);

using MpiLinksTest = support::MpiTest;

TEST_F(MpiLinksTest, Messages_ArriveAndBroadcast) {
  ASSERT_TRUE(has_link_programs);
  for (const int ranks : {1, 2, 5}) EXPECT_EQ(run_mpi("exchange bytes", ranks).exit_code, 0) << ranks;
}

TEST_F(MpiLinksTest, DeadRank_IsNoticed) {
  run_mpi("lose a rank", 2, "--enable-recovery");
  EXPECT_THAT(mc::read_file(path("lost")), testing::ContainsRegex("rank 1 \\(process [0-9]+ on [^)]+\\) died"));
}

} // namespace

#else

TEST(MpiLinks, Messages_ArriveAndBroadcast) { GTEST_SKIP() << "built without MC_MPI"; }

#endif

#include <mc/run/unit_store.h>

#include <gtest/gtest.h>

#include <thread>

namespace {

using mc::detail::UnitStore;

TEST(UnitStore, HandsOutUnitsInOrder_AndKeepsResults) {
  UnitStore store;
  store.add({3, 1});
  store.add({2});
  EXPECT_EQ(store.waiting(), 3u);
  for (const std::size_t unit : {3u, 1u, 2u}) {
    EXPECT_EQ(store.take(), unit);
    store.deliver(unit, std::make_shared<int>(10 * static_cast<int>(unit)));
  }
  EXPECT_EQ(store.delivered(), 3u);
  const auto results = store.take_results();
  ASSERT_EQ(results.size(), 3u);
  EXPECT_EQ(results[1].first, 1u);
  EXPECT_EQ(*std::static_pointer_cast<int>(results[1].second), 10);
  EXPECT_TRUE(store.take_results().empty());
}

TEST(UnitStore, Close_EndsThoseWhoWait) {
  UnitStore store;
  std::optional<std::size_t> unit = 7;
  std::thread waiting([&] { unit = store.take(); });
  store.close();
  waiting.join();
  EXPECT_FALSE(unit.has_value());
  EXPECT_TRUE(store.is_closed());
  store.add({5});
  EXPECT_FALSE(store.take().has_value()) << "a closed store gives out nothing";
}

} // namespace

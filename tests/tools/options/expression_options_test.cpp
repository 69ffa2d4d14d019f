#include <options/expression_options.h>

#include <gmock/gmock.h>

#include <set>

namespace {

// Every field of the context has its option.
TEST(ExpressionOptions, FillTheContext) {
  carlo::ExpressionContext context;
  std::vector<carlo::Option> options = carlo::expression_group(context).options;
  options.push_back(carlo::domain_option(context));
  std::set<const void*> destinations;
  for (const carlo::Option& o : options)
    destinations.insert(std::visit([](auto* field) { return static_cast<const void*>(field); }, o.destination));
  const std::set<const void*> fields = {&context.domain, &context.conditions, &context.lets, &context.settings,
                                        &context.nan};
  EXPECT_EQ(destinations, fields);
}

} // namespace

#include <options/subcommand.h>

namespace carlo {

// A row a subcommand, in the order of --help.
#define CARLO_SUBCOMMANDS(row)                                                                                         \
  row(validate);                                                                                                       \
  row(known_bugs);                                                                                                     \
  row(points);                                                                                                         \
  row(converge);                                                                                                       \
  row(trade);                                                                                                          \
  row(integrate);                                                                                                      \
  row(render);                                                                                                         \
  row(gallery);                                                                                                        \
  row(merge);                                                                                                          \
  row(image);                                                                                                          \
  row(view);                                                                                                           \
  row(compare);                                                                                                        \
  row(worker)

#define CARLO_DECLARE(name) Subcommand name##_subcommand()
#define CARLO_APPEND(name) all.push_back(name##_subcommand())

CARLO_SUBCOMMANDS(CARLO_DECLARE);

std::vector<Subcommand> subcommands() {
  std::vector<Subcommand> all;
  CARLO_SUBCOMMANDS(CARLO_APPEND);
  return all;
}

} // namespace carlo

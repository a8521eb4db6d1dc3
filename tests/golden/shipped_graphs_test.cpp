// The graphs that ship: each loads.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/paths.h"
#include "tests/support/run_shipped.h"

namespace quell::test {
namespace {

TEST(ShippedGraphs, Load) {
  const auto names = installed_graphs(std::filesystem::path(QUELL_TEST_SOURCE) / "graphs");
  EXPECT_GE(names.size(), 2u);
  for (const auto& name : names) {
    SCOPED_TRACE(name);
    EXPECT_NO_THROW(shipped_graph(name));
  }
}

}  // namespace
}  // namespace quell::test

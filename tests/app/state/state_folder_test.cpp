#include "app/state/state_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace orbwatch::app {
namespace {

TEST(StateFolder, IsTheConfiguredOneThenSystemdsThenTheUsualOne) {
  setenv("STATE_DIRECTORY", "/var/lib/one:/var/lib/two", 1);
  EXPECT_EQ(state_folder("/data/orbwatch"), "/data/orbwatch");
  EXPECT_EQ(state_folder(""), "/var/lib/one");
  setenv("STATE_DIRECTORY", "", 1);
  EXPECT_EQ(state_folder(""), "/var/lib/orbwatch");
  unsetenv("STATE_DIRECTORY");
  EXPECT_EQ(state_folder(""), "/var/lib/orbwatch");
}

}  // namespace
}  // namespace orbwatch::app

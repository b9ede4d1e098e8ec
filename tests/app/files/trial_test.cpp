#include "app/files/trial.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "tests/support/temporary_folder.h"

namespace orbwatch::app {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class TrialFile : public testing::Test {
 protected:
  const tests::TemporaryFolder folder_;
  const fs::path requested_ = folder_ / "trial.json";
};

TEST_F(TrialFile, IsTakenOnceAndRunsUntilItsEnd) {
  EXPECT_EQ(take_trial(folder_.path()).value(), std::nullopt);
  ASSERT_TRUE(request_trial(folder_.path(), {"/etc/site.toml", {{"/etc/rig.toml", "x"}}, 30}));
  EXPECT_TRUE(is_trial_requested(folder_.path()));
  const auto taken = take_trial(folder_.path());
  ASSERT_TRUE(taken && *taken);
  EXPECT_EQ((*taken)->site, "/etc/site.toml");
  EXPECT_EQ((*taken)->seconds, 30);
  EXPECT_EQ((*taken)->texts.at("/etc/rig.toml"), "x");
  EXPECT_FALSE(is_trial_requested(folder_.path()));
  EXPECT_TRUE(running_trial(folder_.path()).value());
  EXPECT_TRUE(end_trial(folder_.path()));
  EXPECT_EQ(running_trial(folder_.path()).value(), std::nullopt);
}

TEST_F(TrialFile, ThatIsDamagedIsRefused) {
  for (const char* text : {"", "{", "[]", "{\"site\": 1}"}) {
    std::ofstream(requested_) << text;
    EXPECT_THAT(take_trial(folder_.path()).error().message, HasSubstr("is damaged")) << text;
  }
}

/// A pipe without a writer would be waited for.
TEST_F(TrialFile, IsNoPipeAndNoFolder) {
  ASSERT_EQ(::mkfifo(requested_.c_str(), 0600), 0);
  EXPECT_THAT(take_trial(folder_.path()).error().message, HasSubstr("cannot be read: is a pipe"));
  end_trial(folder_.path());
  fs::create_directory(requested_);
  EXPECT_THAT(take_trial(folder_.path()).error().message, HasSubstr("Is a directory"));
}

}  // namespace
}  // namespace orbwatch::app

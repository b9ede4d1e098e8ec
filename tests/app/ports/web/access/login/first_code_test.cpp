// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/access/login/first_code.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <set>

#include "app/ports/web/access/access.h"
#include "app/ports/web/access/login/secret.h"
#include "tests/app/ports/web/access/access_served.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::web::tests {
namespace {

using orbwatch::tests::TemporaryFolder;
using std::chrono::seconds;

TEST(FirstCode, IsRandomAndCanBeTypedInManyWays) {
  std::set<std::string> codes;
  for (int i = 0; i < 200; ++i) codes.insert(random_code());
  EXPECT_EQ(codes.size(), 200U);
  for (const std::string& code : codes)
    EXPECT_THAT(code, testing::MatchesRegex("[0-9A-Z]{4}-[0-9A-Z]{4}"));
  for (const char* typed : {"K701-2M9P", "k701-2m9p", "K7012M9P", " k7OI 2m9p ", "K7oL2M9P"}) {
    EXPECT_TRUE(is_code("K701-2M9P", typed)) << typed;
  }
  for (const char* wrong : {"", "-", "K701-2M9", "K701-2M9PP", "K701-2M9Q", "\xff"}) {
    EXPECT_FALSE(is_code("K701-2M9P", wrong)) << wrong;
  }
  EXPECT_FALSE(is_code("", "")) << "there is none";
}

TEST(FirstCode, IsKeptForItsOwnerOnlyUntilItIsForgotten) {
  const TemporaryFolder folder;
  EXPECT_EQ(kept_code(folder.path()).value(), std::nullopt);
  const std::string code = keep_code(folder.path()).value();
  EXPECT_EQ(keep_code(folder.path()).value(), code);
  EXPECT_EQ(kept_code(folder.path()).value(), code);
  struct stat about {};
  ASSERT_EQ(::stat((folder.path() / "first-code").c_str(), &about), 0);
  EXPECT_EQ(about.st_mode & 07777U, 0600U);
  EXPECT_TRUE(forget_code(folder.path()));
  EXPECT_TRUE(forget_code(folder.path())) << "it is gone already";
  EXPECT_NE(keep_code(folder.path()).value(), code);
}

class FirstPassword : public testing::Test {
 protected:
  void SetUp() override { restart(); }
  void restart(bool gives_code = true) {
    access = std::make_unique<Access>(folder.path(), Sessions::Limits{seconds(600), seconds(3600)},
                                      [this] { return now; });
    access->start(gives_code);
  }
  std::string code() const { return kept_code(folder.path()).value().value_or(""); }
  int status_of(const std::string& typed, const std::string& peer = kPeer) const {
    const auto token = access->set_first_password(typed, kPassword, peer);
    return token ? 200 : token.error().status;
  }

  TemporaryFolder folder;
  Utc now{seconds(1'800'000'000)};
  std::unique_ptr<Access> access;
};

TEST_F(FirstPassword, IsSetOnceByWhoKnowsTheCode) {
  const std::string first = code();
  restart();
  EXPECT_EQ(code(), first) << "what was read from the log stays valid";
  const auto token = access->set_first_password(first, kPassword, kPeer);
  ASSERT_TRUE(token) << token.error().what;
  EXPECT_EQ(access->caller({kPeer, *token, {}}).role, Role::Administrator);
  EXPECT_TRUE(access->login("admin", kPassword, kPeer));
  EXPECT_EQ(status_of(first), 409);
  EXPECT_EQ(code(), "");
  restart();
  EXPECT_EQ(code(), "");
}

TEST_F(FirstPassword, GuessingIsSlowedDownForAnAddressAcrossARestart) {
  for (int i = 0; i < LoginLimits::kFree; ++i) EXPECT_EQ(status_of("0000-0000"), 403);
  EXPECT_EQ(status_of(code()), 429) << "the right one is refused, too";
  restart();
  EXPECT_EQ(status_of(code()), 429);
  now += seconds(1);
  EXPECT_EQ(status_of(code()), 200);
}

TEST_F(FirstPassword, GuessesOfOthersKeepNobodyOut) {
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(status_of("0000-0000", "10.0.1." + std::to_string(i / 5)), 403);
  }
  EXPECT_EQ(status_of(code(), "10.0.2.1"), 200);
}

TEST_F(FirstPassword, ThereIsNoCodeWhereOnlyThisComputerIsServed) {
  ASSERT_TRUE(forget_code(folder.path()));
  restart(false);
  EXPECT_EQ(code(), "");
  EXPECT_EQ(status_of(""), 409);
  EXPECT_EQ(status_of("0000-0000"), 409);
}

TEST_F(FirstPassword, ThePasswordOfAnotherProcessEndsTheCode) {
  const std::string first = code();
  ASSERT_TRUE(change_users(users_file(folder.path()), [](Users& users) {
    return set_user(users, "kim", Role::Administrator, hash_password(kPassword).value());
  }));
  EXPECT_EQ(status_of(first), 409);
  EXPECT_EQ(code(), "");
  std::filesystem::remove(users_file(folder.path()));
  access->refresh();
  EXPECT_EQ(code(), "") << "lost users are a fault";
  std::filesystem::remove(folder / "password-is-set");
  restart();
  EXPECT_NE(code(), "") << "as if no password had ever been set";
  EXPECT_NE(code(), first);
}

}  // namespace
}  // namespace orbwatch::app::web::tests

// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/access/access.h"

#include <gmock/gmock.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "app/ports/web/access/login/secret.h"
#include "app/state/private_file.h"
#include "tests/app/ports/web/access/access_served.h"
#include "tests/support/sanitizers.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::web::tests {
namespace {

using orbwatch::tests::TemporaryFolder;
using std::chrono::seconds;
using testing::HasSubstr;

constexpr Sessions::Limits kLimits{seconds(600), seconds(3600)};

class AccessTest : public testing::Test {
 protected:
  void SetUp() override { restart(); }
  void restart() {
    access = std::make_unique<Access>(folder.path(), kLimits, [this] { return now; });
    access->start();
  }
  void add(const std::string& name, Role role) const {
    // Changed by another process, like `orbwatch password`.
    ASSERT_TRUE(change_users(users_file(folder.path()), [&](Users& users) {
      return set_user(users, name, role, hash_password(kPassword).value());
    }));
    access->refresh();
  }
  Caller by_session(const std::string& token) const { return access->caller({kPeer, token, {}}); }

  TemporaryFolder folder;
  Utc now{seconds(1'800'000'000)};
  std::unique_ptr<Access> access;
};

TEST_F(AccessTest, WithoutUsersOnlyThisComputerMayDoAnything) {
  EXPECT_EQ(access->caller({"127.0.0.1", {}, {}}).role, Role::Administrator);
  EXPECT_EQ(access->caller({"::1", {}, {}}).role, Role::Administrator);
  EXPECT_EQ(access->caller({kPeer, {}, {}}).role, Role::Nobody);
  EXPECT_EQ(access->login("admin", kPassword, kPeer).error().status, 409);
  add("admin", Role::Administrator);
  EXPECT_EQ(access->caller({"127.0.0.1", {}, {}}).role, Role::Nobody);
}

TEST_F(AccessTest, ASessionIsItsUserUntilItIsLoggedOut) {
  add("admin", Role::Administrator);
  add("kim", Role::Operator);
  const auto token = access->login("kim", kPassword, kPeer);
  ASSERT_TRUE(token) << token.error().what;
  EXPECT_EQ(by_session(*token).name, "kim");
  EXPECT_EQ(by_session(*token).role, Role::Operator);
  EXPECT_EQ(by_session(*token + "x").role, Role::Nobody);
  EXPECT_EQ(access->caller({kPeer, {}, *token}).role, Role::Nobody) << "no token of a program";
  access->logout(*token);
  EXPECT_EQ(by_session(*token).role, Role::Nobody);
}

TEST_F(AccessTest, ASessionEndsUnusedAndAtItsAge) {
  add("admin", Role::Administrator);
  const std::string used = access->login("admin", kPassword, kPeer).value();
  const std::string unused = access->login("admin", kPassword, kPeer).value();
  for (int i = 0; i < 6; ++i) {
    now += kLimits.idle - seconds(1);
    EXPECT_EQ(by_session(used).role, Role::Administrator) << i;
  }
  EXPECT_EQ(by_session(unused).role, Role::Nobody);
  now += kLimits.idle - seconds(1);
  EXPECT_EQ(by_session(used).role, Role::Nobody) << "older than it may be";
}

TEST_F(AccessTest, SessionsOutlastARestart) {
  add("admin", Role::Administrator);
  const std::string token = access->login("admin", kPassword, kPeer).value();
  restart();
  EXPECT_EQ(by_session(token).role, Role::Administrator);
  access->logout(token);
  restart();
  EXPECT_EQ(by_session(token).role, Role::Nobody);
}

TEST_F(AccessTest, AUserWhoIsRemovedOrHasANewPasswordIsLoggedOut) {
  add("admin", Role::Administrator);
  add("kim", Role::Operator);
  const std::string kim = access->login("kim", kPassword, kPeer).value();
  const std::string admin = access->login("admin", kPassword, kPeer).value();
  ASSERT_TRUE(access->change([](Users& users) {
    std::erase_if(users.users, [](const User& user) { return user.name == "kim"; });
    return Result<>();
  }));
  EXPECT_EQ(by_session(kim).role, Role::Nobody);
  EXPECT_EQ(by_session(admin).role, Role::Administrator);
  add("admin", Role::Administrator);  // the same password, hashed again
  EXPECT_EQ(by_session(admin).role, Role::Nobody);
}

TEST_F(AccessTest, ANewRoleCountsAtOnce) {
  add("admin", Role::Administrator);
  add("kim", Role::Integrator);
  const std::string token = access->login("kim", kPassword, kPeer).value();
  ASSERT_TRUE(
      access->change([](Users& users) { return set_user(users, "kim", Role::Viewer, ""); }));
  EXPECT_EQ(by_session(token).role, Role::Viewer);
}

TEST_F(AccessTest, GuessingIsSlowedDownAcrossARestart) {
  add("admin", Role::Administrator);
  for (int i = 0; i < LoginLimits::kFree; ++i) {
    const auto guessed = access->login("admin", "wrong password " + std::to_string(i), kPeer);
    ASSERT_FALSE(guessed);
    EXPECT_EQ(guessed.error().status, 401);
    EXPECT_EQ(guessed.error().what, "name or password is wrong");
  }
  for (int i = 0; i < 2; ++i) {
    const auto refused = access->login("admin", kPassword, kPeer);
    ASSERT_FALSE(refused) << "the right one is refused, too";
    EXPECT_EQ(refused.error().status, 429);
    EXPECT_EQ(refused.error().retry_after, seconds(1));
    restart();
  }
  now += seconds(1);
  EXPECT_TRUE(access->login("admin", kPassword, kPeer));
}

TEST_F(AccessTest, AnUnknownNameIsRefusedAsAWrongPasswordIs) {
  add("admin", Role::Administrator);
  for (const char* name : {"nobody", "", "No Name"}) {
    const auto refused = access->login(name, kPassword, kPeer);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().status, 401);
    EXPECT_EQ(refused.error().what, "name or password is wrong");
  }
}

/// Leaves the process less memory than a hash needs, during its lifetime.
class NoMemoryForAHash {
 public:
  NoMemoryForAHash() {
    rlim_t used_pages = 0;
    std::ifstream("/proc/self/statm") >> used_pages;
    ::getrlimit(RLIMIT_AS, &before_);
    rlimit limit = before_;
    limit.rlim_cur = used_pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + kHash / 2;
    ::setrlimit(RLIMIT_AS, &limit);
  }
  ~NoMemoryForAHash() { ::setrlimit(RLIMIT_AS, &before_); }
  NoMemoryForAHash(const NoMemoryForAHash&) = delete;
  NoMemoryForAHash& operator=(const NoMemoryForAHash&) = delete;

  /// False: this system ignores the limit.
  static bool has_effect() {
    void* const memory =
        ::mmap(nullptr, kHash, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) return true;
    ::munmap(memory, kHash);
    return false;
  }

 private:
  static constexpr std::size_t kHash = std::size_t{64} << 20;
  rlimit before_{};
};

TEST_F(AccessTest, APasswordThatCannotBeCheckedIsNoWrongOne) {
  if (orbwatch::tests::kIsSanitized) GTEST_SKIP() << "a sanitizer needs address space of its own";
  add("admin", Role::Administrator);
  {
    const NoMemoryForAHash no_memory;
    if (!NoMemoryForAHash::has_effect()) GTEST_SKIP() << "this system does not limit memory";
    for (int i = 0; i <= LoginLimits::kFree; ++i) {
      for (const char* name : {"admin", "nobody"}) {
        const auto refused = access->login(name, kPassword, kPeer);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().status, 503) << refused.error().what;
        EXPECT_THAT(refused.error().what, HasSubstr("less than 64 MiB of memory is free"));
      }
    }
    const auto unchanged = access->change_password("admin", kPassword, "another long one", kPeer);
    ASSERT_FALSE(unchanged);
    EXPECT_EQ(unchanged.error().status, 503);
  }
  EXPECT_EQ(access->failures(), 0U);
  EXPECT_TRUE(access->login("admin", kPassword, kPeer)) << "nobody has to wait";
}

TEST_F(AccessTest, APasswordIsChangedByWhoKnowsIt) {
  add("admin", Role::Administrator);
  const std::string before = access->login("admin", kPassword, kPeer).value();
  const std::string next = "another long password";
  EXPECT_EQ(access->change_password("admin", "not the old one", next, kPeer).error().status, 401);
  EXPECT_EQ(access->change_password("admin", kPassword, "short", kPeer).error().status, 400);
  EXPECT_EQ(by_session(before).role, Role::Administrator);
  const auto after = access->change_password("admin", kPassword, next, kPeer);
  ASSERT_TRUE(after) << after.error().what;
  EXPECT_EQ(by_session(*after).role, Role::Administrator);
  EXPECT_EQ(by_session(before).role, Role::Nobody);
  EXPECT_FALSE(access->login("admin", kPassword, kPeer));
  EXPECT_TRUE(access->login("admin", next, kPeer));
}

TEST_F(AccessTest, AFileThatCannotBeUsedLetsNobodyIn) {
  add("admin", Role::Administrator);
  const std::string token = access->login("admin", kPassword, kPeer).value();
  const auto file = users_file(folder.path());
  ::chmod(file.c_str(), 0644);
  access->refresh();
  EXPECT_EQ(by_session(token).role, Role::Nobody);
  EXPECT_EQ(access->caller({"127.0.0.1", {}, {}}).role, Role::Nobody);
  const auto refused = access->login("admin", kPassword, kPeer);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().status, 503);
  EXPECT_THAT(refused.error().what, HasSubstr("600 by chmod"));
}

/// The state folder was unmounted, or the file was removed.
TEST_F(AccessTest, UsersThatAreGoneLetNobodyInAlsoAfterARestart) {
  add("admin", Role::Administrator);
  std::filesystem::rename(users_file(folder.path()), folder / "elsewhere");
  access->refresh();
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(access->caller({"127.0.0.1", {}, {}}).role, Role::Nobody);
    const auto refused = access->login("admin", kPassword, kPeer);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().status, 503);
    EXPECT_THAT(refused.error().what, HasSubstr("is missing, although"));
    EXPECT_EQ(access->set_first_password("", kPassword, "127.0.0.1").error().status, 409);
    restart();
  }
  std::filesystem::rename(folder / "elsewhere", users_file(folder.path()));
  EXPECT_TRUE(access->login("admin", kPassword, kPeer));
}

TEST_F(AccessTest, AFolderThatVanishesOpensNoDoor) {
  add("admin", Role::Administrator);
  const TemporaryFolder other;
  std::filesystem::rename(folder.path(), other / "away");
  access->refresh();
  EXPECT_EQ(access->caller({"127.0.0.1", {}, {}}).role, Role::Nobody);
  std::filesystem::rename(other / "away", folder.path());
  EXPECT_TRUE(access->login("admin", kPassword, kPeer));
}

/// The end creates the folder again, to save failures.
TEST_F(AccessTest, AFolderThatVanishedOpensNoDoorAfterARestart) {
  add("admin", Role::Administrator);
  std::filesystem::remove_all(folder.path());
  access->refresh();
  access->stop();
  restart();
  EXPECT_EQ(access->caller({"127.0.0.1", {}, {}}).role, Role::Nobody);
}

TEST_F(AccessTest, APasswordSetAtTheBoardReplacesUsersThatAreGone) {
  add("admin", Role::Administrator);
  std::filesystem::remove(users_file(folder.path()));
  restart();
  add("admin", Role::Administrator);
  EXPECT_TRUE(access->login("admin", kPassword, kPeer));
}

/// Trust ends before the file is read again.
TEST_F(AccessTest, TrustEndsWithThePasswordAtOnce) {
  EXPECT_EQ(access->caller({"127.0.0.1", {}, {}}).role, Role::Administrator);
  EXPECT_FALSE(access->has_users());
  ASSERT_TRUE(change_users(users_file(folder.path()), [&](Users& users) {
    return set_user(users, "admin", Role::Administrator, "$hash");
  }));
  EXPECT_EQ(access->caller({"127.0.0.1", {}, {}}).role, Role::Nobody);
  EXPECT_TRUE(access->has_users()) << "or the page asks for the code";
}

class Guessed : public AccessTest {
 protected:
  static std::string guesser(int number) { return "10.0.1." + std::to_string(number); }
  /// Guesses from 16 addresses, each as often as permitted, for `duration`.
  void guess(seconds duration) {
    for (const Utc end = now + duration; now < end; now += seconds(1)) {
      for (int i = 0; i < 16; ++i) {
        if (access->login_refusal("admin", guesser(i))) continue;
        ASSERT_EQ(access->login("admin", "a wrong guess", guesser(i)).error().status, 401);
      }
    }
  }
};

TEST_F(Guessed, ByOthersKeepsNobodyOutWhereTheyHaveLoggedIn) {
  add("admin", Role::Administrator);
  ASSERT_TRUE(access->login("admin", kPassword, kPeer));
  guess(seconds(40));
  restart();
  guess(seconds(2));
  EXPECT_TRUE(access->login("admin", kPassword, kPeer));
  EXPECT_TRUE(access->login("admin", kPassword, "127.0.0.1")) << "on this computer";
  EXPECT_EQ(access->login("admin", kPassword, "127.0.0.9").error().status, 429)
      << "any program there may have this address";
  EXPECT_EQ(access->login("admin", kPassword, "10.0.0.77").error().status, 429);
}

TEST_F(Guessed, WaitsEndWithAPasswordSetAtTheBoard) {
  add("admin", Role::Administrator);
  guess(seconds(40));
  EXPECT_EQ(access->login("admin", kPassword, guesser(0)).error().status, 429);
  add("admin", Role::Administrator);
  EXPECT_TRUE(access->login("admin", kPassword, guesser(0)));
}

TEST_F(Guessed, SuccessForgivesAnAddressThatManyShare) {
  add("admin", Role::Administrator);
  add("kim", Role::Operator);
  for (int i = 0; i < LoginLimits::kFree - 1; ++i) {
    EXPECT_EQ(access->login("kim", "a typing error", kPeer).error().status, 401);
  }
  EXPECT_TRUE(access->login("kim", kPassword, kPeer));
  EXPECT_EQ(access->login("admin", "a typing error", kPeer).error().status, 401);
  EXPECT_TRUE(access->login("admin", kPassword, kPeer));
}

TEST_F(AccessTest, NoFileHoldsAPasswordOrAToken) {
  add("admin", Role::Administrator);
  const std::string token = access->login("admin", kPassword, kPeer).value();
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    const std::string text = read_private(entry.path()).value().value();
    EXPECT_EQ(text.find(kPassword), std::string::npos) << entry.path();
    EXPECT_EQ(text.find(token), std::string::npos) << entry.path();
  }
}

TEST_F(AccessTest, OneUserHasFewSessions) {
  add("admin", Role::Administrator);
  const std::string first = access->login("admin", kPassword, kPeer).value();
  for (std::size_t i = 0; i < Sessions::kMostOfUser; ++i) {
    now += seconds(1);
    ASSERT_TRUE(access->login("admin", kPassword, kPeer));
  }
  EXPECT_EQ(by_session(first).role, Role::Nobody);
}

}  // namespace
}  // namespace orbwatch::app::web::tests

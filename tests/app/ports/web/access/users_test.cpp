// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/access/users.h"

#include <gmock/gmock.h>

#include "app/ports/web/access/login/secret.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::web::tests {
namespace {

using orbwatch::tests::TemporaryFolder;
using testing::HasSubstr;

Users two_and_a_token() {
  return {{{"admin", Role::Administrator, "$hash1"}, {"kim", Role::Viewer, "$hash2"}},
          {{"grafana", Role::Viewer, "abc"}}};
}

TEST(Secret, OnlyThePasswordItselfIsRight) {
  const std::string password = "correct horse battery";
  const auto hash = hash_password(password);
  ASSERT_TRUE(hash);
  EXPECT_TRUE(hash->starts_with("$argon2id$")) << *hash;
  EXPECT_NE(*hash, *hash_password(password)) << "without salt";
  EXPECT_EQ(match_password(*hash, password), PasswordMatch::Right);
  EXPECT_EQ(match_password(*hash, "correct horse batterz"), PasswordMatch::Wrong);
  EXPECT_EQ(match_password(*hash, ""), PasswordMatch::Wrong);
  EXPECT_EQ(match_password("", password), PasswordMatch::Wrong);
  EXPECT_EQ(match_password("nonsense", password), PasswordMatch::Wrong);
  EXPECT_EQ(match_password(hash->substr(0, hash->size() / 2), password), PasswordMatch::Wrong);
}

/// Otherwise the time of a login would tell whether the name is known.
TEST(Secret, AnUnknownNameIsComparedWithTheParametersOfKnownOnes) {
  const auto hash = hash_password("correct horse battery");
  ASSERT_TRUE(hash);
  EXPECT_TRUE(hash->starts_with("$argon2id$v=19$m=65536,t=2,p=1$")) << "that of nobody has these";
  EXPECT_EQ(match_password("", "correct horse battery"), PasswordMatch::Wrong);
}

TEST(Secret, APasswordHasTwelveCharactersNotBytes) {
  EXPECT_FALSE(check_password("elevenchars"));
  EXPECT_TRUE(check_password("twelve chars"));
  EXPECT_FALSE(check_password("\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4\u00e4")) << "14 bytes";
  EXPECT_FALSE(check_password(std::string(513, 'x')));
  EXPECT_THAT(check_password("short").error().message, HasSubstr("5 characters"));
}

TEST(Secret, TokensDifferAndAreKeptAsAnotherText) {
  const std::string token = random_token();
  EXPECT_EQ(token.size(), 43U);
  EXPECT_NE(token, random_token());
  EXPECT_EQ(token_hash(token), token_hash(token));
  EXPECT_EQ(token_hash(token).find(token), std::string::npos);
}

TEST(Users, AreReadAsWritten) {
  const auto read = parse_users(users_text(two_and_a_token()));
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->users.size(), 2U);
  EXPECT_EQ(read->find("kim")->role, Role::Viewer);
  EXPECT_EQ(read->find("kim")->password, "$hash2");
  EXPECT_EQ(read->find("nobody"), nullptr);
  EXPECT_EQ(read->find_token("abc")->name, "grafana");
  EXPECT_EQ(read->find_token("ab"), nullptr);
}

TEST(Users, WhatIsWrongIsRefused) {
  const std::string right = users_text(two_and_a_token());
  const auto with = [&](const std::string& old, const std::string& replacement) {
    std::string text = right;
    const std::size_t place = text.find(old);
    EXPECT_NE(place, std::string::npos) << old;
    return parse_users(text.replace(place, old.size(), replacement));
  };
  EXPECT_FALSE(parse_users(""));
  EXPECT_FALSE(parse_users("[]"));
  EXPECT_FALSE(parse_users(right.substr(0, right.size() / 2)));
  EXPECT_FALSE(with("\"version\": 1", "\"version\": 2"));
  EXPECT_THAT(with("\"administrator\"", "\"viewer\"").error().message,
              HasSubstr("at least one user must be administrator"));
  EXPECT_THAT(with("\"viewer\"", "\"king\"").error().message,
              HasSubstr("viewer, operator, integrator, administrator"));
  EXPECT_FALSE(with("\"kim\"", "\"admin\"")) << "twice";
  EXPECT_FALSE(with("\"kim\"", "\"Kim\""));
  EXPECT_FALSE(with("\"kim\"", "\"\""));
  EXPECT_FALSE(with("\"$hash2\"", "\"\""));
  EXPECT_FALSE(with("\"$hash2\"", "null"));
}

TEST(Users, TheFirstOneMustBeAdministrator) {
  const TemporaryFolder folder;
  const auto file = users_file(folder.path());
  EXPECT_FALSE(change_users(
      file, [](Users& users) { return set_user(users, "kim", Role::Viewer, "$hash"); }));
  EXPECT_EQ(load_users(file).value(), std::nullopt);
  ASSERT_TRUE(change_users(
      file, [](Users& users) { return set_user(users, "admin", Role::Administrator, "$hash"); }));
  EXPECT_FALSE(
      change_users(file, [](Users& users) { return set_user(users, "admin", Role::Viewer, ""); }));
  EXPECT_EQ(load_users(file).value()->find("admin")->role, Role::Administrator);
}

TEST(Users, ADamagedFileIsNotReplaced) {
  const TemporaryFolder folder;
  const auto file = users_file(folder.path());
  ASSERT_TRUE(change_users(
      file, [](Users& users) { return set_user(users, "admin", Role::Administrator, "$hash"); }));
  std::filesystem::resize_file(file, 20);
  const auto changed = change_users(
      file, [](Users& users) { return set_user(users, "other", Role::Administrator, "$hash"); });
  ASSERT_FALSE(changed);
  EXPECT_THAT(changed.error().message, HasSubstr(file.string()));
  EXPECT_EQ(std::filesystem::file_size(file), 20U);
}

TEST(Users, SettingOneKeepsWhatIsNotSaid) {
  Users users = two_and_a_token();
  ASSERT_TRUE(set_user(users, "kim", Role::Operator, ""));
  EXPECT_EQ(users.find("kim")->password, "$hash2");
  ASSERT_TRUE(set_user(users, "kim", std::nullopt, "$new"));
  EXPECT_EQ(users.find("kim")->role, Role::Operator);
  EXPECT_EQ(users.find("kim")->password, "$new");
  EXPECT_FALSE(set_user(users, "lee", Role::Viewer, ""));
  EXPECT_FALSE(set_user(users, "No Name", Role::Viewer, "$new"));
}

}  // namespace
}  // namespace orbwatch::app::web::tests

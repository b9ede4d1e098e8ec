// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "app/ports/web/access/login/first_code.h"
#include "app/ports/web/access/login/secret.h"
#include "app/ports/web/access/users.h"
#include "app/ports/web/tls/server_certificate.h"
#include "tests/app/cli/command_line.h"
#include "tests/app/files/machine_files.h"

/// Runs `orbwatch password` like an installer, with the password on standard input.
namespace orbwatch::tests {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class Password : public CommandLine {
 protected:
  void SetUp() override {
    write("rig.toml", app::files::kRig);
    write("site.toml", "state_folder = \"state\"\n" + app::files::kValid);
  }
  int set(const std::string& password, const std::vector<std::string>& more = {}) {
    write("typed", password + "\n");
    std::vector<std::string> arguments{
        "/bin/sh",        "-c",       R"(exec "$@" <"$0")", path("typed"),
        ORBWATCH_PROGRAM, "password", "--config",           path("site.toml")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    Subprocess program(arguments, folder.path() / "said");
    const int code = program.wait();
    said = program.output();
    return code;
  }
  std::filesystem::path file() const { return app::web::users_file(folder.path() / "state"); }
  app::web::Users users() const {
    const auto loaded = app::web::load_users(file());
    EXPECT_TRUE(loaded && *loaded) << (loaded ? "absent" : loaded.error().message);
    return loaded && *loaded ? **loaded : app::web::Users{};
  }
  bool is_password_of(const std::string& user, const std::string& password) const {
    return app::web::match_password(users().find(user)->password, password) ==
           app::web::PasswordMatch::Right;
  }
};

TEST_F(Password, TheFirstUserIsAdministratorAndAForgottenPasswordIsReplaced) {
  ASSERT_EQ(set("correct horse battery"), 0) << said;
  EXPECT_THAT(said, HasSubstr(file().string()));
  EXPECT_EQ(users().find("admin")->role, app::Role::Administrator);
  EXPECT_TRUE(is_password_of("admin", "correct horse battery"));
  struct stat about {};
  ASSERT_EQ(::stat(file().c_str(), &about), 0);
  EXPECT_EQ(about.st_mode & 07777U, 0600U);
  ASSERT_EQ(set("a second long one", {"kim", "--role", "operator"}), 0) << said;
  ASSERT_EQ(set("another long password"), 0) << said;
  EXPECT_EQ(users().find("kim")->role, app::Role::Operator) << "lost";
  EXPECT_EQ(users().find("admin")->role, app::Role::Administrator);
  EXPECT_TRUE(is_password_of("admin", "another long password"));
}

TEST_F(Password, WhatIsWrongChangesNothingAndIsNotRepeated) {
  ASSERT_EQ(set("correct horse battery"), 0) << said;
  const std::string before = app::web::users_text(users());
  EXPECT_NE(set("elevenchars"), 0);
  EXPECT_THAT(said, HasSubstr("at least 12"));
  EXPECT_EQ(said.find("elevenchars"), std::string::npos) << said;
  EXPECT_NE(set("a second long one", {"kim"}), 0);
  EXPECT_THAT(said, HasSubstr("--role"));
  EXPECT_NE(set("a second long one", {"kim", "--role", "king"}), 0);
  EXPECT_THAT(said, HasSubstr("viewer, operator, integrator, administrator"));
  EXPECT_NE(set("a second long one", {"admin", "--role", "viewer"}), 0);
  EXPECT_THAT(said, HasSubstr("at least one user must be administrator"));
  EXPECT_NE(set("a second long one", {"Kim Lee", "--role", "viewer"}), 0);
  EXPECT_EQ(app::web::users_text(users()), before);
}

TEST_F(Password, ShowsFingerprintAndCodeAsTheyAreAndChangesNothing) {
  const auto show = [&] {
    EXPECT_EQ(set("never read", {"--show"}), 0) << said;
    return said;
  };
  EXPECT_THAT(show(), HasSubstr("HTTPS: not served"));
  write("site.toml", "state_folder = \"state\"\n" + app::files::kValid +
                         "[web]\nenabled = true\naddress = \"0.0.0.0\"\n");
  EXPECT_THAT(show(), AllOf(HasSubstr("no certificate yet"), HasSubstr("no code")));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "state/certificate.pem"));

  // Code and certificate come from the functions that orbwatchd uses.
  const auto state = folder.path() / "state";
  const std::string code = app::web::keep_code(state).value();
  const auto now = *app::now_for(app::Dates::Checked);
  const auto made = app::web::self_made_certificate(state, {"localhost"}, now);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_THAT(show(), AllOf(HasSubstr("self-made"), HasSubstr(made->fingerprint), HasSubstr(code)));

  ASSERT_EQ(set("correct horse battery"), 0) << said;
  EXPECT_THAT(show(), AllOf(HasSubstr("first password: set"), Not(HasSubstr(code))));
}

TEST_F(Password, ADamagedFileIsLeftAlone) {
  ASSERT_EQ(set("correct horse battery"), 0) << said;
  std::filesystem::resize_file(file(), 30);
  EXPECT_NE(set("correct horse battery"), 0);
  EXPECT_THAT(said, HasSubstr(file().string()));
  EXPECT_EQ(std::filesystem::file_size(file()), 30U);
}

}  // namespace
}  // namespace orbwatch::tests

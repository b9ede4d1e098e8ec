// SPDX-License-Identifier: Apache-2.0
#include "app/cli/support/redaction.h"

#include <gmock/gmock.h>

#include <random>

#include "app/cli/support/comments.h"

namespace orbwatch::app::cli::support {
namespace {

using testing::HasSubstr;
using testing::Not;

const Redaction kPlain({});

TEST(Redaction, ValuesOfSecretNamesAreRemovedInAnySyntax) {
  const std::string text = R"(
a = 1
password = "hunter2 and more"
admin_password='hunter2'
"api-token": "hunter2", "port": 8080,
"pin_secret": 42, "limit": 7}
<Password lang="en">hunter2</Password><Port>7</Port>
<PrivateKey>
  data:,hunter2
</PrivateKey>
web.password.admin: hunter2 in clear
ORBWATCH_TOKEN=hunter2
Authorization: Digest hunter2
run --token hunter2
secrets = ["hunter2",
  "hunter2"]
passphrase = """
hunter2
"""
b = 2
)";
  const std::string clean = kPlain(text);
  EXPECT_THAT(clean, Not(HasSubstr("hunter2")));
  EXPECT_THAT(clean, Not(HasSubstr("42")));
  for (const char* kept : {"a = 1\n", "\"port\": 8080", "\"limit\": 7}", "<Port>7</Port>",
                           "\nb = 2\n", "password = [removed]\n"}) {
    EXPECT_THAT(clean, HasSubstr(kept));
  }
}

TEST(Redaction, OtherTextsStayAsTheyAre) {
  for (const char* text :
       {"users = 3\nname = \"front\"\n", "first line\n\nlast line", "", "password_set: true",
        "{\"has_token\": false, \"recipe\": 5}", "a password was wrong",
        "-----BEGIN CERTIFICATE-----\nMIIB\n-----END CERTIFICATE-----\n", "http://host/path@home",
        "code 12 of camera ABCD", "orbwatch_http_tokens 3"}) {
    EXPECT_EQ(kPlain(text), text);
  }
}

TEST(Redaction, KeysUsersHashesAndCodesAreRemoved) {
  EXPECT_EQ(
      kPlain("a\n-----BEGIN EC PRIVATE KEY-----\nMIIB\nSecond\n-----END EC PRIVATE KEY-----\nb"),
      "a\n[removed]\nb");
  EXPECT_EQ(kPlain("-----BEGIN CERTIFICATE-----\nx\n-----END CERTIFICATE-----\n"
                   "-----BEGIN PRIVATE KEY-----\nMIIB"),
            "-----BEGIN CERTIFICATE-----\nx\n-----END CERTIFICATE-----\n[removed]");
  EXPECT_EQ(kPlain("device = \"rtsp://kim:pa@ss@10.0.0.7/1\""),
            "device = \"rtsp://[removed]@10.0.0.7/1\"");
  EXPECT_EQ(kPlain("x $argon2id$v=19$m=65536$abc$def y"), "x [removed] y");
  EXPECT_EQ(kPlain("sent Bearer abc.def-ghi and more"), "sent Bearer [removed] and more");
  EXPECT_EQ(kPlain("another computer sets the first one with the code K7QX-2M9P\nCODE-1234"),
            "another computer sets the first one with the code [removed]\nCODE-1234");
}

TEST(Redaction, KnownValuesAreRemovedWhereverTheyAre) {
  const Redaction redaction({"abcdef", "abcdefgh", "short", "abcdef"});
  EXPECT_EQ(redaction("xabcdefghy abcdef short"), "x[removed]y [removed] short");
}

TEST(Redaction, NoTextAroundASecretKeepsIt) {
  std::mt19937 random(1);
  const std::vector<std::string> parts{
      "password", "=",  ":",  "\"", "'", "[",       "]",      "{",
      "}",        "\\", "\n", " ",  ">", "://",     "@",      "<",
      "code",     "--", "#",  "x",  ",", "$argon2", "\"\"\"", "-----BEGIN PRIVATE KEY-----"};
  const auto around = [&] {
    std::string text;
    for (std::size_t n = random() % 12; n > 0; --n) text += parts[random() % parts.size()];
    return text;
  };
  for (int round = 0; round < 20'000; ++round) {
    const std::string text = around() + "\npassword = \"hunter2\"\n" + around();
    EXPECT_THAT(kPlain(text), Not(HasSubstr("hunter2"))) << text;
  }
}

TEST(Comments, AreRemovedAndLinesStay) {
  EXPECT_EQ(without_comments("# secret\na = \"#1\" # secret\nb = '#2' #\n", "site.toml"),
            "\na = \"#1\" \nb = '#2' \n");
  EXPECT_EQ(without_comments("a = \"\"\"\n# kept\n\"\"\" # gone\n", "site.toml"),
            "a = \"\"\"\n# kept\n\"\"\" \n");
  EXPECT_EQ(without_comments("a = \"\\\"#kept\" # gone", "a.toml"), "a = \"\\\"#kept\" ");
  EXPECT_EQ(without_comments("name: don't # gone\nb: 1 # gone\n", "a.yaml"),
            "name: don't \nb: 1 \n");
  EXPECT_EQ(without_comments("name: 'open # kept\nb: 1 # gone", "a.yaml"),
            "name: 'open # kept\nb: 1 ");
  EXPECT_EQ(without_comments("<a><!-- secret\nsecret --><b/><!-- open", "p.xml"), "<a>\n<b/>");
}

}  // namespace
}  // namespace orbwatch::app::cli::support

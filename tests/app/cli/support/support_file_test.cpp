// SPDX-License-Identifier: Apache-2.0
#include "app/cli/support/support_file.h"

#include <gmock/gmock.h>

#include <map>

#include "app/files/runtime/calibration_file.h"
#include "app/ports/web/access/login/first_code.h"
#include "app/ports/web/access/login/secret.h"
#include "app/ports/web/access/users.h"
#include "app/state/private_file.h"
#include "hal/regular_file.h"
#include "tests/app/files/machine_files.h"
#include "tests/app/health/made_up_tree.h"

/// Collects a support file of a synthetic appliance that keeps a secret in every place.
namespace orbwatch::app::cli::support {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Key;
using testing::Not;

/// Secrets by the place in which they are planted. The parts of keys are as long as lines of PEM.
const std::map<std::string, std::string> kPlanted{
    {"comment", "winter-comment-4711"},
    {"key of the configuration", "winter-key-4711"},
    {"recipe", "winter-recipe-4711"},
    {"user of an address", "winter-address-4711"},
    {"profile", "winter-profile-4711"},
    {"own certificate", "b3duLWNlcnRpZmljYXRlLWtleS1saW5lLTQ3MTE"},
    {"named key", "bmFtZWQta2V5LW9mLWh0dHBzLWxpbmUtNDcxMQ"},
    {"DDS key", "ZGRzLWtleS1saW5lLW9mLXBlbS1maWxlLTQ3MTE"},
    {"key in the configuration folder", "c3RyYXkta2V5LWxpbmUtb2YtcGVtLWZpbGUtNDcx"},
    {"session", "session-hash-4711"},
    {"environment of the daemon", "winter-daemon-4711"},
    {"environment of the program", "winter-program-4711"},
    {"journal", "winter-journal-4711"},
    {"old code", "4K7X-2M9P"},
    {"trial", "winter-trial-4711"},
    {"audit", "winter-audit-4711"},
    {"service", "winter-service-4711"}};

std::string planted(const std::string& place) { return kPlanted.at(place); }

std::string key_pem(const std::string& place) {
  return "-----BEGIN PRIVATE KEY-----\n" + planted(place) + "\n-----END PRIVATE KEY-----\n";
}

class SupportFileTest : public testing::Test {
 protected:
  SupportFileTest() {
    plant_configuration();
    plant_state();
    plant_system();
    sources.board.root = tree.path();
    sources.board.chips = [] { return std::vector<hal::ChipInfo>{}; };
    sources.board.module_cameras = [](std::string_view) { return std::vector<hal::CameraEntry>{}; };
    sources.board.video_module = [] { return Result<>(); };
    sources.config = tree / "site/site.toml";
    sources.versions = "orbwatch 1.2.3\n";
    sources.environment = std::string("HOME=/root\0ORBWATCH_API_TOKEN=", 30) +
                          planted("environment of the program") + '\0';
    sources.page = [this](const WebSettings&, const std::string& target) -> Result<std::string> {
      // The daemon repeats a secret, as it must not.
      return "answer to " + target + ": " + hash + " " + token_hash;
    };
    sources.state = [](const DdsSettings&) -> Result<std::string> { return fail("none arrived"); };
  }

  void plant_configuration() {
    const std::string keys = (tree / "keys").string();
    tree.write("site/rig.toml", "# " + planted("comment") + "\n" + files::kRig);
    tree.write("site/site.toml", "# admin: " + planted("comment") + "\nstate_folder = \"" +
                                     (tree / "state").string() + "\"\n" + files::kValid +
                                     "[web]\nenabled = true # " + planted("comment") +
                                     "\ncertificate = \"" + keys + "/https.pem\"\nkey = \"" + keys +
                                     "/https.key\"\n[dds]\nprofile = \"" + keys +
                                     "/lan.xml\"\n[dds.security]\nfolder = \"" + keys + "/dds\"\n");
    tree.write("site/recipes/old.toml",
               "note = \"\"\"\npassword: x\n\"\"\"\nsecret = '" + planted("recipe") + "'\n");
    tree.write("site/wrong.toml", "admin_password = \"" + planted("key of the configuration") +
                                      "\"\ndevice = \"rtsp://kim:" + planted("user of an address") +
                                      "@10.0.0.7/1\"\n");
    tree.write("site/old-key.pem", key_pem("key in the configuration folder"));
    tree.write("keys/https.pem", "-----BEGIN CERTIFICATE-----\nMIIB\n-----END CERTIFICATE-----\n");
    tree.write("keys/https.key", key_pem("named key"));
    tree.write("keys/dds/key.pem", key_pem("DDS key"));
    tree.write("keys/lan.xml", "<CycloneDDS><!-- " + planted("comment") + " --><Password>" +
                                   planted("profile") + "</Password><PrivateKey>data:,\n" +
                                   key_pem("DDS key") + "</PrivateKey></CycloneDDS>");
  }

  void plant_state() {
    const auto state = tree / "state";
    hash = web::hash_password("winter-password-4711").value_or("no hash");
    token_hash = web::token_hash(web::random_token());
    web::Users users;
    users.users = {{"admin", Role::Administrator, hash}};
    users.tokens = {{"grafana", Role::Viewer, token_hash}};
    ASSERT_TRUE(write_private(web::users_file(state), web::users_text(users)));
    code = web::keep_code(state).value_or("no code");
    tree.write("state/certificate.pem", key_pem("own certificate"));
    tree.write("state/logins.json",
               R"({"sessions": [{"hash": ")" + planted("session") + R"(", "user": "kim"}]})");
    tree.write("state/trial.json", R"({"site.toml": "password = ')" + planted("trial") + R"('"})");
    tree.write("state/audit.jsonl", R"({"what": "token", "api_token": ")" + planted("audit") +
                                        "\"}\n{\"what\": \"restart\"}\n");
    tree.write("state/alarm-history.json",
               R"([{"alarm": "hot", "by": ")" + planted("audit") + R"("}])");
    tree.write("state/calibration.toml", files::calibrations_text({}));
  }

  void plant_system() {
    program("usr/bin/journalctl", "echo \"$@\"\ncat " + (tree / "journal.txt").string());
    program("usr/bin/dpkg-query", "printf 'orbwatch\\t1.2.3\\n'");
    program("usr/bin/systemctl", "echo ActiveState=active token=" + planted("service"));
    tree.write("journal.txt",
               "orbwatchd: web: no password is set; another computer sets the first "
               "one with the code " +
                   code + "\nearlier with the code " + planted("old code") +
                   "\nconnect password=" + planted("journal") + "\nhash " + hash + " and " +
                   token_hash + "\n" + key_pem("own certificate") + planted("DDS key") +
                   "\nkim:" + planted("environment of the daemon") + "\nlast line\n");
    tree.write("proc/7/comm", "orbwatchd\n");
    tree.write("proc/7/environ", std::string("PATH=/bin\0ORBWATCH_PASSWORD=", 28) +
                                     planted("environment of the daemon") + '\0');
    tree.write("proc/version", "Linux 6.12\n");
    tree.write("proc/cmdline", "root=/dev/sda token=" + planted("service") + "\n");
    tree.write("etc/os-release", "ID=debian\n");
    tree.write("proc/device-tree/model", std::string("Raspberry Pi 5\0", 15));
  }

  void program(const std::string& name, const std::string& script) {
    tree.write(name, "#!/bin/sh\n" + script + "\n");
    std::filesystem::permissions(tree / name, std::filesystem::perms::owner_all);
  }

  std::map<std::string, std::string> collect(bool with_pictures = false) {
    const SupportFile file = support_file(sources, with_pictures);
    std::map<std::string, std::string> texts;
    for (const ArchivedFile& one : file.files) texts[one.name] = one.bytes;
    EXPECT_EQ(texts.size(), file.files.size()) << "a name occurs twice";
    EXPECT_EQ(file.files.front().name, "contents.txt");
    for (const auto& [name, reason] : file.left_out) {
      EXPECT_THAT(texts["contents.txt"], HasSubstr("  " + name + ": " + reason + "\n"));
    }
    return texts;
  }

  /// The file of this name, else the list of all.
  static const std::string& at(const std::map<std::string, std::string>& texts,
                               const std::string& name) {
    const auto found = texts.find(name);
    return found != texts.end() ? found->second : texts.at("contents.txt");
  }

  void expect_no_secret(const std::map<std::string, std::string>& texts) {
    auto secrets = kPlanted;
    secrets["hash"] = hash;
    secrets["token"] = token_hash;
    secrets["code"] = code;
    secrets["password"] = "winter-password-4711";
    for (const auto& [place, secret] : secrets) {
      for (const auto& [name, text] : texts) {
        EXPECT_EQ(text.find(secret), std::string::npos) << place << " is in " << name;
      }
    }
  }

  tests::MadeUpTree tree;
  SupportSources sources;
  std::string hash, token_hash, code;
};

TEST_F(SupportFileTest, HasNoSecretFromAnyPlace) { expect_no_secret(collect()); }

TEST_F(SupportFileTest, HasNoSecretWhenTheConfigurationIsWrong) {
  const auto text = hal::read_regular_file(sources.config);
  ASSERT_TRUE(text);
  tree.write("site/site.toml", *text + "\n[wrong]\npassword = " + planted("journal") + "\n");
  expect_no_secret(collect(true));
}

TEST_F(SupportFileTest, HasWhatHelps) {
  const auto texts = collect();
  EXPECT_THAT(at(texts, "configuration/site.toml"), HasSubstr("back_end = \"replay\""));
  EXPECT_THAT(at(texts, "configuration/rig.toml"), HasSubstr("alpha = 340"));
  EXPECT_THAT(at(texts, "configuration/recipes/old.toml"), HasSubstr("secret = [removed]"));
  EXPECT_THAT(at(texts, "configuration/wrong.toml"), HasSubstr("@10.0.0.7/1"));
  EXPECT_THAT(at(texts, "elsewhere" + (tree / "keys/lan.xml").lexically_normal().string()),
              HasSubstr("<CycloneDDS>"));
  EXPECT_THAT(at(texts, "doctor.txt"), HasSubstr("configuration"));
  EXPECT_THAT(at(texts, "doctor.json"), HasSubstr("\"worst\""));
  EXPECT_EQ(at(texts, "versions.txt"), "orbwatch 1.2.3\n");
  EXPECT_EQ(at(texts, "system/packages.txt"), "orbwatch\t1.2.3\n");
  EXPECT_EQ(at(texts, "system/board.txt"), "Raspberry Pi 5\n");
  EXPECT_THAT(at(texts, "journal/service.txt"), HasSubstr("--unit orbwatch "));
  EXPECT_THAT(at(texts, "journal/service.txt"), HasSubstr("\nlast line\n"));
  EXPECT_THAT(at(texts, "running/metrics.txt"), HasSubstr("answer to /metrics"));
  EXPECT_EQ(at(texts, "state/calibration.toml"), files::calibrations_text({}));
  EXPECT_THAT(at(texts, "state/files.txt"), HasSubstr("users.json"));
}

TEST_F(SupportFileTest, HasTheJournalOfTheMachinesUnit) {
  sources.config = "/etc/orbwatch/press/site.toml";
  EXPECT_THAT(at(collect(), "journal/service.txt"), HasSubstr("--unit orbwatch@press "));
}

TEST_F(SupportFileTest, ListsWhatIsLeftOutAndWhy) {
  std::filesystem::remove(tree / "usr/bin/journalctl");
  std::filesystem::create_symlink("/etc/passwd", tree / "site/passwd.toml");
  sources.page = [](const WebSettings&, const std::string&) -> Result<std::string> {
    return fail("needs a login");
  };
  const auto texts = collect();
  const std::string& contents = at(texts, "contents.txt");
  for (const char* line :
       {"  journal/service.txt: /usr/bin/journalctl is not installed\n",
        "  configuration/passwd.toml: is a link\n",
        "  configuration/old-key.pem: not a file of the configuration, and may have a key\n",
        "  running/metrics.txt: needs a login\n", "  running/state.json: none arrived\n",
        "  pictures/: not asked for by --pictures\n"}) {
    EXPECT_THAT(contents, HasSubstr(line));
  }
  EXPECT_THAT(texts, Not(Contains(Key("configuration/old-key.pem"))));
  EXPECT_THAT(texts, Not(Contains(Key("configuration/passwd.toml"))));
}

TEST_F(SupportFileTest, PicturesAreThereOnRequest) {
  const auto texts = collect(true);
  EXPECT_THAT(at(texts, "pictures/views/front.jpg"), HasSubstr("/snapshot.jpg?view=front"));
}

TEST_F(SupportFileTest, IsMadeWithoutAConfiguration) {
  tree.remove("site");
  const auto texts = collect(true);
  EXPECT_THAT(texts, Contains(Key("journal/service.txt")));
  EXPECT_THAT(at(texts, "contents.txt"), HasSubstr("  running/: the configuration cannot be read"));
}

}  // namespace
}  // namespace orbwatch::app::cli::support

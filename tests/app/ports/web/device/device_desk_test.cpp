// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/device/device_desk.h"

#include <gmock/gmock.h>

#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>

#include "tests/app/ports/web/access/access_served.h"
#include "tests/app/ports/web/configuration/written_files.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::web::tests {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Device whose files are made without a program.
class MadeUpDevice : public DeviceFiles {
 public:
  explicit MadeUpDevice(std::filesystem::path folder) : folder_(std::move(folder)) {}

  Result<Made> support(const Figures& figures, bool pictures) override {
    std::string names = pictures ? "pictures " : "";
    for (const auto& [name, text] : figures) names += name + " ";
    return made("support", names);
  }
  Result<Made> backup(const std::optional<std::string>& passphrase, bool events) override {
    if (passphrase && passphrase->size() < 10) return fail("the passphrase is too short");
    return made("backup", std::string(passphrase ? "sealed" : "open") + (events ? "+events" : ""));
  }
  Result<std::uint64_t> upload(std::uint64_t offset, std::string_view bytes) override {
    const std::lock_guard lock(mutex_);
    if (offset == 0) uploaded.clear();
    if (offset != uploaded.size()) return fail("offset must be the size");
    uploaded += bytes;
    return uploaded.size();
  }
  Result<std::string> check(const Restore& restore) override {
    const std::lock_guard lock(mutex_);
    asked = restore;
    if (uploaded.empty()) return fail("no backup was uploaded");
    return json{
        {"host", "cell-4"},
        {"made", "2026-11-28"},
        {"version", "0.9"},
        {"changes", {{{"file", "configuration/site.toml"}, {"change", "changed"}}}},
        {"not_restored", {"state/users.json"}},
        {"left_out", json::array()},
        {"cameras", {{{"name", "thermal"}, {"key", "genicam.camera"}, {"address", "SN-1"}}}},
        {"notes", {"host name"}}}
        .dump();
  }
  Result<std::string> restore(const Restore& restore) override { return check(restore); }
  Result<> reset() override {
    ++resets;
    return {};
  }
  void restart() override { ++restarts; }
  void cancel() override {}

  std::string uploaded;
  Restore asked;
  std::atomic<int> resets = 0, restarts = 0;

 private:
  Result<Made> made(const std::string& name, const std::string& bytes) {
    std::ofstream(folder_ / name) << bytes;
    return Made{folder_ / name, "about " + name};
  }

  const std::filesystem::path folder_;
  std::mutex mutex_;
};

/// Device with two slots whose updates are only kept.
class MadeUpUpdate : public DeviceUpdate {
 public:
  State state() const override {
    const std::lock_guard lock(mutex_);
    return shown;
  }
  Result<std::uint64_t> upload(std::uint64_t offset, std::uint64_t whole,
                               std::string_view bytes) override {
    const std::lock_guard lock(mutex_);
    if (whole > 11) return fail("no room");
    if (offset != uploaded.size()) return fail("offset must be the size");
    uploaded += bytes;
    return uploaded.size();
  }
  Result<> install() override {
    const std::lock_guard lock(mutex_);
    if (uploaded.empty()) return fail("no update was uploaded completely");
    shown.work = Work::Installing;
    shown.percent = 40;
    return {};
  }
  Result<> restart_device() override {
    const std::lock_guard lock(mutex_);
    if (shown.trial != Trial::Installed) return fail("no update is installed");
    ++restarts;
    return {};
  }
  void cancel() override {}

  void show(const State& state) {
    const std::lock_guard lock(mutex_);
    shown = state;
  }

  std::string uploaded;
  std::atomic<int> restarts = 0;

 private:
  static State installed() {
    State state;
    state.version = "1.9";
    state.slot = "a";
    return state;
  }

  State shown = installed();
  mutable std::mutex mutex_;
};

class Device : public AccessServed {
 protected:
  void SetUp() override {
    AccessServed::SetUp();
    program.device = device;
    program.update = update;
    program.files = files;
    add_one_of_each_role();
    start();
  }
  Answer ask(const std::string& what, const json& body, Role role = Role::Administrator) const {
    return post("/api/v1/" + what, body.dump(), by_token(role) + kJsonHeader);
  }
  json state_of_updates() const {
    return json::parse(get(port(), "/api/v1/update", by_token(Role::Administrator)).body);
  }
  Answer file(const std::string& kind, Role role = Role::Administrator) const {
    return get(port(), "/api/v1/device_file?file=" + kind, by_token(role));
  }
  /// Entries of the audit about a request: what changed after it.
  std::vector<std::string> audited(const std::string& what) const {
    const json audit =
        json::parse(get(port(), "/api/v1/audit", by_token(Role::Administrator)).body);
    std::vector<std::string> found;
    for (const auto& entry : audit["entries"]) {
      if (entry["what"] == what) found.push_back(entry.value("after", ""));
    }
    return found;
  }

  const orbwatch::tests::TemporaryFolder folder_of_device;
  const std::shared_ptr<MadeUpDevice> device =
      std::make_shared<MadeUpDevice>(folder_of_device.path());
  const std::shared_ptr<MadeUpUpdate> update = std::make_shared<MadeUpUpdate>();
  const std::shared_ptr<WrittenFiles> files = std::make_shared<WrittenFiles>();
};

TEST_F(Device, SupportFileIsMadeAndDownloaded) {
  EXPECT_EQ(file("support").status, 404);
  const Answer made = ask("make_support_file", {{"pictures", true}});
  ASSERT_EQ(made.status, 200) << made.body;
  EXPECT_EQ(json::parse(made.body)["report"], "about support");
  const Answer got = file("support");
  ASSERT_EQ(got.status, 200);
  EXPECT_EQ(got.headers.at("Content-Type"), "application/zstd");
  EXPECT_THAT(got.headers.at("Content-Disposition"),
              AllOf(HasSubstr("attachment; filename=\""), HasSubstr("-support-20"),
                    HasSubstr(".tar.zst\""), Not(HasSubstr(":"))));
  EXPECT_EQ(got.body, "pictures status.json metrics.txt figures.csv alarms.json ");
  EXPECT_THAT(audited("make_support_file"), testing::ElementsAre("with pictures"));
}

TEST_F(Device, BackupHasSecretsOnlyWithAPassphrase) {
  ASSERT_EQ(ask("make_backup", {{"passphrase", nullptr}}).status, 200);
  EXPECT_EQ(file("backup").body, "open");
  ASSERT_EQ(ask("make_backup", {{"passphrase", "correct horse battery"}}).status, 200);
  EXPECT_EQ(file("backup").body, "sealed");
  ASSERT_EQ(ask("make_backup", {{"passphrase", nullptr}, {"events", true}}).status, 200);
  EXPECT_EQ(file("backup").body, "open+events");
  const Answer refused = ask("make_backup", {{"passphrase", "short"}});
  EXPECT_EQ(refused.status, 409);
  EXPECT_THAT(refused.body, HasSubstr("too short"));
  EXPECT_THAT(audited("make_backup"),
              testing::ElementsAre("without secrets", "secrets encrypted",
                                   "without secrets, with events", "secrets encrypted"));
}

TEST_F(Device, BackupIsUploadedInPartsCheckedAndRestored) {
  EXPECT_EQ(ask("check_restore", {{"passphrase", nullptr}}).status, 409);
  EXPECT_EQ(json::parse(ask("upload_backup", {{"offset", 0}, {"bytes", "Zmlyc3Q="}}).body)["size"],
            5);
  EXPECT_EQ(ask("upload_backup", {{"offset", 4}, {"bytes", "c2Vjb25k"}}).status, 409);
  EXPECT_EQ(ask("upload_backup", {{"offset", 5}, {"bytes", "c2Vjb25k"}}).status, 200);
  EXPECT_EQ(device->uploaded, "firstsecond");
  EXPECT_EQ(ask("upload_backup", {{"offset", 11}, {"bytes", "not Base64"}}).status, 400);
  EXPECT_EQ(audited("upload_backup").size(), 1U) << "one line for a file";

  const json body{{"passphrase", "correct horse battery"},
                  {"cameras", {{{"camera", "thermal"}, {"address", "SN-2"}}}}};
  const json contents = json::parse(ask("check_restore", body).body);
  EXPECT_EQ(contents["changes"][0]["change"], "changed");
  EXPECT_EQ(contents["cameras"][0]["address"], "SN-1");
  EXPECT_EQ(device->restarts, 0);
  ASSERT_EQ(ask("restore", body).status, 200);
  EXPECT_EQ(device->restarts, 1);
  EXPECT_EQ(device->asked.passphrase, "correct horse battery");
  ASSERT_EQ(device->asked.cameras.size(), 1U);
  EXPECT_EQ(device->asked.cameras[0].address, "SN-2");
  EXPECT_TRUE(device->asked.events);
  ASSERT_EQ(ask("check_restore", {{"passphrase", nullptr}, {"events", false}}).status, 200);
  EXPECT_FALSE(device->asked.events);
  EXPECT_THAT(audited("restore"), testing::ElementsAre("backup of cell-4, 2026-11-28"));
}

TEST_F(Device, OnlyTheCheckedBackupIsRestored) {
  const auto upload = [&](int offset, const char* bytes) {
    EXPECT_EQ(ask("upload_backup", {{"offset", offset}, {"bytes", bytes}}).status, 200);
  };
  const json without_hash{{"passphrase", nullptr}};
  upload(0, "Zmlyc3Q=");
  upload(5, "c2Vjb25k");
  json body = without_hash;
  body["sha256"] = json::parse(ask("check_restore", without_hash).body).at("sha256");
  EXPECT_EQ(body["sha256"], "da83f63e1a473003712c18f5afc5a79044221943d1083c7c5a7ac7236d85e8d2");

  upload(0, "Zmlyc3Q=");  // by another user
  const Answer refused = ask("restore", body);
  EXPECT_EQ(refused.status, 409);
  EXPECT_THAT(refused.body, HasSubstr("another backup was uploaded meanwhile; check it first"));
  EXPECT_EQ(device->restarts, 0);
  upload(5, "c2Vjb25k");
  EXPECT_EQ(ask("upload_backup", {{"offset", 5}, {"bytes", "c2Vjb25k"}}).status, 409);
  EXPECT_EQ(ask("restore", body).status, 200) << "the same bytes; a refused part does not count";
  EXPECT_EQ(device->restarts, 1);
  upload(0, "Zmlyc3Q=");
  EXPECT_EQ(ask("restore", without_hash).status, 200) << "as scripts did before there was a hash";
  EXPECT_EQ(device->restarts, 2);
}

TEST_F(Device, ResetNeedsItsWords) {
  const Answer refused = ask("factory_reset", {{"confirmation", "yes"}});
  EXPECT_EQ(refused.status, 400);
  EXPECT_THAT(refused.body, HasSubstr("confirmation must be: factory reset"));
  EXPECT_EQ(device->resets, 0);
  EXPECT_EQ(ask("factory_reset", {{"confirmation", "factory reset"}}).status, 200);
  EXPECT_EQ(device->resets, 1);
  EXPECT_EQ(device->restarts, 1);
}

TEST_F(Device, NothingIsReplacedDuringATrial) {
  files->state.trial.emplace();
  ASSERT_EQ(ask("upload_backup", {{"offset", 0}, {"bytes", "Zmlyc3Q="}}).status, 200);
  for (const Answer& refused : {ask("restore", {{"passphrase", nullptr}}),
                                ask("factory_reset", {{"confirmation", "factory reset"}})}) {
    EXPECT_EQ(refused.status, 409);
    EXPECT_THAT(refused.body, HasSubstr("on trial"));
  }
  EXPECT_EQ(device->restarts, 0);
}

TEST_F(Device, NeedsAnAdministrator) {
  const std::vector<std::pair<std::string, json>> requests{
      {"make_support_file", json::object()},
      {"make_backup", {{"passphrase", nullptr}}},
      {"upload_backup", {{"offset", 0}, {"bytes", ""}}},
      {"check_restore", {{"passphrase", nullptr}}},
      {"restore", {{"passphrase", nullptr}}},
      {"factory_reset", {{"confirmation", "factory reset"}}},
      {"upload_update", {{"offset", 0}, {"size", 1}, {"bytes", ""}}},
      {"install_update", json::object()},
      {"restart_device", json::object()}};
  for (const auto& [what, body] : requests) {
    EXPECT_EQ(ask(what, body, Role::Integrator).status, 403) << what;
  }
  ASSERT_EQ(ask("make_backup", {{"passphrase", nullptr}}).status, 200);
  EXPECT_EQ(file("backup", Role::Integrator).status, 403);
  EXPECT_EQ(get(port(), "/api/v1/update", by_token(Role::Integrator)).status, 403);
}

TEST_F(Device, UpdateIsUploadedInPartsAndInstalled) {
  EXPECT_EQ(ask("install_update", json::object()).status, 409);
  EXPECT_THAT(ask("upload_update", {{"offset", 0}, {"size", 12}, {"bytes", "Zmlyc3Q="}}).body,
              HasSubstr("no room"));
  const auto part = [&](int offset, const char* bytes) {
    return ask("upload_update", {{"offset", offset}, {"size", 11}, {"bytes", bytes}});
  };
  EXPECT_EQ(json::parse(part(0, "Zmlyc3Q=").body)["size"], 5);
  EXPECT_EQ(part(4, "c2Vjb25k").status, 409);
  EXPECT_EQ(part(5, "no Base64").status, 400);
  EXPECT_EQ(part(5, "c2Vjb25k").status, 200);
  EXPECT_EQ(update->uploaded, "firstsecond");
  EXPECT_EQ(ask("install_update", json::object()).status, 200);
  EXPECT_EQ(state_of_updates()["work"], "installing");
  EXPECT_EQ(state_of_updates()["percent"], 40);
  EXPECT_THAT(audited("upload_update"), testing::ElementsAre("begun, 12 bytes", "begun, 11 bytes"));
  EXPECT_THAT(audited("install_update"), testing::ElementsAre("begun", "begun"));
}

TEST_F(Device, StateOfUpdatesHasTheTrial) {
  EXPECT_EQ(state_of_updates()["has_slots"], true);
  EXPECT_EQ(state_of_updates()["trial"], "kept");
  DeviceUpdate::State state = update->state();
  state.version = "1.10";
  state.slot = "b";
  state.trial = DeviceUpdate::Trial::OnTrial;
  state.returns_in = 400;
  state.refusal = "version 1.10 is on trial";
  update->show(state);
  const json trial = state_of_updates();
  EXPECT_EQ(trial["trial"], "on_trial");
  EXPECT_EQ(trial["returns_in"], 400);
  EXPECT_EQ(trial["kept_in"], nullptr);
  EXPECT_EQ(trial["refusal"], "version 1.10 is on trial");
}

TEST_F(Device, RestartsForAnInstalledUpdateOnly) {
  EXPECT_EQ(ask("restart_device", json::object()).status, 409);
  DeviceUpdate::State state = update->state();
  state.trial = DeviceUpdate::Trial::Installed;
  state.other = "1.10";
  update->show(state);
  EXPECT_EQ(ask("restart_device", json::object()).status, 200);
  EXPECT_EQ(update->restarts, 1);
  EXPECT_EQ(audited("restart_device").back(), "tries 1.10");
}

class DeviceWithoutSlots : public Device {
 protected:
  void SetUp() override {
    AccessServed::SetUp();
    program.device = device;
    add_one_of_each_role();
    start();
  }
};

TEST_F(DeviceWithoutSlots, SaysThatUpdatesComeByPackages) {
  EXPECT_EQ(state_of_updates()["has_slots"], false);
  const Answer refused = ask("install_update", json::object());
  EXPECT_EQ(refused.status, 404);
  EXPECT_THAT(refused.body, HasSubstr("update its packages"));
}

}  // namespace
}  // namespace orbwatch::app::web::tests

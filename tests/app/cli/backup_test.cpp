// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "app/cli/archive/tar.h"
#include "app/cli/backup/placement.h"
#include "app/files/resolve.h"
#include "app/state/state_folder.h"
#include "hal/regular_file.h"
#include "tests/app/cli/backup/site.h"
#include "tests/app/cli/command_line.h"
#include "tests/app/files/machine_files.h"
#include "tests/support/service_user.h"

/// Runs `orbwatch backup` on one device and `orbwatch restore` on another, like an installer.
namespace orbwatch::tests {
namespace {

using app::cli::backup::states_below;
using app::cli::backup::write_file;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class BackupProgram : public CommandLine {
 protected:
  void SetUp() override {
    write_file(path("old/rig.toml"), app::files::kRig);
    write_file(path("old/recipes/one.toml"), "note");
    write_file(path("old/keys/key.pem"), "key-of-kim", 0640);
    write_file(path("old/site.toml"),
               app::files::replaced("back_end = \"replay\"\n[camera.replay]\nsource = \"pictures\"",
                                    "back_end = \"genicam\"\nwidth = 100\nheight = 80\n"
                                    "[camera.genicam]\ncamera = \"SN-1\" # left") +
                   "[web]\naddress = \"192.168.7.7\"\n");
    write_file(path("old-state/users.json"), "hash-of-kim", 0600);
    write_file(path("old-state/commands"), "of the old device", 0600);
    std::filesystem::create_directories(path("new"));
    write("passphrase", std::string("correct horse battery\n"));
  }
  void TearDown() override { ::unsetenv("STATE_DIRECTORY"); }

  int run_on(const std::string& device, std::vector<std::string> arguments) {
    ::setenv("STATE_DIRECTORY", path(device + "-state").c_str(), 1);
    arguments.insert(arguments.end(), {"--config", path(device + "/site.toml")});
    return run(arguments);
  }
  int back_up(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"backup", "-o", path("backup.tar.zst")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_on("old", arguments);
  }
  int restore(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"restore", path("backup.tar.zst")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_on("new", arguments);
  }
  std::string full(const std::string& name) const {
    return app::cli::backup::full_path(path(name)).string();
  }
  std::vector<std::string> with_passphrase() { return {"--passphrase-file", path("passphrase")}; }
};

TEST_F(BackupProgram, AnotherDeviceTakesOver) {
  ASSERT_EQ(back_up(with_passphrase()), 0) << said;
  EXPECT_THAT(said, AllOf(HasSubstr("encrypted  state/users.json"),
                          HasSubstr("encrypted  configuration/keys/key.pem")));
  struct stat about {};
  ASSERT_EQ(::stat(path("backup.tar.zst").c_str(), &about), 0);
  EXPECT_EQ(about.st_mode & 07777U, 0600U);
  ASSERT_EQ(restore(with_passphrase()), 0) << said;
  EXPECT_EQ(states_below(path("new")), states_below(path("old")));
  auto state = states_below(path("new-state"));
  state.erase("reserved");
  EXPECT_EQ(state.size(), 1U) << "nothing of the old device itself";
  EXPECT_EQ(state["users.json"].first, "hash-of-kim");
  EXPECT_THAT(said, AllOf(HasSubstr("depends on the device: camera a: genicam.camera = SN-1"),
                          HasSubstr("depends on the device: [web] address = 192.168.7.7"),
                          HasSubstr("systemctl start orbwatch")));
}

TEST_F(BackupProgram, KeptEventsGoAlongWhenAskedFor) {
  const std::string kept = "recordings/events/20261128T092200.125Z-alarm/";
  write_file(path("old/" + kept + "event.mcap"), std::string(100'000, 'm'));
  write_file(path("old/" + kept + "pinned"), "");
  write_file(path("old/recordings/events/20261128T092300.000Z-alarm/event.mcap"), "not kept");
  std::ofstream(path("old/site.toml"), std::ios::app) << "[recorder]\nfolder = \"recordings\"\n";
  ASSERT_EQ(back_up({"--without-secrets"}), 0) << said;
  ASSERT_EQ(restore({"--check"}), 0) << said;
  EXPECT_THAT(said, Not(HasSubstr("092200")));
  ASSERT_EQ(back_up({"--without-secrets", "--with-events"}), 0) << said;
  EXPECT_THAT(said, HasSubstr("event      20261128T092200.125Z-alarm, 100000 bytes"));
  EXPECT_THAT(said, Not(HasSubstr("092300")));
  ASSERT_EQ(restore({"--check", "--json"}), 0) << said;
  EXPECT_THAT(said, HasSubstr(R"({"file":"events/20261128T092200.125Z-alarm","change":"new"})"));
  ASSERT_EQ(restore({"--without-events"}), 0) << said;
  EXPECT_FALSE(std::filesystem::exists(path("new/recordings")));
  ASSERT_EQ(restore(), 0) << said;
  EXPECT_EQ(states_below(path("new/recordings")).size(), 2U);
  EXPECT_EQ(states_below(path("new"))[kept + "event.mcap"].first, std::string(100'000, 'm'));
  ASSERT_EQ(restore({"--check"}), 0) << said;
  EXPECT_THAT(said,
              HasSubstr("same     " + full("new/recordings/events/20261128T092200.125Z-alarm")));

  const auto bytes = hal::read_regular_file(path("backup.tar.zst"));
  ASSERT_TRUE(bytes);
  std::filesystem::remove_all(path("new"));
  std::filesystem::create_directories(path("new"));
  write("backup.tar.zst", bytes->substr(0, bytes->size() - 10));
  EXPECT_EQ(restore({"--check"}), 1);
  EXPECT_THAT(said, HasSubstr("its events cannot be restored: is cut off"));
  EXPECT_EQ(restore(), 1);
  EXPECT_THAT(said, HasSubstr("not all events are restored, and nothing else: is cut off"));
  EXPECT_TRUE(states_below(path("new")).empty());
  ASSERT_EQ(restore({"--without-events"}), 0) << said;
}

TEST_F(BackupProgram, AFileThatTheUserMayNotReadEndsItWithAdvice) {
  ORBWATCH_WITHOUT_ROOT_SKIPPED();
  std::filesystem::permissions(folder.path(), std::filesystem::perms(0777));
  for (const char* file : {"old/site.toml", "old/rig.toml", "old/keys/key.pem"}) {
    std::filesystem::permissions(path(file), std::filesystem::perms(0644));
  }
  EXPECT_TRUE(as_user(kStranger, 077, [&] {
    const int code = back_up({"--without-secrets"});
    return code == 1 && said.find("Permission denied; run it as root: sudo") != std::string::npos;
  }));
  EXPECT_FALSE(std::filesystem::exists(path("backup.tar.zst")));
}

TEST_F(BackupProgram, CamerasOfTheNewDeviceAreSetByOption) {
  ASSERT_EQ(back_up(with_passphrase()), 0) << said;
  auto options = with_passphrase();
  options.insert(options.end(), {"--camera", "a=SN-2"});
  ASSERT_EQ(restore(options), 0) << said;
  const auto text = hal::read_regular_file(path("new/site.toml"));
  ASSERT_TRUE(text);
  EXPECT_THAT(*text, HasSubstr("camera = \"SN-2\" # left"));
  for (const auto& [camera, reason] : std::vector<std::pair<std::string, std::string>>{
           {"b=SN-2", "there is no camera b"}, {"a", "NAME=ADDRESS"}, {"=x", "NAME=ADDRESS"}}) {
    options.back() = camera;
    EXPECT_GT(restore(options), 0);
    EXPECT_THAT(said, HasSubstr(reason));
  }
}

TEST_F(BackupProgram, CheckChangesNothingAndShowsTheChanges) {
  ASSERT_EQ(back_up({"--without-secrets"}), 0) << said;
  EXPECT_THAT(said, HasSubstr("left out   state/users.json"));
  ASSERT_EQ(restore({"--check"}), 0) << said;
  EXPECT_THAT(said, AllOf(HasSubstr("new      " + full("new/site.toml")),
                          HasSubstr("not restored, a secret: state/users.json"),
                          Not(HasSubstr("systemctl"))));
  EXPECT_TRUE(states_below(path("new")).empty());
  ASSERT_EQ(restore(), 0) << said;
  write_file(path("new/rig.toml"), app::files::kRig + "# changed\n");
  write_file(path("new-state/users.json"), "of the new device", 0600);
  ASSERT_EQ(restore({"--check"}), 0) << said;
  EXPECT_THAT(said, AllOf(HasSubstr("same     " + full("new/site.toml")),
                          HasSubstr("changed  " + full("new/rig.toml"))));
  ASSERT_EQ(restore(), 0) << said;
  EXPECT_EQ(states_below(path("new-state"))["users.json"].first, "of the new device");
}

TEST_F(BackupProgram, WhatCannotBeRestoredChangesNothing) {
  ASSERT_EQ(back_up(with_passphrase()), 0) << said;
  write("wrong", std::string("another passphrase\n"));
  EXPECT_EQ(restore({"--passphrase-file", path("wrong")}), 1);
  EXPECT_THAT(said, HasSubstr("backup.tar.zst: the passphrase is wrong"));
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  const auto reserved = app::reserve(path("new-state"));
  ASSERT_TRUE(reserved);
  EXPECT_EQ(restore(with_passphrase()), 1);
  EXPECT_THAT(said, HasSubstr("stop it first: systemctl stop orbwatch"));
  write("backup.tar.zst", std::string("hostile"));
  EXPECT_EQ(restore(), 1);
  EXPECT_THAT(said, HasSubstr("backup.tar.zst: is damaged, or not compressed"));
  EXPECT_TRUE(states_below(path("new")).empty());
}

TEST_F(BackupProgram, AResetPutsTheDeliveredConfigurationBackAndKeepsRecordings) {
  write_file(path("delivered/site.toml"), app::files::kValid, 0644);
  write_file(path("delivered/rig.toml"), app::files::kRig, 0644);
  write_file(path("old/recordings/1.mcap"), "recording");
  write_file(path("old-state/certificate.pem"), "key", 0600);
  write_file(path("old-state/calibration.toml"), "damaged", 0600);
  write_file(path("old-state/audit.jsonl"), "of kim", 0600);
  const auto before = states_below(folder.path());
  const std::vector<std::string> command{"reset", "--factory", "--from", path("delivered")};
  EXPECT_EQ(run_on("old", {"reset", "--from", path("delivered")}), 2) << "without --factory";
  auto checked = command;
  checked.emplace_back("--check");
  ASSERT_EQ(run_on("old", checked), 0) << said;
  EXPECT_THAT(said, AllOf(HasSubstr("changed  " + full("old/site.toml")),
                          HasSubstr("removed  " + full("old/keys/key.pem"))));
  EXPECT_EQ(states_below(folder.path()), before);
  ASSERT_EQ(run_on("old", command), 0) << said;
  auto after = states_below(path("old"));
  EXPECT_EQ(after["recordings/1.mcap"].first, "recording");
  after.erase("recordings/1.mcap");
  EXPECT_EQ(after, states_below(path("delivered")));
  auto state = states_below(path("old-state"));
  EXPECT_EQ(state["commands"].first, "of the old device");
  for (const char* kept : {"commands", "reserved", "calibration.toml"})
    EXPECT_EQ(state.erase(kept), 1U);
  EXPECT_TRUE(state.empty()) << state.begin()->first;
}

TEST_F(BackupProgram, AResetRepairsAConfigurationThatIsWrong) {
  write_file(path("delivered/site.toml"), app::files::kValid, 0644);
  write_file(path("delivered/rig.toml"), app::files::kRig, 0644);
  write_file(path("old/site.toml"), "wrong");
  ASSERT_EQ(run_on("old", {"reset", "--factory", "--from", path("delivered")}), 0) << said;
  EXPECT_EQ(states_below(path("old")), states_below(path("delivered")));
  EXPECT_EQ(run_on("old", {"reset", "--factory", "--from", path("none")}), 1);
  EXPECT_THAT(said, HasSubstr("none"));
  EXPECT_EQ(states_below(path("old")), states_below(path("delivered")));
}

TEST_F(BackupProgram, AnInterruptedRestoreIsUndone) {
  class Interrupted : public app::cli::backup::DiskChanges {
   public:
    Result<> remove(const std::filesystem::path&) override { throw std::runtime_error("cut"); }
  } disk;
  write_file(path("new-state/users.json"), "of the new device", 0600);
  const app::cli::backup::SitePlaces places{path("new"), path("new-state")};
  EXPECT_THROW(
      static_cast<void>(replace_files(
          places, {{"configuration/site.toml", "half"}, {"state/users.json", "half"}}, disk)),
      std::runtime_error);
  EXPECT_FALSE(states_below(path("new")).empty());
  ASSERT_EQ(run_on("new", {"restore", "--undo"}), 0) << said;
  EXPECT_THAT(said, HasSubstr("the old files are back"));
  EXPECT_TRUE(states_below(path("new")).empty());
  EXPECT_EQ(states_below(path("new-state"))["users.json"].first, "of the new device");
  ASSERT_EQ(run_on("new", {"restore", "--undo"}), 0) << said;
  EXPECT_EQ(said, "");
}

TEST_F(BackupProgram, ARunningDaemonLeavesTheFilesForItsNextStart) {
  ASSERT_EQ(back_up(with_passphrase()), 0) << said;
  write_file(path("new-state/users.json"), "of the new device", 0600);
  const auto present = states_below(path("new"));
  auto options = with_passphrase();
  options.insert(options.end(), {"--at-start", "--json"});
  {
    const auto running = app::reserve(path("new-state"));
    ASSERT_TRUE(running);
    ASSERT_EQ(restore(options), 0) << said;
    EXPECT_THAT(said, AllOf(HasSubstr(R"({"file":"configuration/site.toml","change":"new"})"),
                            HasSubstr(R"({"file":"state/users.json","change":"changed"})"),
                            HasSubstr(R"("key":"genicam.camera","address":"SN-1")")));
    EXPECT_EQ(states_below(path("new")), present);
    EXPECT_EQ(run_on("new", {"restore", "--pending"}), 1) << "it runs";
  }
  struct stat about {};
  ASSERT_EQ(::stat(path("new-state/restore-pending.tar").c_str(), &about), 0);
  EXPECT_EQ(about.st_mode & 0777U, 0600U);
  ASSERT_EQ(run_on("new", {"restore", "--pending"}), 0) << said;
  EXPECT_THAT(said, HasSubstr("are in place"));
  EXPECT_EQ(states_below(path("new-state"))["users.json"].first, "hash-of-kim");
  EXPECT_EQ(states_below(path("new")), states_below(path("old")));
  ASSERT_EQ(run_on("new", {"restore", "--pending"}), 0) << said;
  EXPECT_EQ(said, "") << "once";
}

TEST_F(BackupProgram, ARestoreRemovesAConfirmationThatWasNotCompleted) {
  ASSERT_EQ(back_up({"--without-secrets"}), 0) << said;
  for (const bool at_start : {false, true}) {
    write_file(path("new/site.toml"), "of the trial");
    for (const char* trial : {"trial.json", "trial-running.json", "trial-confirmed.json"}) {
      write_file(path("new-state/" + std::string(trial)), "{}", 0600);
    }
    ASSERT_EQ(restore({"--check"}), 0) << said;
    EXPECT_TRUE(states_below(path("new-state")).contains("trial-confirmed.json"));
    ASSERT_EQ(at_start ? restore({"--at-start"}) : restore(), 0) << said;
    ASSERT_EQ(run_on("new", {"restore", "--pending"}), 0) << said;
    const auto state = states_below(path("new-state"));
    for (const char* trial : {"trial.json", "trial-running.json", "trial-confirmed.json"}) {
      EXPECT_FALSE(state.contains(trial)) << trial << ", at the start: " << at_start;
    }
    EXPECT_EQ(states_below(path("new"))["site.toml"], states_below(path("old"))["site.toml"]);
  }
}

/// The page runs the command as the user of the service.
TEST_F(BackupProgram, AFolderThatTheServiceMayNotWriteIsReportedBeforeTheStart) {
  ORBWATCH_WITHOUT_ROOT_SKIPPED();
  ASSERT_EQ(back_up(with_passphrase()), 0) << said;
  write_file(path("new/keys/key.pem"), "another key", 0644);
  std::filesystem::permissions(path("new/keys"), std::filesystem::perms(0755));
  std::filesystem::create_directories(path("new-state"));
  for (const char* own : {"new", "new-state", "backup.tar.zst", "passphrase"}) {
    give_to_service(path(own));
  }
  std::filesystem::permissions(folder.path(), std::filesystem::perms(0777));
  const auto with = [&](const char* option) {
    auto options = with_passphrase();
    options.emplace_back(option);
    return options;
  };
  EXPECT_TRUE(as_service(0027, [&] {
    const std::string reason = full("new/keys") + ": its files cannot be replaced (Permission";
    const auto is_refused = [&](const char* option) {
      return restore(with(option)) == 1 && said.find(reason) != said.npos;
    };
    return is_refused("--check") && is_refused("--at-start");
  }));
  EXPECT_FALSE(std::filesystem::exists(path("new-state/restore-pending.tar")));
  EXPECT_EQ(states_below(path("new")).size(), 1U);
  // The same folder, with the key of the backup: it need not be written.
  write_file(path("new/keys/key.pem"), "key-of-kim", 0640);
  give_to_service(path("new/keys/key.pem"));
  EXPECT_TRUE(as_service(0027, [&] {
    return restore(with("--at-start")) == 0 && run_on("new", {"restore", "--pending"}) == 0;
  }));
  EXPECT_EQ(states_below(path("new")), states_below(path("old")));
}

TEST_F(BackupProgram, AResetAtTheStartRemovesWhatTheDaemonWritesAtItsEnd) {
  write_file(path("delivered/site.toml"), app::files::kValid, 0644);
  write_file(path("delivered/rig.toml"), app::files::kRig, 0644);
  ASSERT_EQ(run_on("old", {"reset", "--factory", "--at-start", "--from", path("delivered")}), 0)
      << said;
  write_file(path("old-state/logins.json"), "of kim", 0600);
  ASSERT_EQ(run_on("old", {"restore", "--pending"}), 0) << said;
  EXPECT_EQ(states_below(path("old")), states_below(path("delivered")));
  const auto state = states_below(path("old-state"));
  EXPECT_FALSE(state.contains("logins.json"));
  EXPECT_FALSE(state.contains("users.json"));
}

TEST_F(BackupProgram, ABackupOnTheBootPartitionIsRestoredOnce) {
  const std::string kept = "recordings/events/20261128T092200.125Z-alarm/";
  write_file(path("old/" + kept + "event.mcap"), "recording");
  write_file(path("old/" + kept + "pinned"), "");
  std::ofstream(path("old/site.toml"), std::ios::app) << "[recorder]\nfolder = \"recordings\"\n";
  auto options = with_passphrase();
  options.emplace_back("--with-events");
  ASSERT_EQ(back_up(options), 0) << said;
  const std::filesystem::path boot = path("boot");
  std::filesystem::create_directories(boot);
  std::filesystem::copy(path("backup.tar.zst"), boot / "restore.tar.zst");
  write_file(boot / "cameras", "a=SN-9\r\n");
  ::setenv("ORBWATCH_RESTORE_FOLDER", boot.c_str(), 1);
  ASSERT_EQ(run_on("new", {"restore", "--pending"}), 0) << said;
  EXPECT_THAT(said, HasSubstr("\nrestored from " + boot.string() +
                              " without its secrets: put their passphrase into " +
                              (boot / "passphrase").string()));
  EXPECT_FALSE(states_below(path("new-state")).contains("users.json"));
  EXPECT_THAT(states_below(path("new"))["site.toml"].first, HasSubstr("camera = \"SN-9\""));
  EXPECT_EQ(states_below(path("new"))[kept + "event.mcap"].first, "recording");
  ASSERT_EQ(run_on("new", {"restore", "--pending"}), 0) << said;
  EXPECT_EQ(said, "") << "the passphrase is still missing";
  // Its passphrase, as an editor of Windows writes it, restores the secrets alone.
  write_file(path("new/recipes/one.toml"), "changed since");
  write_file(path("new-state/trial-confirmed.json"), "{}", 0600);
  write_file(boot / "passphrase.txt",
             "\xEF\xBB\xBF"
             "correct horse battery\r\n");
  ASSERT_EQ(run_on("new", {"restore", "--pending"}), 0) << said;
  EXPECT_THAT(said, HasSubstr("secrets restored from " + boot.string() + "\n"));
  EXPECT_EQ(states_below(path("new-state"))["users.json"].first, "hash-of-kim");
  EXPECT_EQ(states_below(path("new"))["keys/key.pem"].first, "key-of-kim");
  EXPECT_EQ(states_below(path("new"))["recipes/one.toml"].first, "changed since");
  EXPECT_TRUE(states_below(path("new-state")).contains("trial-confirmed.json"));
  write_file(path("new-state/users.json"), "changed since", 0600);
  ASSERT_EQ(run_on("new", {"restore", "--pending"}), 0) << said;
  EXPECT_EQ(said, "");
  EXPECT_EQ(states_below(path("new-state"))["users.json"].first, "changed since");
  // A copy is another file with the same backup: it is recognised by its checksum, once.
  const auto record = [this] {
    return states_below(path("new-state"))["restored-from-boot"].first;
  };
  const std::string first_record = record();
  std::filesystem::copy(boot / "restore.tar.zst", boot / "copy");
  std::filesystem::rename(boot / "copy", boot / "restore.tar.zst");
  ASSERT_EQ(run_on("new", {"restore", "--pending"}), 0) << said;
  EXPECT_EQ(said, "");
  EXPECT_NE(record(), first_record);
  EXPECT_EQ(record().substr(0, record().find('\n')),
            first_record.substr(0, first_record.find('\n')));

  write_file(path("old/recipes/one.toml"), "another note");
  ASSERT_EQ(back_up({"--without-secrets"}), 0) << said;
  std::filesystem::copy(path("backup.tar.zst"), boot / "restore.tar.zst",
                        std::filesystem::copy_options::overwrite_existing);
  ASSERT_EQ(run_on("new", {"restore", "--pending"}), 0) << said;
  EXPECT_EQ(states_below(path("new"))["recipes/one.toml"].first, "another note");
  EXPECT_FALSE(states_below(path("new-state")).contains("trial-confirmed.json"));
  EXPECT_EQ(states_below(path("new-state"))["users.json"].first, "changed since");
  ::unsetenv("ORBWATCH_RESTORE_FOLDER");
}

TEST_F(BackupProgram, ABackupOnTheBootPartitionThatIsWrongChangesNothing) {
  ASSERT_EQ(back_up(with_passphrase()), 0) << said;
  const std::filesystem::path boot = path("boot");
  std::filesystem::create_directories(boot);
  ::setenv("ORBWATCH_RESTORE_FOLDER", boot.c_str(), 1);
  ASSERT_EQ(run_on("new", {"restore", "--pending"}), 0) << "without a backup: " << said;
  const auto expect_refused = [&](const std::string& part) {
    EXPECT_EQ(run_on("new", {"restore", "--pending"}), 1);
    EXPECT_THAT(said, AllOf(HasSubstr("restore.tar.zst"), HasSubstr(part)));
    EXPECT_TRUE(states_below(path("new")).empty());
  };
  write_file(boot / "restore.tar.zst", "garbage");
  expect_refused("");
  std::filesystem::copy(path("backup.tar.zst"), boot / "restore.tar.zst",
                        std::filesystem::copy_options::overwrite_existing);
  write_file(boot / "passphrase", "a wrong one of some length");
  expect_refused("the passphrase is wrong");
  write_file(boot / "passphrase", "correct horse battery");
  write_file(boot / "cameras", "colour");
  expect_refused("NAME=ADDRESS");
  ::unsetenv("ORBWATCH_RESTORE_FOLDER");
}

TEST_F(BackupProgram, PendingFilesThatAreDamagedAreDropped) {
  for (const char* bytes : {"", "garbage"}) {
    write_file(path("new-state/restore-pending.tar"), bytes, 0600);
    EXPECT_EQ(run_on("new", {"restore", "--pending"}), 1);
    EXPECT_THAT(said, HasSubstr("restore-pending.tar"));
    EXPECT_EQ(run_on("new", {"restore", "--pending"}), 0) << said;
  }
  const auto outside = app::cli::tar_of({{"removed", "state/commands\n"}}, {});
  ASSERT_TRUE(outside);
  write_file(path("new-state/restore-pending.tar"), *outside, 0600);
  write_file(path("new-state/commands"), "of the device", 0600);
  EXPECT_EQ(run_on("new", {"restore", "--pending"}), 1);
  EXPECT_EQ(states_below(path("new-state"))["commands"].first, "of the device");
}

TEST_F(BackupProgram, AConfigurationThatIsNotValidIsRefused) {
  ASSERT_EQ(back_up({"--without-secrets"}), 0) << said;
  write_file(path("old/site.toml"), "rig = \"none.toml\"\n");
  EXPECT_EQ(back_up({"--without-secrets"}), 1) << "would not be restored";
  EXPECT_EQ(run_on("old", {"backup"}), 2);
  EXPECT_EQ(back_up({"--without-secrets", "--passphrase-file", "x"}), 2);
  EXPECT_EQ(run_on("new", {"restore"}), 2);
}

/// Several machines on one board have a service each.
TEST_F(BackupProgram, HelpNamesTheServiceOfAnotherMachineAsWell) {
  for (const char* command : {"restore", "reset"}) {
    ASSERT_EQ(run({command, "--help"}), 0) << said;
    EXPECT_THAT(said, HasSubstr("systemctl stop orbwatch, or orbwatch@NAME with --config "
                                "/etc/orbwatch/NAME/site.toml"));
  }
}

TEST_F(BackupProgram, AShortPassphraseIsRefused) {
  write("passphrase", std::string("short\n"));
  EXPECT_EQ(back_up(with_passphrase()), 1);
  EXPECT_THAT(said, HasSubstr("at least 12"));
  EXPECT_FALSE(std::filesystem::exists(path("backup.tar.zst")));
}

}  // namespace
}  // namespace orbwatch::tests

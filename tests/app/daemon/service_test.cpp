// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <functional>
#include <mutex>
#include <utility>

#include "app/daemon/appliance.h"
#include "app/daemon/configuration/configuration_choice.h"
#include "app/files/runtime/calibration_file.h"
#include "tests/app/daemon/daemon_program.h"
#include "tests/app/daemon/hung_thread.h"
#include "tests/support/journal_socket.h"
#include "tests/support/notify_socket.h"

/// `orbwatchd` under a service manager.
namespace orbwatch::tests {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr milliseconds kWatchdog(1000);

using Service = Daemon;

TEST_F(Service, IsReadyFeedsTheWatchdogAndEnds) {
  const NotifySocket manager(folder / "notify", kWatchdog);
  Subprocess daemon = start(write_config(small_machine()));
  manager.await("READY=1");
  manager.await("WATCHDOG=1");

  daemon.send(SIGHUP);
  const std::string reloading = manager.await("RELOADING=1");
  EXPECT_THAT(reloading, HasSubstr("MONOTONIC_USEC="));
  EXPECT_THAT(reloading, HasSubstr("WATCHDOG_USEC=180000000")) << "building all anew takes time";
  EXPECT_THAT(manager.await("READY=1"), HasSubstr("WATCHDOG_USEC=1000000"));
  EXPECT_EQ(thread_of(daemon.pid(), "orbwatchd"), daemon.pid()) << "by this name it is looked for";

  daemon.send(SIGTERM);
  manager.await("STOPPING=1");
  EXPECT_EQ(daemon.wait(), 0) << daemon.output();
}

TEST_F(Service, AHungPipelineIsNotFedByAnythingElse) {
  const NotifySocket manager(folder / "notify", kWatchdog);
  Subprocess daemon = start(write_config(small_machine()));
  manager.await("STATUS=running");
  {
    const HungThread pipeline(thread_of(daemon.pid(), "pipeline"));
    ASSERT_TRUE(pipeline.is_hung());
    EXPECT_TRUE(manager.falls_silent(2 * kWatchdog, 10));
    EXPECT_TRUE(daemon.runs()) << "Modbus and all other threads";
    EXPECT_GT(read("system_frame_set"), 0);
  }
  manager.await("WATCHDOG=1");
}

/// The main thread ends trials and receives SIGTERM: while it hangs, a trial that has to end would
/// run on unnoticed.
TEST_F(Service, AHungMainThreadIsNotFedByThePipeline) {
  const NotifySocket manager(folder / "notify", kWatchdog);
  Subprocess daemon = start(write_config(small_machine()));
  manager.await("STATUS=running");
  {
    const HungThread main(daemon.pid());
    ASSERT_TRUE(main.is_hung());
    EXPECT_TRUE(manager.falls_silent(2 * kWatchdog, 20));
    EXPECT_GT(read("system_frame_set"), 0);
  }
  manager.await("WATCHDOG=1");
}

/// A driver does not answer; see appliance_thread.h.
TEST_F(Service, EndsAlthoughADriverHangs) {
  const NotifySocket manager(folder / "notify", kWatchdog);
  Subprocess daemon = start(write_config(small_machine()));
  manager.await("STATUS=running");
  const HungThread hung(thread_of(daemon.pid(), "appliance"));
  ASSERT_TRUE(hung.is_hung());
  daemon.send(SIGTERM);
  manager.await("STOPPING=1");
  hung.await_end();
  EXPECT_EQ(daemon.wait(), 0) << daemon.output();
  EXPECT_THAT(daemon.output(), HasSubstr("ends without waiting for what hangs"));
}

/// Darkness, a disconnected cable, a camera that was never connected: the pipeline must report
/// progress then, too.
TEST_F(Service, FeedsWithoutACameraAndNotWhenThatHangs) {
  const std::string unplugged =
      "[[camera.fault]]\nfault = \"unplugged\"\nfrom = 3\nuntil = 1000000\n";
  std::string machine = small_machine(unplugged);
  machine.insert(machine.find("[[camera]]\nname = \"thermal\""), unplugged);
  const NotifySocket manager(folder / "notify", kWatchdog);
  Subprocess daemon = start(write_config(machine));
  manager.await("STATUS=fault");
  manager.await("WATCHDOG=1");
  manager.await("WATCHDOG=1");
  const HungThread pipeline(thread_of(daemon.pid(), "pipeline"));
  ASSERT_TRUE(pipeline.is_hung());
  EXPECT_TRUE(manager.falls_silent(2 * kWatchdog, 10));
}

/// The configuration that ran last is used, and every interface reports it.
TEST_F(Service, AWrongConfigurationLeavesTheLastGoodOneRunning) {
  ::setenv("STATE_DIRECTORY", folder.path().c_str(), 1);
  const NotifySocket manager(folder / "notify", kWatchdog);
  const std::string config = write_config(small_machine());
  ::setenv("ORBWATCH_CONFIG", config.c_str(), 1);
  {
    Subprocess daemon({ORBWATCHD_PROGRAM}, folder.path() / "daemon.log");
    manager.await("READY=1");
    ASSERT_TRUE(eventually(daemon, [&] { return read("system_frame_set") > 0; }));
    EXPECT_EQ(read("system_configuration_refused"), 0);
    std::ofstream(config) << "nonsense = ";
    daemon.send(SIGHUP);
    EXPECT_TRUE(eventually(daemon, [&] { return read("system_configuration_refused") == 1; }));
    daemon.send(SIGKILL);
  }
  Subprocess daemon({ORBWATCHD_PROGRAM}, folder.path() / "daemon.log");
  EXPECT_THAT(manager.await("READY=1"), HasSubstr("site.toml:1"));
  EXPECT_TRUE(eventually(daemon, [&] { return read("system_frame_set") > 0; })) << daemon.output();
  EXPECT_EQ(read("system_configuration_refused"), 1);
  EXPECT_THAT(daemon.output(), HasSubstr("the last good configuration runs"));
  ::unsetenv("ORBWATCH_CONFIG");
  ::unsetenv("STATE_DIRECTORY");
}

/// Restarts by the daemon itself come unexpectedly, in the middle of the machine's work.
TEST_F(Service, ARestartOfItsOwnChangesNoRecipeAndStartsNothing) {
  using app::CommandCode;
  using app::CommandResult;
  constexpr int kStopped = 4;
  std::string recipe = kSmallRecipe;
  recipe.replace(recipe.find("\"pool\""), 6, "\"other\"");
  std::ofstream(folder / "other.toml") << recipe;
  const std::string config =
      write_config(small_machine() + "[[recipe]]\nnumber = 2\nfile = \"other.toml\"\n", kSmallRig,
                   "process_active = \"command\"\n" + kSmallRecipe);
  const auto restart = [&](Subprocess& daemon) {
    EXPECT_EQ(command(daemon, CommandCode::Restart), CommandResult::Done);
    EXPECT_TRUE(says(daemon, "recipe 1 is selected, as before the restart"));
    EXPECT_TRUE(eventually(daemon, [&] { return read("system_recipe") == 1; })) << daemon.output();
  };
  {
    Subprocess daemon = start(config);
    ASSERT_TRUE(eventually(daemon, [&] { return read("system_frame_set") > 0; }));
    ASSERT_EQ(read("system_recipe"), 2) << "the first one of the files";
    ASSERT_EQ(command(daemon, CommandCode::SelectRecipe, {1}), CommandResult::Done);
    ASSERT_TRUE(eventually(daemon, [&] { return read("system_recipe") == 1; }));
    ASSERT_EQ(command(daemon, CommandCode::SetProcessActive, {1}), CommandResult::Done);
    ASSERT_TRUE(eventually(daemon, [&] { return read("system_process_active") == 1; }));
    restart(daemon);
    EXPECT_EQ(read("system_process_active"), 0) << "who sees the process must say so";
    EXPECT_NE(read("system_state"), kStopped);
    ASSERT_EQ(command(daemon, CommandCode::Stop), CommandResult::Done);
    restart(daemon);
    EXPECT_TRUE(says(daemon, "measuring stays stopped"));
    EXPECT_TRUE(eventually(daemon, [&] { return read("system_state") == kStopped; }));
    daemon.send(SIGKILL);
    daemon.wait();
  }
  Subprocess daemon = start(config);
  ASSERT_TRUE(eventually(daemon, [&] { return read("system_frame_set") > 0; }));
  EXPECT_EQ(read("system_recipe"), 2) << "after a crash it is as after every start";
  EXPECT_NE(read("system_state"), kStopped);
}

/// Calls `during_start` while the appliance starts, when the interfaces listen already.
class StartWatcher : public app::Sink {
 public:
  explicit StartWatcher(std::function<void()> during_start)
      : during_start_(std::move(during_start)) {}
  Result<> start() override { return {}; }
  void stop() override {}
  app::KeptViews keeps() const override {
    during_start_();
    return {};
  }
  void accept(const app::ViewPtr&) override {}
  void accept(const app::Status& status) override {
    const std::lock_guard lock(mutex_);
    status_ = status;
    changed_.notify_all();
  }
  /// Waits for a frame set that was exposed after `moment`.
  app::Status wait_for_set_after(hal::TimePoint moment) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, std::chrono::minutes(2),
                                  [&] { return status_.frame_set > 0 && status_.stamp > moment; }));
    return status_;
  }

 private:
  const std::function<void()> during_start_;
  std::mutex mutex_;
  std::condition_variable changed_;
  app::Status status_;
};

TEST_F(Service, ARecipeSelectedDuringTheStartReplacesTheOneFromBeforeARestart) {
  using app::CommandCode;
  std::string recipe = kSmallRecipe;
  recipe.replace(recipe.find("\"pool\""), 6, "\"other\"");
  std::ofstream(folder / "other.toml") << recipe;
  auto site = app::files::resolve(
      write_config(small_machine() + "[[recipe]]\nnumber = 2\nfile = \"other.toml\"\n"));
  ASSERT_TRUE(site) << site.error().message;
  std::get<app::DdsSettings>(site->site.sinks).enabled = false;
  app::CommandRecord(site->state_folder)
      .carry_out({app::kPlcClient, sequence}, {CommandCode::SelectRecipe, {1}},
                 [](const app::Command&) { return app::CommandResult::Done; });
  StartWatcher watcher([this] {
    write_command(port, static_cast<std::uint16_t>(CommandCode::SelectRecipe), {2}, ++sequence);
    EXPECT_EQ(read("command_result"), std::int64_t(app::CommandResult::Done));
  });
  const auto appliance =
      app::daemon::Appliance::make(*site, {[] { return Result<>(); }, [] {}},
                                   [](const app::CalibrationEntry&) { return Result<>(); });
  ASSERT_TRUE(appliance) << appliance.error().message;
  ASSERT_TRUE((*appliance)->start({&watcher}));
  EXPECT_EQ(watcher.wait_for_set_after(hal::Clock::now()).recipe, 2);
}

TEST_F(Service, TheJournalHasCameraAndFault) {
  const std::string log = folder.path() / "daemon.log";
  std::ofstream(log) << "";
  struct stat file {};
  ASSERT_EQ(::stat(log.c_str(), &file), 0);
  const std::string config =
      write_config(small_machine("[[camera.fault]]\nfault = \"stalled\"\nfrom = 3\nuntil = 30\n"));
  ORBWATCH_WITHOUT_A_JOURNAL([&] {
    const JournalSocket journal;
    ::setenv("JOURNAL_STREAM", journal_stream_of(file).c_str(), 1);
    Subprocess daemon({ORBWATCHD_PROGRAM, "--config", config}, log);
    ::unsetenv("JOURNAL_STREAM");
    const auto stalled = [](const JournalSocket::Entry& entry) {
      return entry.contains("ORBWATCH_FAULT") && entry.at("ORBWATCH_FAULT") == "stalled";
    };
    auto entry = journal.await(stalled);
    EXPECT_EQ(entry["ORBWATCH_CAMERA"], "thermal");
    EXPECT_EQ(entry["PRIORITY"], "4");
    EXPECT_EQ(entry["SYSLOG_IDENTIFIER"], "orbwatchd");
    entry = journal.await(stalled);
    EXPECT_EQ(entry["PRIORITY"], "6") << "it is over";
    daemon.send(SIGTERM);
    journal.await([](const JournalSocket::Entry& last) {
      return last.at("MESSAGE") == "ended by signal 15";
    });
    EXPECT_EQ(daemon.wait(), 0);
    EXPECT_EQ(daemon.output(), "") << "everything goes to the journal";
  });
}

/// No user is at the machine who could repair a file damaged by a power cut or an editor.
TEST_F(Service, ADamagedCalibrationLeavesTheLastGoodOneRunning) {
  ::setenv("STATE_DIRECTORY", folder.path().c_str(), 1);
  const NotifySocket manager(folder / "notify", kWatchdog);
  const std::string config = write_config(small_machine());
  std::vector<app::CalibrationEntry> entries(1);
  entries[0].number = 1;
  entries[0].time = "2026-11-25T10:00:00Z";
  entries[0].method = "by hand";
  entries[0].quality = "good";
  entries[0].rig = app::files::rig_checksum(folder / "rig.toml").value();
  entries[0].alignment.cameras.push_back({.camera = "colour"});  // unchanged from the rig
  const fs::path file = app::files::calibration_file(folder / state_folder);
  fs::create_directories(file.parent_path());
  ASSERT_TRUE(app::files::save_calibrations(file, entries));
  const std::string good = contents(file);
  const std::string in_force = "camera colour: alignment 1 of 2026-11-25T10:00:00Z counts";
  {
    Subprocess daemon = start(config);
    manager.await("READY=1");
    EXPECT_TRUE(says(daemon, in_force)) << daemon.output();
    EXPECT_EQ(read("system_configuration_refused"), 0);
    // It is kept once the pipeline runs, perhaps after the service is ready.
    ASSERT_TRUE(eventually(daemon, [&] { return fs::exists(folder / "last-good.json"); }));
  }
  std::string without_key = good;
  without_key.erase(without_key.find("method = "), std::strlen("method = \"by hand\"\n"));
  for (const std::string& damaged : {without_key, good.substr(0, good.find("\"good\"") + 2)}) {
    std::ofstream(file) << damaged;
    Subprocess daemon = start(config);
    EXPECT_THAT(manager.await("READY=1"), HasSubstr("calibration.toml:"));
    EXPECT_TRUE(eventually(daemon, [&] { return read("system_frame_set") > 0; }));
    EXPECT_EQ(read("system_configuration_refused"), 1);
    EXPECT_TRUE(says(daemon, in_force)) << daemon.output();
    EXPECT_EQ(contents(file), damaged) << "nothing is lost";
  }
  std::ofstream(file) << good;
  Subprocess daemon = start(config);
  manager.await("READY=1");
  EXPECT_TRUE(eventually(daemon, [&] { return read("system_frame_set") > 0; }));
  EXPECT_EQ(read("system_configuration_refused"), 0) << "it is mended";
  ::unsetenv("STATE_DIRECTORY");
}

TEST_F(Service, AConfigurationThatNoRestartAcceptsStartsWithAWarning) {
  const std::string config = write_config(small_machine() + "[machine]\nsource = \"http\"\n");
  const std::string refusal =
      "machine.source is http, but [web] is not enabled; set enabled = true in [web], or another "
      "source";
  {
    Subprocess daemon = start(config);
    EXPECT_TRUE(says(daemon, refusal + "; correct it: no restart or alignment is accepted before"))
        << daemon.output();
    EXPECT_TRUE(eventually(daemon, [&] { return read("system_frame_set") > 0; }));
    daemon.send(SIGTERM);
    EXPECT_EQ(daemon.wait(), 0);
  }
  const auto site = app::files::resolve(config);
  ASSERT_TRUE(site) << site.error().message;
  app::CalibrationEntry entry;
  entry.method = "by hand";
  entry.quality = "good";
  entry.alignment.cameras.push_back({.camera = "colour"});
  const auto accepted = app::daemon::check_acceptance(config, *site, entry);
  ASSERT_FALSE(accepted);
  EXPECT_EQ(accepted.error().message, "a restart would be refused: " + refusal);
}

TEST_F(Service, AWrongConfigurationWithoutALastGoodOneIsRefused) {
  ::setenv("STATE_DIRECTORY", folder.path().c_str(), 1);
  Subprocess daemon = start((folder / "absent.toml").string());
  EXPECT_EQ(daemon.wait(), 1);
  EXPECT_THAT(daemon.output(), HasSubstr("no configuration ran here before"));
  ::unsetenv("STATE_DIRECTORY");
}

}  // namespace
}  // namespace orbwatch::tests

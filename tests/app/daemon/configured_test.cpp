// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "app/files/runtime/trial.h"
#include "app/state/state_folder.h"
#include "tests/app/daemon/daemon_program.h"
#include "tests/app/daemon/hung_thread.h"
#include "tests/support/notify_socket.h"
#include "tests/support/sanitizers.h"
#include "tests/support/service_user.h"

/// New configuration of a running `orbwatchd`, by `orbwatch configure`, and the effects of its
/// ends.
namespace orbwatch::tests {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

/// Configuration under trial by `orbwatch configure`.
class Configured : public Daemon {
 protected:
  Configured() : manager(folder / "notify", std::chrono::seconds(1)) {
    ::setenv("STATE_DIRECTORY", folder.path().c_str(), 1);
    config = write_config(small_machine());
    ::setenv("ORBWATCH_CONFIG", config.c_str(), 1);
    fs::create_directory(folder / "new");
    for (const char* name : {"site.toml", "rig.toml", "recipe.toml"}) {
      fs::copy_file(folder / name, folder / "new" / name);
    }
    std::string text = contents(folder / "new/site.toml");
    text.replace(text.find("name = \"room\""), 13, "name = \"hall\"");
    std::ofstream(folder / "new/site.toml") << text;
  }
  ~Configured() override {
    ::unsetenv("ORBWATCH_CONFIG");
    ::unsetenv("STATE_DIRECTORY");
  }

  Subprocess run() const { return Subprocess({ORBWATCHD_PROGRAM}, folder / "daemon.log"); }
  /// Exit code and output.
  std::pair<int, std::string> configure(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {ORBWATCH_PROGRAM, "configure"});
    Subprocess program(arguments, folder / "configure.log");
    const int code = program.wait();
    return {code, program.output()};
  }
  /// Starts a trial: the new configuration runs, and the files are unchanged.
  void begin_trial(const std::string& seconds) {
    manager.await("READY=1");
    old_checksum = read("system_configuration_checksum");
    const auto [code, said] =
        configure({(folder / "new/site.toml").string(), "--seconds", seconds});
    EXPECT_EQ(code, 0) << said;
    EXPECT_THAT(said, HasSubstr("-name = \"room\"\n+name = \"hall\"\n"));
    manager.await("READY=1");
    EXPECT_NE(read("system_configuration_checksum"), old_checksum);
    EXPECT_THAT(contents(config), HasSubstr("room"));
  }

  NotifySocket manager;
  std::string config;
  std::int64_t old_checksum = 0;
};

TEST_F(Configured, IsWrittenByItsConfirmation) {
  Subprocess daemon = run();
  begin_trial("3600");
  const auto [code, said] = configure({"--confirm"});
  EXPECT_EQ(code, 0) << said;
  EXPECT_THAT(contents(config), HasSubstr("hall"));
  EXPECT_EQ(configure({"--confirm"}).first, 1) << "nothing waits any more";
  const auto checksum = read("system_configuration_checksum");
  daemon.send(SIGHUP);
  manager.await("READY=1");
  EXPECT_EQ(read("system_configuration_checksum"), checksum) << daemon.output();
}

TEST_F(Configured, GoesBackWithoutConfirmation) {
  Subprocess daemon = run();
  begin_trial("10");
  manager.await("READY=1");
  EXPECT_EQ(read("system_configuration_checksum"), old_checksum);
  EXPECT_THAT(daemon.output(), HasSubstr("was not confirmed"));
  EXPECT_EQ(configure({"--confirm"}).first, 1);
}

TEST_F(Configured, GoesBackAlthoughADriverHangs) {
  Subprocess daemon = run();
  begin_trial("10");
  const HungThread hung(thread_of(daemon.pid(), "appliance"));
  ASSERT_TRUE(hung.is_hung());
  hung.await_end();
  manager.await("READY=1");
  EXPECT_EQ(read("system_configuration_checksum"), old_checksum);
  EXPECT_THAT(daemon.output(), HasSubstr("was not confirmed"));
}

/// Full pipe without a reader: the log and the console go to it.
class Unread {
 public:
  explicit Unread(const fs::path& path) {
    EXPECT_EQ(::mkfifo(path.c_str(), 0600), 0);
    file_ = ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  }
  Unread(const Unread&) = delete;
  Unread& operator=(const Unread&) = delete;
  ~Unread() { ::close(file_); }

  void fill() const {
    const std::string many(4096, '.');
    while (::write(file_, many.data(), many.size()) > 0) {
    }
    while (::write(file_, ".", 1) > 0) {
    }
  }

 private:
  int file_ = -1;
};

TEST_F(Configured, GoesBackAndEndsAlthoughNobodyReadsTheLog) {
  if (tests::kHasThreadSanitizer)
    GTEST_SKIP() << "the sanitizer's reports wait for the same reader";
  for (const char* file : {"site.toml", "new/site.toml"}) {
    const std::string text = contents(folder / file);
    const std::string console = "[console]\nenabled = true\nperiod = 0.1\n";
    std::ofstream(folder / file) << std::string(text).insert(text.find("[modbus]"), console);
  }
  const Unread output(folder / "daemon.log");
  Subprocess daemon = run();
  manager.await("READY=1");
  output.fill();
  old_checksum = read("system_configuration_checksum");
  EXPECT_EQ(configure({(folder / "new/site.toml").string(), "--seconds", "10"}).first, 0);
  manager.await("READY=1");
  EXPECT_NE(read("system_configuration_checksum"), old_checksum);
  manager.await("READY=1");
  EXPECT_EQ(read("system_configuration_checksum"), old_checksum);
  daemon.send(SIGTERM);
  manager.await("STOPPING=1");
  EXPECT_EQ(daemon.wait(), 0);
}

TEST_F(Configured, KeepsAChangeThatSomebodyMadeMeanwhile) {
  Subprocess daemon = run();
  begin_trial("3600");
  std::ofstream(config, std::ios::app) << "# by hand\n";
  const auto [code, said] = configure({"--confirm"});
  EXPECT_EQ(code, 1);
  EXPECT_THAT(said, HasSubstr("site.toml was changed by "));
  EXPECT_THAT(contents(config), HasSubstr("# by hand"));
}

TEST_F(Configured, GoesBackAfterAPowerCut) {
  {
    Subprocess daemon = run();
    begin_trial("3600");
    daemon.send(SIGKILL);
  }
  Subprocess daemon = run();
  manager.await("READY=1");
  EXPECT_EQ(read("system_configuration_checksum"), old_checksum);
  EXPECT_THAT(daemon.output(), HasSubstr("was not confirmed"));
}

TEST_F(Configured, GoesBackWhenCancelled) {
  Subprocess daemon = run();
  begin_trial("3600");
  EXPECT_EQ(configure({"--cancel"}).first, 0);
  manager.await("READY=1");
  EXPECT_EQ(read("system_configuration_checksum"), old_checksum) << daemon.output();
}

/// The daemon checks for a request once a second, and at each signal.
TEST_F(Configured, EndsWhereATrialWasRequestedJustBefore) {
  Subprocess daemon = run();
  manager.await("READY=1");
  ASSERT_TRUE(
      app::files::request_trial(folder.path(), {.site = config, .texts = {}, .seconds = 3600}));
  daemon.send(SIGTERM);
  manager.await("STOPPING=1");
  EXPECT_EQ(daemon.wait(), 0) << daemon.output();
}

/// Another machine on the same board has the other configuration.
TEST_F(Configured, RefusesARequestForAnotherConfigurationWithoutARestart) {
  Subprocess daemon = run();
  manager.await("READY=1");
  for (const char* other : {"/etc/orbwatch/second/site.toml", ""}) {
    ASSERT_TRUE(
        app::files::request_trial(folder.path(), {.site = other, .texts = {}, .seconds = 3600}));
    ASSERT_TRUE(eventually(daemon, [&] { return !app::files::is_trial_requested(folder.path()); }));
  }
  std::ofstream(folder / "trial.json") << "{";
  ASSERT_TRUE(says(daemon, "trial.json: is damaged")) << daemon.output();
  EXPECT_FALSE(app::files::is_trial_requested(folder.path()));
  EXPECT_THAT(daemon.output(), HasSubstr("it is for /etc/orbwatch/second/site.toml"));
  EXPECT_THAT(daemon.output(), testing::Not(HasSubstr("restarts")));
}

TEST_F(Configured, RecordsWhoseStateFolderItIs) {
  ASSERT_TRUE(app::record_owner(folder.path(), "/etc/orbwatch/before.toml"));
  Subprocess daemon = run();
  manager.await("READY=1");
  EXPECT_EQ(app::owner_of(folder.path()), config);
  EXPECT_THAT(daemon.output(), HasSubstr("was the state folder of /etc/orbwatch/before.toml"));
  const auto [code, said] =
      configure({"--cancel", "--config", (folder / "new/site.toml").string()});
  EXPECT_EQ(code, 1);
  EXPECT_THAT(said,
              HasSubstr("is the state folder of " + fs::path(config).lexically_normal().string()));
}

TEST_F(Configured, IsLeftAloneByASecondOrbwatchdInTheSameFolder) {
  Subprocess daemon = run();
  manager.await("READY=1");
  const std::string other = folder / "other.toml";
  fs::copy_file(config, other);
  Subprocess second({ORBWATCHD_PROGRAM, "--config", other}, folder / "second.log");
  EXPECT_NE(second.wait(), 0);
  EXPECT_THAT(second.output(), HasSubstr("another orbwatchd runs with this STATE_DIRECTORY"));
  EXPECT_TRUE(fs::equivalent(app::owner_of(folder.path()).value(), config));
  EXPECT_TRUE(daemon.runs());
}

TEST_F(Configured, RemovesWhatAPowerCutLeftHalfWritten) {
  fs::create_directory(folder / state_folder);
  std::vector<fs::path> left;
  for (const fs::path& folder_written : {folder.path(), folder / state_folder}) {
    left.push_back(folder_written / "calibration.toml.7-12.part");
    std::ofstream(left.back()) << "half";
  }
  const fs::path other = folder / "notes.part";
  std::ofstream(other) << "a user's";
  Subprocess daemon = run();
  manager.await("READY=1");
  for (const fs::path& file : left) EXPECT_FALSE(fs::exists(file)) << file;
  EXPECT_TRUE(fs::exists(other));
}

/// No computer has these lines: the message shows the attempted ones.
class Outputs : public Configured {
 protected:
  Outputs() {
    std::ofstream(config, std::ios::app) << line("of_file");
    std::ofstream(folder / "new/site.toml", std::ios::app) << line("of_trial");
  }
  static std::string line(const std::string& name) {
    return "[[line]]\nname = \"" + name +
           "\"\nuse = \"process_ok\"\nline_name = \"NO_SUCH_LINE\"\n";
  }
  std::string made_safe() const {
    Subprocess program({ORBWATCH_PROGRAM, "lines", "--safe"}, folder.path() / "lines.log");
    program.wait();
    return program.output();
  }
};

TEST_F(Outputs, AreMadeSafeAsTheyRanInATrial) {
  {
    Subprocess daemon = run();
    begin_trial("3600");
    daemon.send(SIGKILL);
  }
  EXPECT_THAT(made_safe(), HasSubstr("of_trial"));
}

TEST_F(Outputs, AreMadeSafeAsTheyRanAfterTheFileWasEdited) {
  const fs::path runtime = folder / "run";
  fs::create_directory(runtime);
  ::setenv("RUNTIME_DIRECTORY", runtime.c_str(), 1);
  {
    Subprocess daemon = run();
    manager.await("READY=1");
    fs::copy_file(folder / "new/site.toml", config, fs::copy_options::overwrite_existing);
    daemon.send(SIGKILL);
  }
  EXPECT_THAT(made_safe(), HasSubstr("of_file"));
  fs::remove_all(runtime / "driven-lines.toml");
  EXPECT_THAT(made_safe(), HasSubstr("of_trial")) << "without a record, as the file says";
  ::unsetenv("RUNTIME_DIRECTORY");
}

/// The folder was prepared by another user.
TEST_F(Configured, ReplacesNoPrivateFile) {
  const std::string lens = "[camera.intrinsics]\nfile = \"key.pem\"\n";
  const std::string key = "of the page\n";
  std::ofstream(folder / "key.pem") << key;
  fs::permissions(folder / "key.pem", fs::perms(0600));
  std::string rig = contents(folder / "new/rig.toml");
  const std::size_t begin = rig.find("[camera.intrinsics]"), end = rig.find("[camera.pose]");
  rig.replace(begin, end - begin, lens);
  std::ofstream(folder / "new/rig.toml") << rig;
  std::ofstream(folder / "new/key.pem")
      << "image_width: 200\nimage_height: 200\ncamera_name: a\ncamera_matrix: {rows: 3, cols: 3, "
         "data: [1143, 0, "
         "99.5, 0, 1143, 99.5, 0, 0, 1]}\ndistortion_model: plumb_bob\n"
         "distortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}\n";
  const auto [code, said] = configure({(folder / "new/site.toml").string(), "--dry-run"});
  EXPECT_EQ(code, 1);
  EXPECT_THAT(said, HasSubstr("key.pem: exists, and the configuration does not name it"));
  EXPECT_THAT(said, testing::Not(HasSubstr(key))) << "nor is it shown";
}

/// Root's umask on a hardened board is 077.
TEST_F(Configured, IsReadByTheServiceWhateverRootsUmask) {
  ORBWATCH_WITHOUT_ROOT_SKIPPED();
  const fs::path program = folder / "orbwatchd";
  fs::copy_file(ORBWATCHD_PROGRAM, program);
  std::ofstream(folder / "new/lamp.toml") << kSmallRecipe;  // a new file
  std::string site = contents(folder / "new/site.toml");
  site.replace(site.rfind("recipe.toml"), 11, "lamp.toml");
  std::ofstream(folder / "new/site.toml") << site;
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    give_to_service(entry.path());
  }
  give_to_service(folder.path());
  fs::permissions(folder.path(), fs::perms(0750));
  Subprocess daemon({"/usr/bin/setpriv", "--reuid=" + std::to_string(kService),
                     "--regid=" + std::to_string(kService), "--clear-groups", program.string()},
                    folder / "daemon.log");
  const mode_t before = ::umask(0077);
  begin_trial("3600");
  const auto [code, said] = configure({"--confirm"});
  ::umask(before);
  EXPECT_EQ(code, 0) << said;
  EXPECT_TRUE(as_service(
      0, [&] { return !contents(folder / "lamp.toml").empty() && !contents(config).empty(); }));
  daemon.send(SIGHUP);
  manager.await("READY=1");
  EXPECT_EQ(read("system_configuration_refused"), 0) << daemon.output();
}

TEST_F(Configured, RefusesWhatIsWrongAndChangesNothing) {
  std::ofstream(folder / "new/recipe.toml") << "nonsense = ";
  const auto [code, said] = configure({(folder / "new/site.toml").string()});
  EXPECT_EQ(code, 1);
  EXPECT_THAT(said, HasSubstr("new/recipe.toml:1"));
  EXPECT_FALSE(fs::exists(folder / "trial.json"));
  fs::copy_file(folder / "recipe.toml", folder / "new/recipe.toml",
                fs::copy_options::overwrite_existing);
  EXPECT_EQ(configure({(folder / "new/site.toml").string(), "--dry-run"}).first, 0);
  EXPECT_FALSE(fs::exists(folder / "trial.json"));
  EXPECT_EQ(configure({}).first, 2);
}

}  // namespace
}  // namespace orbwatch::tests

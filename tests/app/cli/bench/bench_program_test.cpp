// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/app/cli/documented_json.h"
#include "tests/app/daemon/daemon_program.h"

/// Runs `orbwatch bench` like a user.
namespace orbwatch::tests {
namespace {

class BenchProgram : public Daemon {
 protected:
  std::pair<int, std::string> bench(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {ORBWATCH_PROGRAM, "bench"});
    Subprocess program(arguments, folder.path() / "said");
    const int code = program.wait();
    return {code, program.output()};
  }
  void expect_refused(const std::vector<std::string>& arguments, const std::string& said,
                      int status = 1) {
    const auto [code, output] = bench(arguments);
    EXPECT_EQ(code, status) << output;
    EXPECT_NE(output.find(said), std::string::npos) << output;
  }
};

nlohmann::json figures_in(const std::string& output) {
  const auto begin = output.find("{\"fits\"");
  if (begin == std::string::npos) return {};
  return nlohmann::json::parse(output.substr(begin, output.find('\n', begin) - begin), nullptr,
                               false);
}

TEST_F(BenchProgram, RunsTheConfigurationWithItsCamerasAndWithTestPatterns) {
  const std::string config = write_config(small_machine());
  for (const bool simulated : {false, true}) {
    std::vector<std::string> arguments{"--config", config, "--seconds", "1", "--json"};
    if (simulated) arguments.emplace_back("--simulated");
    const auto [code, output] = bench(arguments);
    const auto figures = figures_in(output);
    ASSERT_TRUE(figures.is_object()) << output;
    EXPECT_EQ(code, figures["fits"].get<bool>() ? 0 : 1) << output;
    EXPECT_GT(figures["frame_sets"].get<int>(), 0);
    EXPECT_EQ(figures["wanted_rate"], 20);
    EXPECT_EQ(figures["stages"][0]["p99_ms"], 0) << "what drawing pictures costs is left out";
    EXPECT_GT(figures["stages"][2]["p50_ms"].get<double>(), 0);
    EXPECT_GT(figures["stages"][3]["p50_ms"].get<double>(), 0);
    ASSERT_EQ(figures["views"].size(), 2U);
    EXPECT_EQ(figures["views"][1]["name"], "process");
    EXPECT_GT(figures["views"][1]["published"].get<int>(), 0);
    EXPECT_GT(figures["memory_mib"]["resident"].get<double>(), 1);
    const std::string format = figures["cameras"][0]["format"];
    EXPECT_EQ(format.find("rgb 200x200 at 20"), 0U) << format;
    expect_documented(figures, bench({"--help"}).second);
  }
}

/// Files of a folder and its folders, with their sizes.
std::map<std::string, std::uintmax_t> listing(const std::filesystem::path& folder) {
  std::map<std::string, std::uintmax_t> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    files[entry.path().string()] = entry.is_regular_file() ? entry.file_size() : 0;
  }
  return files;
}

TEST_F(BenchProgram, LeavesTheRecordingsOfTheMachineAlone) {
  const auto recordings = folder.path() / "recordings", snapshots = folder.path() / "snapshots";
  std::filesystem::create_directory(recordings);
  std::filesystem::create_directory(snapshots);
  // Alone it exceeds the limit: a recording beside it may delete it.
  const auto old = recordings / "log-20200101T000000Z.mcap";
  std::ofstream(old) << "not finished";
  std::filesystem::resize_file(old, std::uintmax_t{300} << 20);
  const auto before = listing(recordings);
  const std::string config =
      write_config(small_machine() + "[recorder]\nfolder = \"recordings\"\nlimit_mib = 256\n" +
                   "[snapshot]\nfolder = \"snapshots\"\n");
  const std::string output = bench({"--config", config, "--seconds", "1", "--json"}).second;
  ASSERT_TRUE(figures_in(output).is_object()) << output;
  EXPECT_EQ(listing(recordings), before);
  EXPECT_TRUE(listing(snapshots).empty());
}

/// Number of a run's temporary folders in a folder.
std::size_t runs_in(const std::filesystem::path& folder) {
  std::size_t runs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    runs += entry.path().filename().string().starts_with("orbwatch-bench-") ? 1 : 0;
  }
  return runs;
}

TEST_F(BenchProgram, RecordsOnTheDiskOfTheRecordings) {
  const auto temporary = folder.path() / "tmp";
  std::filesystem::create_directory(temporary);
  const std::string config =
      write_config(small_machine() + "[recorder]\nfolder = \"recordings\"\n");
  Subprocess program({"/usr/bin/env", "TMPDIR=" + temporary.string(), ORBWATCH_PROGRAM, "bench",
                      "--config", config, "--seconds", "1"},
                     folder.path() / "said");
  EXPECT_TRUE(eventually(program, [&] { return runs_in(folder.path()) == 1; })) << program.output();
  EXPECT_EQ(runs_in(temporary), 0U);
  program.wait();
  EXPECT_EQ(runs_in(folder.path()), 0U);
}

TEST_F(BenchProgram, SaysWhatIsWrong) {
  const std::string config = write_config(small_machine());
  expect_refused({}, "/etc/orbwatch/site.toml");
  expect_refused({"--config", (folder.path() / "none.toml").string()}, "none.toml");
  expect_refused({"--config", config, "--seconds", "0"}, "it must be from 1 to 3600", 2);
  expect_refused({"--config", config, "--seconds", "3601"}, "it must be from 1 to 3600", 2);
}

TEST_F(BenchProgram, SaysWhichCameraIsNotThere) {
  std::string machine = small_machine();
  machine += "[simulation]\nconnected = \"" + (folder.path() / "connected").string() + "\"\n";
  std::filesystem::create_directories(folder.path() / "connected");
  const std::string config = write_config(machine);
  expect_refused({"--config", config, "--seconds", "1"},
                 "no frame: camera colour: camera is not connected");
  std::ofstream(folder.path() / "connected/thermal") << "";
  expect_refused({"--config", config, "--seconds", "1"},
                 "or cannot be opened; the figures would be those of the others only");
}

}  // namespace
}  // namespace orbwatch::tests

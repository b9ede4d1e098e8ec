// SPDX-License-Identifier: Apache-2.0
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <utility>
#include <vector>

#include "tests/app/daemon/daemon_program.h"
#include "tests/support/reference_data.h"
#include "tests/support/sanitizers.h"

/// `orbwatchd` as installed: the program, a file, and independent clients on the network.
namespace orbwatch::tests {
namespace {

TEST_F(Daemon, ReportsOverModbusAndDdsAndEndsCleanly) {
  Subprocess daemon = start(write_config(small_machine()));
  ASSERT_TRUE(eventually(daemon, [&] { return read("system_frame_set") > 5; })) << daemon.output();
  const auto heartbeat = read("system_heartbeat");
  EXPECT_TRUE(eventually(daemon, [&] { return read("system_heartbeat") != heartbeat; }));
  // On a busy machine a camera that is late degrades the state for a moment.
  EXPECT_TRUE(eventually(daemon, [&] { return read("system_state") == 1; })) << "running";
  // Truth of the pool: 2000 degC in the centre, on a circle of 40 mm around (-110, -50, 178), seen
  // from the ball at (120, 60, 430). Occasionally a spark is larger.
  const auto is_near = [&](const char* name, double truth, double tolerance) {
    return std::abs(static_cast<double>(read(name)) / 100 - truth) <= tolerance;
  };
  ASSERT_TRUE(eventually(daemon,
                         [&] {
                           return read("region_0_hot_spot_peak_temperature") > 17000 &&
                                  is_near("region_0_hot_spot_yaw", -115.6, 10) &&
                                  is_near("region_0_hot_spot_pitch", -45, 6);
                         }))
      << read("region_0_hot_spot_yaw") << ", " << read("region_0_hot_spot_pitch");

  Subprocess reader({ORBWATCH_PROGRAM, "subscribe", "--domain", std::to_string(domain), "--topic",
                     "orbwatch/process/image_raw", "--topic", "orbwatch/room/image_raw", "--topic",
                     "orbwatch/process_state", "--save", folder.path().string(), "--count", "1",
                     "--seconds", "60"},
                    folder.path() / "reader.log");
  EXPECT_EQ(reader.wait(), 0) << reader.output();
  EXPECT_EQ(cv::imread((folder.path() / "process.png").string()).size(), cv::Size(160, 120));
  EXPECT_EQ(cv::imread((folder.path() / "room.png").string()).size(), cv::Size(200, 100));

  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(), 0) << daemon.output();
}

/// Configuration whose first camera is triggered over a wire, by a line that has `pace` among its
/// keys.
std::string triggered_machine(const std::string& mode, const std::string& pace = "") {
  std::string text = small_machine();
  text.insert(text.find("frame_rate"),
              "trigger_mode = \"" + mode + "\"\ntrigger_source = \"start\"\n");
  return text + R"(
[[line]]
name = "start"
use = "trigger_in"
back_end = "simulated"
line_name = "WIRE"
[[line]]
name = "pulse"
use = "trigger_out"
back_end = "simulated"
line_name = "WIRE"
)" + pace +
         "\n";
}

/// Names of a program's threads, as `ps -L` shows them.
std::vector<std::string> thread_names(const Subprocess& program) {
  std::vector<std::string> names;
  const auto tasks = std::filesystem::path("/proc") / std::to_string(program.pid()) / "task";
  for (const auto& task : std::filesystem::directory_iterator(tasks)) {
    std::ifstream comm(task.path() / "comm");
    std::getline(comm, names.emplace_back());
  }
  return names;
}

TEST_F(Daemon, NamesItsThreads) {
  Subprocess daemon = start(write_config(triggered_machine("line", "rate = 10")));
  for (const char* name : {"cam colour", "cam thermal", "pipeline", "lines", "modbus",
                           "modbus commands", "background", "watch", "alignment", "dds", "log"}) {
    // Interfaces start one after the other.
    EXPECT_TRUE(eventually(daemon, [&] {
      return std::ranges::count(thread_names(daemon), name) == 1;
    })) << name;
  }
}

/// True for threads that a library makes: Cyclone DDS.
bool is_of_a_library(const std::string& name) {
  return name.starts_with("recv") || name.starts_with("dq.") ||
         std::ranges::count(std::array{"tev", "gc", "lease"}, name) > 0;
}

TEST_F(Daemon, HasAThreadForEachCameraAndWorkerTwoPerInterfaceAndElevenMore) {
  constexpr std::ptrdiff_t kCameras = 2, kWorkers = 1, kInterfaces = 2;  // Modbus and DDS
  constexpr std::ptrdiff_t kOfSanitizer = tests::kHasThreadSanitizer ? 1 : 0;
  std::string site = "[pipeline]\nworkers = 1\n" + small_machine();
  for (const char* view : {"second", "third"}) {
    site += "[[view]]\nname = \"" + std::string(view) +
            "\"\nwidth = 64\nheight = 48\n[[view.source]]\ncamera = \"colour\"\n";
  }
  Subprocess daemon = start(write_config(site));
  ASSERT_TRUE(eventually(daemon, [&] { return read("system_frame_set") > 0; })) << daemon.output();
  EXPECT_EQ(read("view_count"), 4);
  // A library's thread has the program's name until it sets its own.
  std::string own;
  EXPECT_TRUE(eventually(daemon, [&] {
    own.clear();
    std::ptrdiff_t count = 0;
    const auto names = thread_names(daemon);
    if (std::ranges::count(names, "dds") == 0) return false;  // the thread that starts last
    for (const std::string& name : names) {
      if (is_of_a_library(name)) continue;
      own += name + ", ";
      ++count;
    }
    return count <= kCameras + kWorkers + 2 * kInterfaces + 11 + kOfSanitizer;
  })) << own;
}

TEST_F(Daemon, TriggersFasterThanTheCameraAreFramesOrMissed) {
  Subprocess daemon = start(write_config(triggered_machine("line", "rate = 100")));
  ASSERT_TRUE(eventually(daemon, [&] {
    return read("camera_0_missed") > 50 && read("camera_0_frames") > 5;
  })) << daemon.output();
  const auto before = read("camera_0_triggers");
  const auto answered = read("camera_0_frames") + read("camera_0_missed");
  EXPECT_GE(answered, before - 33) << "32 may wait for their frame, which may be on its way";
  EXPECT_LE(answered, read("camera_0_triggers"));
}

TEST_F(Daemon, ExposesOncePerPulseThatIsCommanded) {
  Subprocess daemon = start(write_config(triggered_machine("software")));
  ASSERT_TRUE(eventually(daemon, [&] { return read("camera_1_frames") > 0; })) << daemon.output();
  constexpr std::uint16_t kPulses = 5;
  for (std::uint16_t n = 1; n <= kPulses; ++n) {
    write_command(port, 2, {0}, n);
    ASSERT_TRUE(eventually(daemon, [&] { return read("camera_0_frames") == n; }))
        << daemon.output();
  }
  EXPECT_EQ(read("camera_0_triggers"), kPulses);
  EXPECT_EQ(read("camera_0_missed"), 0);
  write_command(port, 2, {1}, 9);
  EXPECT_TRUE(eventually(daemon, [&] { return read("acknowledged_sequence") == 9; }));
  EXPECT_EQ(read("command_result"), 2) << "there is no second trigger_out";
}

TEST_F(Daemon, CarriesOutTheSelectViewCommandOnce) {
  Subprocess daemon = start(write_config(small_machine()));
  ASSERT_TRUE(eventually(daemon, [&] { return read("system_frame_set") > 0; })) << daemon.output();
  EXPECT_EQ(read("system_selected_view"), 0);
  write_command(port, 1, {1}, 7);
  EXPECT_TRUE(eventually(daemon, [&] {
    return read("acknowledged_sequence") == 7 && read("system_selected_view") == 1;
  }));
  write_command(port, 1, {9}, 8);
  EXPECT_TRUE(eventually(daemon, [&] { return read("acknowledged_sequence") == 8; }));
  EXPECT_EQ(read("system_selected_view"), 1) << "there is no view 9";
  daemon.send(SIGINT);
  EXPECT_EQ(daemon.wait(), 0) << daemon.output();
}

TEST_F(Daemon, CarriesOutCommandsFromTheCommandLineAndShowsTheirEffect) {
  Subprocess daemon = start(write_config(small_machine()));
  const auto orbwatch = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin() + 1,
                     {"--domain", std::to_string(domain), "--timeout", "60"});
    arguments.insert(arguments.begin(), ORBWATCH_PROGRAM);
    Subprocess program(arguments, folder.path() / "said");
    const int code = program.wait();
    return std::pair(code, program.output());
  };
  const auto selected_view = [&] {
    const auto state = orbwatch({"state", "--json"}).second;
    const std::string key = "\"selected_view\":";
    const std::size_t at = state.find(key);
    return at == std::string::npos ? state : state.substr(at + key.size(), 1);
  };
  EXPECT_EQ(selected_view(), "0");
  EXPECT_EQ(orbwatch({"command", "select_view", "1"}), (std::pair{0, std::string()}));
  EXPECT_TRUE(eventually(daemon, [&] { return selected_view() == "1"; }));
  const auto [code, said] = orbwatch({"command", "select_view", "99"});
  EXPECT_EQ(code, 1) << "there is no such view";
  EXPECT_NE(said.find("select_view: argument out of range"), std::string::npos) << said;
  EXPECT_EQ(selected_view(), "1");
}

TEST_F(Daemon, LivesThroughAnUnpluggedCamera) {
  const std::string faults = "[[camera.fault]]\nfault = \"unplugged\"\nfrom = 20\nuntil = 60\n";
  Subprocess daemon = start(write_config(small_machine(faults)));
  // On a busy machine a camera that is late is a fault and degrades the state, too.
  const auto is_said = [&daemon] {
    return daemon.output().find("thermal: camera is not connected") != std::string::npos;
  };
  EXPECT_TRUE(eventually(daemon, is_said)) << daemon.output();
  EXPECT_TRUE(eventually(daemon, [&] { return read("system_state") == 2; })) << daemon.output();
  EXPECT_TRUE(eventually(daemon, [&] { return read("camera_1_fault") == 0; })) << daemon.output();
  EXPECT_TRUE(eventually(daemon, [&] { return read("system_state") == 1; })) << daemon.output();
  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(), 0);
}

TEST_F(Daemon, ReplaysARecordingAndMergesItsCameras) {
  const auto renders = reference_data() / "renders";
  ORBWATCH_REQUIRE_FILE(renders / "seq_spark");
  ORBWATCH_REQUIRE_FILE(renders / "seq_thermal");
  // Rig from the recording's scene.json, except the pixels, whose centres are at +0.5 there.
  const std::string rig = kMachine + R"(
[[camera]]
name = "colour"
width = 800
height = 800
[camera.intrinsics]
fx = 4209.30778157
fy = 4209.30778157
cx = 399.5
cy = 399.5
[camera.pose]
position = [208.57220963, -530.48139757, 489.04813976]
rotation = [0.98827626090, 0.15267623303, 0, 0.01542297893, -0.09983324611, -0.99488464391,
            -0.15189523973, 0.98322087592, -0.10101754951]
[[camera]]
name = "thermal"
width = 320
height = 256
[camera.intrinsics]
fx = 798.12901213
fy = 798.12901213
cx = 159.5
cy = 127.5
[camera.pose]
position = [49.37934188, 395.44812608, 500.62065812]
rotation = [-0.97667749773, -0.21471158661, 0, -0.04221976643, 0.19204876871, -0.98047680328,
            0.21051973006, -0.95760963081, -0.19663478390]
)";
  const std::string config = R"(
[[camera]]
name = "colour"
back_end = "replay"
frame_rate = 15
[camera.replay]
source = ")" + (renders / "seq_spark").string() +
                             R"("
[[camera]]
name = "thermal"
back_end = "replay"
frame_rate = 15
kelvin_per_count = 0.04
[camera.replay]
source = ")" + (renders / "seq_thermal").string() +
                             R"("
)";
  const std::string recipe = R"(
name = "merged"
[[view]]
name = "merged"
measured = "thermal"
yaw = -115
pitch = -40
h_fov = 100
width = 400
height = 300
[[view.source]]
camera = "colour"
[[view.source]]
camera = "thermal"
colour_map = "hot"
range = [20, 400]
[[region]]
name = "pool"
view = "merged"
hot_spot_threshold = 500
)";
  Subprocess daemon = start(write_config(config, rig, recipe));
  ASSERT_TRUE(eventually(daemon, [&] {
    return read("system_frame_set") > 24 && read("region_0_hot_spot_present") > 0;
  })) << daemon.output();
  // Melt pool of scene.json, seen from the ball's centre: yaw -122.9 to -113.7, pitch -48.2 to
  // -40.4. In a few of the frames a spark is larger than it.
  std::int64_t last_set = 0;
  std::vector<double> yaw, pitch;
  ASSERT_TRUE(eventually(daemon, [&] {
    const std::int64_t set = read("system_frame_set");
    if (std::exchange(last_set, set) != set) {
      yaw.push_back(static_cast<double>(read("region_0_hot_spot_yaw")) / 100);
      pitch.push_back(static_cast<double>(read("region_0_hot_spot_pitch")) / 100);
    }
    return yaw.size() >= 25;
  })) << daemon.output();
  const auto median = [](std::vector<double>& values) {
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
  };
  EXPECT_NEAR(median(yaw), -118.3, 5.5);
  EXPECT_NEAR(median(pitch), -44.3, 4.8);
  const auto pixels_that_are_seen = [&] {
    Subprocess reader({ORBWATCH_PROGRAM, "subscribe", "--domain", std::to_string(domain), "--topic",
                       "orbwatch/merged/image_raw", "--save", folder.path().string(), "--count",
                       "1", "--seconds", "60"},
                      folder.path() / "reader.log");
    EXPECT_EQ(reader.wait(), 0) << reader.output();
    const cv::Mat merged = cv::imread((folder.path() / "merged.png").string());
    EXPECT_EQ(merged.size(), cv::Size(400, 300));
    cv::Mat green;
    cv::extractChannel(merged, green, 1);
    return cv::countNonZero(green);
  };
  // A frame set without the frame of a camera that was late shows the other camera alone.
  EXPECT_TRUE(eventually(daemon, [&] { return pixels_that_are_seen() > 400 * 300 * 9 / 10; }))
      << "both cameras see most of this view\n"
      << daemon.output();
  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(), 0) << daemon.output();
}

TEST_F(Daemon, APortInUseIsAFaultUntilItIsFree) {
  const int s = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  ASSERT_EQ(bind(s, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  ASSERT_EQ(listen(s, 1), 0);
  Subprocess daemon = start(write_config(small_machine()));
  const auto says = [&](const std::string& text) {
    return daemon.output().find(text) != std::string::npos;
  };
  EXPECT_TRUE(eventually(daemon, [&] { return says("runs with 2 cameras"); })) << daemon.output();
  EXPECT_TRUE(says(std::to_string(port))) << daemon.output();
  close(s);
  EXPECT_TRUE(eventually(daemon, [&] { return read("system_frame_set") > 0; })) << daemon.output();
}

TEST_F(Daemon, RefusesBadFilesAndArgumentsInOneLine) {
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& part) {
    std::vector<std::string> all{ORBWATCHD_PROGRAM};
    all.insert(all.end(), arguments.begin(), arguments.end());
    Subprocess program(all, folder.path() / "said");
    EXPECT_GT(program.wait(), 0);
    const std::string said = program.output();
    EXPECT_NE(said.find(part), std::string::npos) << said;
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  };
  refused({"--config", "/no/such.toml"}, "/no/such.toml");
  setenv("ORBWATCH_CONFIG", "/no/named.toml", 1);
  refused({}, "/no/named.toml");
  unsetenv("ORBWATCH_CONFIG");
  refused({"--config", write_config("[cameras]\n")}, "site.toml:9: cameras");
}

TEST_F(Daemon, ACameraThatCannotBeUsedIsAFaultWithItsReason) {
  std::string text = small_machine();
  const std::size_t begin = text.find("[camera.simulated]"), end = text.find("[[camera]]", begin);
  text.replace(begin, end - begin, "[camera.replay]\nsource = \"pictures\"\n");
  const std::string size = "width = 200\nheight = 200\n";
  text.erase(text.find(size), size.size());
  text.replace(text.find("\"simulated\""), 11, "\"replay\"");
  Subprocess daemon = start(write_config(text));
  const auto says = [&](const std::string& what) {
    return eventually(daemon, [&] { return daemon.output().find(what) != std::string::npos; });
  };
  EXPECT_TRUE(says("camera colour: ")) << daemon.output();
  EXPECT_TRUE(eventually(daemon, [&] { return read("camera_0_fault") == 1; })) << "not there";
  const auto pictures = folder / "pictures", staged = folder / "staged";
  std::filesystem::create_directory(staged);
  cv::imwrite((staged / "000.png").string(), cv::Mat(48, 64, CV_8UC3, cv::Scalar(9)));
  std::filesystem::rename(staged, pictures);
  EXPECT_TRUE(says("camera colour: delivers 64x48, but the rig is for 200x200 pictures"))
      << daemon.output();
  EXPECT_TRUE(eventually(daemon, [&] { return read("camera_0_fault") == 5; })) << "another format";
  EXPECT_EQ(read("system_state"), 2) << "the other camera is measured";
}

TEST_F(Daemon, ChecksAFileWithoutRunning) {
  const std::string recipe =
      kSmallRecipe +
      "hot_spot_min_area = 6\nhot_spot_max_speed = 200\n";  // so that no default is assumed
  Subprocess program(
      {ORBWATCHD_PROGRAM, "--check", "--config", write_config(small_machine(), kSmallRig, recipe)},
      folder.path() / "said");
  EXPECT_EQ(program.wait(), 0) << program.output();
  EXPECT_EQ(program.output(),
            "orbwatch: takes commands over Modbus from this host only; over DDS from every "
            "participant of domain " +
                std::to_string(domain) + "\n");
}

TEST_F(Daemon, ChecksTheRigToo) {
  const std::string rig = "[ball]\ncentre = [120, 60, 790]\nradius = 50\n" +
                          kSmallRig.substr(kSmallRig.find("[scene]"));
  Subprocess program({ORBWATCHD_PROGRAM, "--check", "--config", write_config(small_machine(), rig)},
                     folder.path() / "said");
  EXPECT_EQ(program.wait(), 1);
  const std::string said = program.output();
  EXPECT_NE(said.find("rig.toml:4: scene: "), std::string::npos) << said;
  EXPECT_NE(said.find("cuts the ball"), std::string::npos) << said;
}

}  // namespace
}  // namespace orbwatch::tests

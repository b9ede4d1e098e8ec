#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <thread>
#include <utility>
#include <vector>

#include "tests/support/reference_data.h"
#include "tests/support/registers.h"
#include "tests/support/subprocess.h"
#include "tests/support/temporary_folder.h"

/// `orbwatchd` as it is installed: the program, a file, and clients of its own kind on the network.
namespace orbwatch::tests {
namespace {

/// A port that nobody uses at this moment.
int free_port() {
  const int s = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  EXPECT_EQ(bind(s, reinterpret_cast<sockaddr*>(&address), size), 0);
  EXPECT_EQ(getsockname(s, reinterpret_cast<sockaddr*>(&address), &size), 0);
  close(s);
  return ntohs(address.sin_port);
}

const std::string kMachine = R"(
[ball]
centre = [120, 60, 430]
radius = 50
[scene]
room = "box"
low = [-600, -500, 0]
high = [600, 500, 800]
[[scene.obstacle]]
name = "table"
low = [-250, -200, 100]
high = [250, 200, 140]
[[scene.obstacle]]
name = "workpiece"
low = [-190, -130, 140]
high = [-30, 30, 178]
)";

// One camera is calibrated, of the other one knows the limb and the registration.
const std::string kSmallRig = kMachine + R"(
[[camera]]
name = "colour"
width = 200
height = 200
[camera.intrinsics]
fx = 1143.00523
fy = 1143.00523
cx = 99.5
cy = 99.5
[camera.pose]
position = [208.6, -530.5, 489.0]
rotation = [0.98893021, 0.1483814, 0, 0.014590408, -0.097241939, -0.99515382,
            -0.147662317, 0.984137676, -0.098330437]
[[camera]]
name = "thermal"
width = 160
height = 128
[camera.outline]
centre = [79.5, 63.5]
radius = 58.06
alpha = 343.571
rotation = [-11.887, 11.639, 0]
)";

class Daemon : public testing::Test {
 protected:
  Daemon() {
    // DDS on the loopback interface only, apart from everybody else's.
    setenv("CYCLONEDDS_URI",
           ("<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"lo\"/></Interfaces>"
            "<AllowMulticast>false</AllowMulticast></General><Discovery><Tag>orbwatch_" +
            std::to_string(getpid()) +
            "</Tag><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>32"
            "</MaxAutoParticipantIndex><Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery>"
            "</Domain></CycloneDDS>")
               .c_str(),
           1);
  }

  std::string write_config(const std::string& text, const std::string& rig = kSmallRig) const {
    std::ofstream(folder / "rig.toml") << rig;
    const auto path = folder / "site.toml";
    std::ofstream(path) << "rig = \"rig.toml\"\n[modbus]\nport = " << port
                        << "\naddress = \"127.0.0.1\"\n[dds]\ndomain = " << domain << "\n"
                        << text;
    return path.string();
  }
  Subprocess start(const std::string& config) const {
    return Subprocess({ORBWATCHD_PROGRAM, "--config", config}, folder.path() / "daemon.log");
  }

  /// Reads until `condition` holds or the daemon ends.
  bool eventually(Subprocess& daemon, const std::function<bool()>& condition) const {
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(90);
    while (daemon.runs() && std::chrono::steady_clock::now() < give_up) {
      if (condition()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));  // polls a real server
    }
    return false;
  }
  std::int64_t read(const std::string& name) const { return read_register(port, name); }

  TemporaryFolder folder;
  int port = free_port();
  int domain = 1 + getpid() % 100;
};

const std::string kSmallMachine = R"(
[[camera]]
name = "colour"
back_end = "simulated"
width = 200
height = 200
frame_rate = 20
[camera.simulated]
kind = "colour"
position = [208.6, -530.5, 489.0]
h_fov = 10
[[camera]]
name = "thermal"
back_end = "simulated"
width = 160
height = 128
frame_rate = 20
kelvin_per_count = 0.04
[camera.simulated]
kind = "thermal"
position = [49.4, 395.4, 500.6]
h_fov = 22.5
FAULTS
[[view]]
name = "process"
yaw = -115
pitch = -40
width = 160
height = 120
[[view.source]]
camera = "colour"
[[view.source]]
camera = "thermal"
colour_map = "inferno"
range = [20, 800]
[[view]]
name = "room"
kind = "equirectangular"
width = 200
height = 100
[[view.source]]
camera = "colour"
[process]
view = "process"
camera = "thermal"
threshold = 1400
)";

std::string small_machine(const std::string& faults = "") {
  std::string text = kSmallMachine;
  return text.replace(text.find("FAULTS"), 6, faults);
}

TEST_F(Daemon, ReportsOverModbusAndDdsAndEndsCleanly) {
  Subprocess daemon = start(write_config(small_machine()));
  ASSERT_TRUE(eventually(daemon, [&] { return read("frame_set") > 5; })) << daemon.output();
  const auto heartbeat = read("heartbeat");
  EXPECT_TRUE(eventually(daemon, [&] { return read("heartbeat") != heartbeat; }));
  EXPECT_EQ(read("system_state"), 1) << "running";
  // The pool's truth: 2000 degC in the centre, on a circle of 40 mm around (-110, -50, 178), seen
  // from the ball at (120, 60, 430).
  ASSERT_TRUE(eventually(daemon, [&] { return read("hot_spot_peak_temperature") > 17000; }));
  EXPECT_NEAR(static_cast<double>(read("hot_spot_yaw")) / 100, -115.6, 10);
  EXPECT_NEAR(static_cast<double>(read("hot_spot_pitch")) / 100, -45, 6);

  Subprocess reader({ORBWATCH_PROGRAM, "subscribe", "--domain", std::to_string(domain), "--topic",
                     "orbwatch/process/image_raw", "--topic", "orbwatch/room/image_raw", "--topic",
                     "orbwatch/process_state", "--save", folder.path().string(), "--seconds", "5"},
                    folder.path() / "reader.log");
  EXPECT_EQ(reader.wait(), 0) << reader.output();
  EXPECT_EQ(cv::imread((folder.path() / "process.png").string()).size(), cv::Size(160, 120));
  EXPECT_EQ(cv::imread((folder.path() / "room.png").string()).size(), cv::Size(200, 100));

  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(), 0) << daemon.output();
}

/// Its first camera is triggered over a wire, by a line that has `pace` among its keys.
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
    write_command(port, 2, 0, n);
    ASSERT_TRUE(eventually(daemon, [&] { return read("camera_0_frames") == n; }))
        << daemon.output();
  }
  EXPECT_EQ(read("camera_0_triggers"), kPulses);
  EXPECT_EQ(read("camera_0_missed"), 0);
  write_command(port, 2, 1, 9);
  EXPECT_TRUE(eventually(daemon, [&] { return read("acknowledged_sequence") == 9; }));
  EXPECT_EQ(read("command_result"), 2) << "there is no second trigger_out";
}

TEST_F(Daemon, CarriesOutTheSelectViewCommandOnce) {
  Subprocess daemon = start(write_config(small_machine()));
  ASSERT_TRUE(eventually(daemon, [&] { return read("frame_set") > 0; })) << daemon.output();
  EXPECT_EQ(read("selected_view"), 0);
  write_command(port, 1, 1, 7);
  EXPECT_TRUE(eventually(
      daemon, [&] { return read("acknowledged_sequence") == 7 && read("selected_view") == 1; }));
  write_command(port, 1, 9, 8);
  EXPECT_TRUE(eventually(daemon, [&] { return read("acknowledged_sequence") == 8; }));
  EXPECT_EQ(read("selected_view"), 1) << "there is no view 9";
  daemon.send(SIGINT);
  EXPECT_EQ(daemon.wait(), 0) << daemon.output();
}

TEST_F(Daemon, LivesThroughAnUnpluggedCamera) {
  const std::string faults = "[[camera.fault]]\nfault = \"unplugged\"\nfrom = 20\nuntil = 60\n";
  Subprocess daemon = start(write_config(small_machine(faults)));
  EXPECT_TRUE(eventually(daemon, [&] { return read("system_state") == 2; })) << daemon.output();
  EXPECT_TRUE(eventually(daemon, [&] { return read("system_state") == 1; })) << daemon.output();
  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(), 0);
  EXPECT_NE(daemon.output().find("thermal: camera is not connected"), std::string::npos)
      << daemon.output();
}

TEST_F(Daemon, ReplaysARecordingAndMergesItsCameras) {
  const auto renders = reference_data() / "renders";
  ORBWATCH_REQUIRE_FILE(renders / "seq_spark");
  ORBWATCH_REQUIRE_FILE(renders / "seq_thermal");
  // As in the recording's scene.json, but for the pixels, whose centres are at +0.5 there.
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
[[view]]
name = "merged"
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
[process]
view = "merged"
camera = "thermal"
threshold = 500
)";
  Subprocess daemon = start(write_config(config, rig));
  ASSERT_TRUE(eventually(daemon, [&] {
    return read("frame_set") > 24 && read("hot_spot_area") > 0;
  })) << daemon.output();
  Subprocess reader(
      {ORBWATCH_PROGRAM, "subscribe", "--domain", std::to_string(domain), "--topic",
       "orbwatch/merged/image_raw", "--save", folder.path().string(), "--seconds", "4"},
      folder.path() / "reader.log");
  EXPECT_EQ(reader.wait(), 0) << reader.output();
  // scene.json's melt pool, seen from the ball's centre: yaw -122.9 to -113.7, pitch -48.2 to
  // -40.4. In a few of the frames a spark is larger than it.
  std::int64_t last_set = 0;
  std::vector<double> yaw, pitch;
  ASSERT_TRUE(eventually(daemon, [&] {
    const std::int64_t set = read("frame_set");
    if (std::exchange(last_set, set) != set) {
      yaw.push_back(static_cast<double>(read("hot_spot_yaw")) / 100);
      pitch.push_back(static_cast<double>(read("hot_spot_pitch")) / 100);
    }
    return yaw.size() >= 25;
  })) << daemon.output();
  const auto median = [](std::vector<double>& values) {
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
  };
  EXPECT_NEAR(median(yaw), -118.3, 5.5);
  EXPECT_NEAR(median(pitch), -44.3, 4.8);
  const cv::Mat merged = cv::imread((folder.path() / "merged.png").string());
  ASSERT_EQ(merged.size(), cv::Size(400, 300));
  cv::Mat grey;
  cv::extractChannel(merged, grey, 1);
  EXPECT_GT(cv::countNonZero(grey), 400 * 300 * 9 / 10) << "both cameras see most of this view";
  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(), 0) << daemon.output();
}

TEST_F(Daemon, RefusesAPortInUseInOneLine) {
  const int s = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  ASSERT_EQ(bind(s, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  ASSERT_EQ(listen(s, 1), 0);
  Subprocess daemon = start(write_config(small_machine()));
  EXPECT_GT(daemon.wait(), 0);
  const std::string said = daemon.output();
  EXPECT_NE(said.find(std::to_string(port)), std::string::npos) << said;
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  close(s);
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
  refused({}, "--config");
  refused({"--config", "/no/such.toml"}, "/no/such.toml");
  refused({"--config", write_config("[cameras]\n")}, "site.toml:7: cameras");
  const auto replay = [](const std::string& source) {
    std::string text = small_machine();
    const std::size_t begin = text.find("[camera.simulated]"), end = text.find("[[camera]]", begin);
    text.replace(begin, end - begin, "[camera.replay]\nsource = \"" + source + "\"\n");
    const std::string size = "width = 200\nheight = 200\n";
    text.erase(text.find(size), size.size());
    return text.replace(text.find("\"simulated\""), 11, "\"replay\"");
  };
  refused({"--config", write_config(replay("nothing"))}, "camera colour: ");
  std::filesystem::create_directory(folder / "pictures");
  cv::imwrite((folder / "pictures/000.png").string(), cv::Mat(48, 64, CV_8UC3, cv::Scalar(9)));
  refused({"--config", write_config(replay("pictures"))},
          "camera colour: delivers 64x48, but the rig is for 200x200 pictures");
}

TEST_F(Daemon, ChecksAFileWithoutRunning) {
  Subprocess program({ORBWATCHD_PROGRAM, "--check", "--config", write_config(small_machine())},
                     folder.path() / "said");
  EXPECT_EQ(program.wait(), 0) << program.output();
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

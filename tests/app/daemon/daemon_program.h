// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "app/model/command/command.h"
#include "tests/support/loopback_dds.h"
#include "tests/support/registers.h"
#include "tests/support/subprocess.h"
#include "tests/support/temporary_folder.h"

/// `orbwatchd` as installed: the program, its files, and a simulated machine.
namespace orbwatch::tests {

/// Port that is free at this moment.
inline int free_port() {
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

/// Contents of a file; empty if it does not exist.
inline std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline const std::string kMachine = R"(
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

// Poses: that of the colour camera, and limb and registration of the thermal one.
inline const std::string kPlaces = R"([camera.pose]
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

// Rig with a calibrated colour camera.
inline const std::string kSmallRig = kMachine + R"(
[[camera]]
name = "colour"
width = 200
height = 200
[camera.intrinsics]
fx = 1143.00523
fy = 1143.00523
cx = 99.5
cy = 99.5
)" + kPlaces;

inline const std::string kSmallRecipe = R"(
name = "pool"
[[view]]
name = "process"
measured = "thermal"
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
[[region]]
name = "pool"
view = "process"
hot_spot_threshold = 1400
)";

class Daemon : public testing::Test {
 protected:
  Daemon() { setenv("CYCLONEDDS_URI", loopback_dds().c_str(), 1); }

  std::string write_config(const std::string& text, const std::string& rig = kSmallRig,
                           const std::string& recipe = kSmallRecipe) const {
    std::ofstream(folder / "rig.toml") << rig;
    std::ofstream(folder / "recipe.toml") << recipe;
    const auto path = folder / "site.toml";
    std::ofstream(path) << "rig = \"rig.toml\"\nstate_folder = \"" << state_folder
                        << "\"\n[modbus]\nport = " << port
                        << "\naddress = \"127.0.0.1\"\n[dds]\ncommands = true\ndomain = " << domain
                        << "\n"
                        << text << "[[recipe]]\nnumber = 1\nfile = \"recipe.toml\"\n";
    return path.string();
  }
  Subprocess start(const std::string& config) const {
    return Subprocess({ORBWATCHD_PROGRAM, "--config", config}, folder.path() / "daemon.log");
  }

  /// Reads until `condition` holds or the daemon ends.
  bool eventually(Subprocess& daemon, const std::function<bool()>& condition) const {
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(180);
    while (daemon.runs() && std::chrono::steady_clock::now() < give_up) {
      if (condition()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));  // polls a real server
    }
    return false;
  }
  std::int64_t read(const std::string& name) const { return read_register(port, name); }
  /// Sends a command and returns the daemon's answer.
  app::CommandResult command(Subprocess& daemon, app::CommandCode code,
                             const std::vector<std::int32_t>& arguments = {}) {
    write_command(port, static_cast<std::uint16_t>(code), arguments, ++sequence);
    EXPECT_TRUE(eventually(daemon, [&] { return read("acknowledged_sequence") == sequence; }))
        << daemon.output();
    return static_cast<app::CommandResult>(read("command_result"));
  }
  bool says(Subprocess& daemon, const std::string& text) const {
    return eventually(daemon, [&] { return daemon.output().find(text) != std::string::npos; });
  }

  TemporaryFolder folder;
  std::string state_folder = "state";
  int port = free_port();
  int domain = 1 + getpid() % 100;
  std::uint16_t sequence = 100;  ///< sequence number of the newest command
};

inline const std::string kSmallMachine = R"(
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
name = "room"
kind = "equirectangular"
width = 200
height = 100
[[view.source]]
camera = "colour"
)";

inline std::string small_machine(const std::string& faults = "") {
  std::string text = kSmallMachine;
  return text.replace(text.find("FAULTS"), 6, faults);
}

}  // namespace orbwatch::tests

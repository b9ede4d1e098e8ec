// SPDX-License-Identifier: Apache-2.0
#include "app/cli/doctor/checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <limits>

#include "hal/lines/simulated_lines.h"

/// Runs each check on facts of a fault-free board with one of them changed.
namespace orbwatch::app::cli::doctor {
namespace {

using testing::HasSubstr;

class Checks : public testing::Test {
 protected:
  Checks() {
    facts.configuration = {"/etc/orbwatch/site.toml", true, ""};
    facts.site.emplace();
    facts.board.has_folder = true;
    facts.board.model = "Raspberry Pi 5 Model B Rev 1.0";
    facts.board.known = Board{.name = "Raspberry Pi 5",
                              .tried = "not run",
                              .processor = "4 Cortex-A76",
                              .kernel_package = "linux-image-rpi-2712",
                              .firmware_file = "/boot/firmware/config.txt",
                              .firmware_lines = {"[all]"},
                              .slows_down_at = 80,
                              .supply = "5 V, 5 A",
                              .lines = {{{"UP"}, 3.3, Pull::Up}, {{"DOWN"}, 3.3, Pull::Down}},
                              .cameras = {{"imx296", "dtoverlay=imx296", 1.8}}};
    facts.kernel = {"6.12.25", true, {{"uvcvideo", "camera c", true}}};
    facts.chips = hal::SimulatedLines({"UP", "DOWN", "OTHER"}).chips();
    facts.limits.of_service = true;
    facts.limits.realtime_priority = 48;
    facts.limits.locked_memory = std::numeric_limits<std::uint64_t>::max();
    facts.limits.realtime_runtime = 950000;
    facts.limits.realtime_period = 1000000;
    facts.health.clock_synchronised = 1;
    facts.health.board_temperature = 48;
    facts.health.throttling = 0;
    facts.has_battery_clock = true;
    facts.network = {16777216, true, 1024, true};
    facts.watchdog = {true, "active", 14};
  }

  /// Returns the only line.
  static Diagnosis one(const Diagnoses& found) {
    EXPECT_EQ(found.size(), 1U);
    return found.empty() ? Diagnosis{} : found.front();
  }

  /// Returns the worst line; checks that all lines that are not ok have a remedy.
  static Diagnosis worst_of(const Diagnoses& found) {
    EXPECT_FALSE(found.empty());
    for (const Diagnosis& diagnosis : found) {
      EXPECT_EQ(diagnosis.remedy.empty(), diagnosis.level == Level::Ok) << diagnosis.text;
      EXPECT_FALSE(diagnosis.text.empty());
    }
    return found.empty() ? Diagnosis{} : *std::ranges::max_element(found, {}, &Diagnosis::level);
  }

  static void expect(const Diagnoses& found, Level level, const std::string& text,
                     const std::string& remedy = "") {
    const Diagnosis worst = worst_of(found);
    EXPECT_EQ(worst.level, level) << worst.text;
    EXPECT_THAT(worst.text, HasSubstr(text));
    EXPECT_THAT(worst.remedy, HasSubstr(remedy));
  }

  LineSettings& line(LineUse use, const std::string& address) {
    auto& added = facts.site->lines.emplace_back();
    added.name = "out";
    added.use = use;
    added.wire.address.name = address;
    return added;
  }

  CameraFacts& camera(Presence presence, const std::string& error = "") {
    return facts.cameras.emplace_back(CameraFacts{"c", "imx296", presence, error});
  }

  Facts facts;
};

TEST_F(Checks, FindNothingWhereAllIsWell) {
  camera(Presence::There);
  line(LineUse::ProcessOk, "DOWN");
  facts.folders = {{"state", "/var/lib/orbwatch", 4000, 50, false}};
  facts.ports = {{"modbus", "0.0.0.0", 1502}};
  const Diagnoses all = diagnose(facts);
  EXPECT_GE(all.size(), 14U);
  for (const Diagnosis& diagnosis : all) {
    EXPECT_EQ(diagnosis.level, Level::Ok) << diagnosis.check << ": " << diagnosis.text;
    EXPECT_FALSE(diagnosis.check.empty());
  }
}

TEST_F(Checks, KnowNothingOfAnEmptyComputerAndSaySo) {
  const Diagnoses all = diagnose(Facts{});
  EXPECT_EQ(worst_of(all).level, Level::Fault) << "there is no configuration";
}

TEST_F(Checks, Configuration) {
  expect(check_configuration(facts), Level::Ok, "/etc/orbwatch/site.toml");
  facts.configuration.error = "site.toml:3: camera: is missing";
  expect(check_configuration(facts), Level::Fault, "site.toml:3", "--check");
  facts.configuration.exists = false;
  expect(check_configuration(facts), Level::Fault, "there is none", "orbwatch setup");
}

TEST_F(Checks, Board) {
  expect(check_board(facts), Level::Ok, "Raspberry Pi 5 Model B Rev 1.0");
  EXPECT_THAT(one(check_board(facts)).text, HasSubstr("not run"));
  facts.board.problems = {"a.toml:1: name: is missing"};
  expect(check_board(facts), Level::Warning, "a.toml:1",
         "sudo apt install --reinstall ./orbwatch_*.deb");
  facts.board.problems.clear();
  facts.board.known.reset();
  expect(check_board(facts), Level::Warning, "no file in", "platform/boards");
  facts.board.has_folder = false;
  expect(check_board(facts), Level::Warning, "not installed in",
         "sudo apt install --reinstall ./orbwatch_*.deb");
}

TEST_F(Checks, Kernel) {
  expect(check_kernel(facts), Level::Ok, "Linux 6.12.25, with uvcvideo");
  facts.kernel.drivers.front().is_there = false;
  expect(check_kernel(facts), Level::Fault, "no driver uvcvideo, which camera c needs",
         "apt install linux-image-rpi-2712");
  facts.board.known.reset();
  expect(check_kernel(facts), Level::Fault, "uvcvideo", "linux-image-$(dpkg");
  facts.kernel.lists_drivers = false;
  expect(check_kernel(facts), Level::Warning, "cannot be read", "modprobe uvcvideo");
  facts.kernel.release.clear();
  expect(check_kernel(facts), Level::Warning, "cannot be read", "uname");
}

TEST_F(Checks, HeapsMatterToLibcameraOnly) {
  EXPECT_TRUE(check_heaps(facts).empty());
  facts.site->cameras.emplace_back().back_end = hal::LibcameraSettings{};
  expect(check_heaps(facts), Level::Fault, "/dev/dma_heap is not there", "apt install");
  facts.heaps = {{"/dev/dma_heap/linux,cma", ""}, {"/dev/dma_heap/system", ""}};
  expect(check_heaps(facts), Level::Ok, "/dev/dma_heap/linux,cma, /dev/dma_heap/system");
  facts.heaps.back().error = "no permission";
  expect(check_heaps(facts), Level::Fault, "system: no permission", "usermod -aG video");
}

TEST_F(Checks, Cameras) {
  EXPECT_TRUE(check_cameras(facts).empty());
  camera(Presence::There);
  camera(Presence::Simulated);
  expect(check_cameras(facts), Level::Ok, "c (imx296): is there");
  CameraFacts& found = facts.cameras.back();
  found.presence = Presence::Closed;
  found.error = "no permission";
  expect(check_cameras(facts), Level::Fault, "no permission", "usermod -aG video");
  found.presence = Presence::NoModule;
  found.module = "genicam";
  expect(check_cameras(facts), Level::Fault, "no permission",
         "sudo apt install ./orbwatch-camera-genicam_*.deb (of a bundle: sudo ./install "
         "orbwatch-camera-genicam)");
}

TEST_F(Checks, AMissingCameraComesWithTheOthersAndItsOverlay) {
  camera(Presence::Missing, "none").others = {"/dev/video7"};
  expect(check_cameras(facts), Level::Fault, "none; there are: /dev/video7",
         R"(printf '%s\n' '[all]' 'dtoverlay=imx296' | sudo tee -a /boot/firmware/config.txt)");
  facts.cameras.front().address = "/dev/video0";
  facts.cameras.front().others.clear();
  expect(check_cameras(facts), Level::Fault, "there is no camera", "orbwatch list");
  facts.board.known.reset();
  expect(check_cameras(facts), Level::Fault, "there is no camera", "orbwatch list");
}

TEST_F(Checks, LinesAreThereAndFree) {
  EXPECT_TRUE(check_lines(facts).empty());
  LineSettings& out = line(LineUse::ProcessOk, "DOWN");
  expect(check_lines(facts), Level::Ok, "out: DOWN, 3.3 V at most, pulled down from power-on");
  out.wire.address.name = "NOWHERE";
  expect(check_lines(facts), Level::Fault, "there is none", "orbwatch list");
  facts.chips.push_back({.path = "/dev/gpiochip4", .error = "no permission"});
  expect(check_lines(facts), Level::Fault, "no permission", "usermod -aG gpio");
  out.back_end = LineKind::Simulated;
  EXPECT_TRUE(check_lines(facts).empty());
}

TEST_F(Checks, ALineInUseNamesWhoHasIt) {
  line(LineUse::ProcessInput, "DOWN");
  hal::LineInfo& info = *std::ranges::find(facts.chips.front().lines, "DOWN", &hal::LineInfo::name);
  info.is_used = true;
  info.consumer = "spi0 CS0";
  expect(check_lines(facts), Level::Fault, "is used by spi0 CS0", "gpioinfo");
  info.consumer.clear();
  expect(check_lines(facts), Level::Fault, "a driver of the kernel");
  info.consumer = hal::kLineConsumer;
  expect(check_lines(facts), Level::Ok, "held by orbwatchd");
}

TEST_F(Checks, AnOutputThatRestsActiveIsARisk) {
  LineSettings& out = line(LineUse::ProcessOk, "UP");
  expect(check_lines(facts), Level::Warning, "active when nobody drives it", "active_low = true");
  out.wire.active_low = true;
  expect(check_lines(facts), Level::Ok, "pulled up");
  out.wire.address.name = "DOWN";
  expect(check_lines(facts), Level::Warning, "active when nobody", "active_low = false");
  out.wire.bias = hal::LineBias::PullUp;
  expect(check_lines(facts), Level::Ok, "DOWN");
  out = {};
  out.wire.address.name = "UP";
  out.use = LineUse::ProcessInput;
  expect(check_lines(facts), Level::Ok, "UP");
  out.wire.address.name = "OTHER";
  expect(check_lines(facts), Level::Ok, "OTHER");
}

TEST_F(Checks, ATriggerInputOfAnotherVoltageIsNamed) {
  line(LineUse::TriggerOut, "DOWN");
  EXPECT_EQ(one(check_lines(facts)).text.find("divide"), std::string::npos);
  camera(Presence::There);
  expect(check_lines(facts), Level::Ok, "the trigger input of c bears 1.8 V only");
}

TEST_F(Checks, RealTimeLimitsOfTheService) {
  expect(check_real_time(facts), Level::Ok, "");
  facts.limits.realtime_priority = 0;
  expect(check_real_time(facts), Level::Warning, "48 is needed", "LimitRTPRIO=48");
  facts.limits.may_set_priority = true;
  expect(check_real_time(facts), Level::Ok, "");
  facts.limits.locked_memory = 8 << 20;
  expect(check_real_time(facts), Level::Warning, "swapped", "LimitMEMLOCK=infinity");
  facts.limits.of_service = false;
  expect(check_real_time(facts), Level::Warning, "this shell", "systemctl start orbwatch");
  facts.limits.may_lock_memory = true;
  expect(check_real_time(facts), Level::Ok, "");
  facts.limits.cores_error = "threads.cores: there is no core 9";
  expect(check_real_time(facts), Level::Fault, "no core 9", "[threads]");
}

TEST_F(Checks, RealTimeThatNobodyWantsIsNotMissed) {
  facts.limits = {};
  facts.site->threads.realtime = false;
  facts.site->threads.lock_memory = false;
  EXPECT_TRUE(check_real_time(facts).empty());
}

TEST_F(Checks, ShareOfRealTimeThreads) {
  facts.limits.realtime_runtime = 500000;
  expect(check_real_time(facts), Level::Warning, "50 %", "sched_rt_runtime_us=950000");
  for (const std::int64_t runtime : {std::int64_t{-1}, std::int64_t{1000000}}) {
    facts.limits.realtime_runtime = runtime;
    expect(check_real_time(facts), Level::Ok, "");
  }
  for (const std::int64_t period : {std::int64_t{0}, std::int64_t{-5}}) {
    facts.limits.realtime_period = period;
    expect(check_real_time(facts), Level::Ok, "");
  }
}

TEST_F(Checks, Clock) {
  expect(check_clock(facts), Level::Ok, "follows a time server");
  facts.has_battery_clock = false;
  expect(check_clock(facts), Level::Warning, "no battery clock", "fit a battery clock");
  facts.board.known->battery_clock = "fit an RTC";
  expect(check_clock(facts), Level::Warning, "no battery clock", "fit an RTC");
  facts.has_battery_clock = true;
  facts.health.clock_synchronised = 0;
  expect(check_clock(facts), Level::Warning, "follows no time server", "set-ntp true");
  facts.health.clock_synchronised = signals::kNotValid;
  expect(check_clock(facts), Level::Warning, "unknown", "timedatectl");
}

TEST_F(Checks, ReceiveBufferMattersToDds) {
  expect(check_receive_buffer(facts), Level::Ok, "16777216");
  facts.network.largest_receive_buffer = 8 << 20;
  expect(check_receive_buffer(facts), Level::Ok, "8388608");
  facts.network.largest_receive_buffer = 212992;
  expect(check_receive_buffer(facts), Level::Warning, "212992", "sysctl --system");
  facts.network.has_sysctl_file = false;
  expect(check_receive_buffer(facts), Level::Warning, "212992", "-w net.core.rmem_max");
  facts.network.largest_receive_buffer.reset();
  expect(check_receive_buffer(facts), Level::Warning, "cannot be read");
  std::get<DdsSettings>(facts.site->sinks).enabled = false;
  EXPECT_TRUE(check_receive_buffer(facts).empty());
}

TEST_F(Checks, Ports) {
  facts.ports = {{"modbus", "0.0.0.0", 1502}};
  PortFacts& port = facts.ports.front();
  expect(check_ports(facts), Level::Ok, "modbus 0.0.0.0:1502: free");
  port.error = EADDRINUSE;
  port.holder = "orbwatchd";
  expect(check_ports(facts), Level::Ok, "held by orbwatchd");
  port.other_configuration = "/etc/orbwatch/site.toml";
  expect(check_ports(facts), Level::Fault, "taken by the orbwatchd of /etc/orbwatch/site.toml",
         "another port in [modbus]");
  port.other_configuration.clear();
  port.holder = "mbserver";
  expect(check_ports(facts), Level::Fault, "taken by mbserver", "ss -ltnp");
  port.holder.clear();
  expect(check_ports(facts), Level::Fault, "cannot see", "sudo");
  port.service_runs = true;
  expect(check_ports(facts), Level::Warning, "whether by orbwatchd", "sudo");
  port.error = EADDRNOTAVAIL;
  expect(check_ports(facts), Level::Fault, "no network interface", "[modbus]");
  port.error = EMFILE;
  expect(check_ports(facts), Level::Fault, "Too many open files");
}

TEST_F(Checks, PortsBelow1024NeedACapability) {
  facts.ports = {{"modbus", "0.0.0.0", 502}};
  for (const int error : {0, EACCES}) {
    facts.ports.front().error = error;
    facts.network.has_unit = true;
    expect(check_ports(facts), Level::Ok, "capability");
    facts.network.has_unit = false;
    expect(check_ports(facts), Level::Fault, "CAP_NET_BIND_SERVICE", "port_start=502");
  }
}

TEST_F(Checks, ASerialLineMustBeThere) {
  EXPECT_TRUE(check_ports(facts).empty());
  facts.missing_serial_line = "/dev/ttyUSB0";
  expect(check_ports(facts), Level::Fault, "/dev/ttyUSB0", "connect");
}

constexpr const char* kClosed = R"({"nftables": [
  {"chain": {"family": "inet", "table": "filter", "name": "input", "hook": "input",
             "type": "filter", "prio": 0, "policy": "drop"}},
  {"rule": {"chain": "input", "expr": [
    {"match": {"op": "==", "left": {"payload": {"protocol": "tcp", "field": "dport"}},
               "right": {"set": [22, {"range": [8000, 8100]}]}}}, {"accept": null}]}}]})";

TEST_F(Checks, FirewallThatDropsAPort) {
  auto& dds = std::get<DdsSettings>(facts.site->sinks);
  dds.enabled = false;
  facts.ports = {{"modbus", "0.0.0.0", 1502}, {"web", "127.0.0.1", 9000}};
  expect(check_firewall(facts), Level::Ok, "not installed");
  facts.firewall.has_nft = true;
  expect(check_firewall(facts), Level::Warning, "cannot be read", "sudo orbwatch doctor");
  facts.firewall.ruleset = R"({"nftables": []})";
  expect(check_firewall(facts), Level::Ok, "no chain");
  facts.firewall.ruleset = kClosed;
  EXPECT_EQ(check_firewall(facts).size(), 1U) << "loopback is not asked for";
  expect(check_firewall(facts), Level::Warning, "no rule names tcp dport 1502",
         "nft add rule inet filter input tcp dport 1502 accept");
  facts.ports.front().port = 8042;
  expect(check_firewall(facts), Level::Ok, "a rule names tcp dport 8042");
  facts.ports.clear();
  expect(check_firewall(facts), Level::Ok, "no port is served");
  dds.enabled = true;
  dds.domain = 2;
  expect(check_firewall(facts), Level::Warning, "dds, for other computers",
         "nft add rule inet filter input udp dport 7900-8149 accept");
  facts.firewall.has_iptables = true;
  expect(check_firewall(facts), Level::Warning, "iptables", "iptables -L");
}

TEST_F(Checks, Disk) {
  EXPECT_TRUE(check_disk(facts).empty());
  facts.folders = {{"state", "/var/lib/orbwatch", 4000, 50, false}};
  FolderFacts& folder = facts.folders.front();
  expect(check_disk(facts), Level::Ok, "4000 MiB free, 50 %");
  folder.free = 499;
  expect(check_disk(facts), Level::Warning, "499 MiB", "df -h /var/lib/orbwatch");
  folder.free = 19;
  expect(check_disk(facts), Level::Fault, "19 MiB", "df");
  folder.read_only = true;
  expect(check_disk(facts), Level::Fault, "read only", "remount,rw");
  folder = {"state", "/var/lib/orbwatch", {}, {}, false};
  expect(check_disk(facts), Level::Warning, "cannot be read", "df");
}

TEST_F(Checks, AFolderThatTheServiceCannotWrite) {
  facts.folders = {{"recordings", "/mnt/ssd", 4000, 50, false, "", Access::Write, "orbwatch@two"}};
  FolderFacts& folder = facts.folders.front();
  expect(check_disk(facts), Level::Ok, "4000 MiB free");
  folder.access = Access::ReadOnly;
  expect(check_disk(facts), Level::Fault, "/mnt/ssd: read-only for the service orbwatch@two",
         "sudo systemctl edit orbwatch@two with the lines [Service] and ReadWritePaths=-/mnt/ssd;");
  folder.access = Access::Denied;
  expect(check_disk(facts), Level::Fault, "/mnt/ssd: not writable for the service's user",
         "sudo install -d -o orbwatch -g orbwatch /mnt/ssd");
  folder.access = Access::ReadOnly;
  folder.path = "/home/pi/recordings";
  expect(check_disk(facts), Level::Fault, "read-only for", "another folder: ProtectHome=");
}

TEST_F(Checks, Watchdog) {
  expect(check_watchdog(facts), Level::Ok, "systemd feeds it, 14 s");
  facts.watchdog.systemd_timeout = 60;
  expect(check_watchdog(facts), Level::Warning, "60 s", "RuntimeWatchdogSec=14s");
  for (const double none : {0.0, std::numeric_limits<double>::infinity()}) {
    facts.watchdog.systemd_timeout = none;
    expect(check_watchdog(facts), Level::Warning, "does not feed", "RuntimeWatchdogSec=14s");
  }
  facts.watchdog.systemd_timeout = 14;
  facts.watchdog.state = "inactive";
  expect(check_watchdog(facts), Level::Warning, "nobody feeds", "daemon-reexec");
  facts.watchdog.systemd_timeout.reset();
  facts.watchdog.state.reset();
  expect(check_watchdog(facts), Level::Ok, "/dev/watchdog is there");
  facts.watchdog.is_there = false;
  expect(check_watchdog(facts), Level::Warning, "is not there", "modprobe");
}

TEST_F(Checks, HeatAndSupply) {
  expect(check_heat(facts), Level::Ok, "48 degC; the board slows down at 80 degC");
  facts.health.board_temperature = 70;
  expect(check_heat(facts), Level::Warning, "70 degC", "cooling");
  facts.health.board_temperature = signals::kNotValid;
  const auto with = [&](unsigned bits) {
    facts.health.throttling = bits;
    return check_heat(facts);
  };
  expect(with(0x11), Level::Fault, "voltage is too low", "5 V, 5 A");
  expect(with(0x44), Level::Warning, "slowed down now", "cooling");
  expect(with(0x10), Level::Warning, "was too low since power-on", "5 V, 5 A");
  expect(with(0x80), Level::Warning, "was slowed down", "cooling");
  facts.health.throttling = signals::kNotValid;
  expect(check_heat(facts), Level::Ok, "no thermometer");
}

}  // namespace
}  // namespace orbwatch::app::cli::doctor

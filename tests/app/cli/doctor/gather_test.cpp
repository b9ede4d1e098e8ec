// SPDX-License-Identifier: Apache-2.0
#include "app/cli/doctor/gather.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <limits>
#include <random>
#include <sstream>

#include "app/cli/doctor/checks.h"
#include "app/cli/doctor/doctor_text.h"
#include "hal/thread/file_descriptor.h"
#include "tests/app/health/made_up_tree.h"

/// Gathers facts of a synthetic board: a folder with its /proc, /sys and /dev.
namespace orbwatch::app::cli::doctor {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using tests::MadeUpTree;

constexpr const char* kRig = R"(
[[camera]]
name = "c"
width = 640
height = 480
[camera.outline]
centre = [320, 240]
radius = 200
alpha = 350
)";

class Gather : public testing::Test {
 protected:
  Gather() {
    sources.root = tree.path();
    sources.boards = std::filesystem::path(ORBWATCH_SOURCE_DIR) / "platform/boards";
    sources.architecture = "aarch64";
    sources.chips = [] { return std::vector<hal::ChipInfo>{}; };
    sources.module_cameras = [this](std::string_view) { return module_cameras; };
    sources.video_module = [this] { return video_module; };
    tree.write("proc/device-tree/model", std::string("Raspberry Pi 5 Model B Rev 1.0\0", 31));
    tree.write("proc/sys/kernel/osrelease", "6.12.25+rpt-rpi-2712\n");
    tree.write("proc/sys/kernel/sched_rt_runtime_us", "950000\n");
    tree.write("proc/sys/kernel/sched_rt_period_us", "1000000\n");
    tree.write("proc/sys/net/core/rmem_max", "212992\n");
    tree.write("proc/sys/net/ipv4/ip_unprivileged_port_start", "1024\n");
    tree.write("lib/modules/6.12.25+rpt-rpi-2712/modules.builtin", "kernel/drivers/rp1-cfe.ko\n");
    tree.write("lib/modules/6.12.25+rpt-rpi-2712/modules.dep",
               "kernel/drivers/media/mc/mc.ko.xz:\nkernel/media/pisp_be/pisp-be.ko.xz: a.ko\n");
    process("7", "orbwatchd", 48);
  }

  void process(const std::string& pid, const std::string& name, int priority) {
    const std::string folder = "proc/" + pid + "/";
    tree.write(folder + "comm", name + "\n");
    tree.write(folder + "limits",
               "Limit                     Soft Limit           Hard Limit           Units     \n"
               "Max locked memory         unlimited            unlimited            bytes     \n"
               "Max realtime priority     " +
                   std::to_string(priority) + "    48\n");
    tree.write(folder + "status", "Name:\tx\nCapEff:\t0000000000000400\n");
  }

  /// Facts for a site with one camera of this back-end.
  Facts of(const std::string& camera, const std::string& rest = "") {
    tree.write("site/rig.toml", kRig);
    tree.write(
        "site/site.toml",
        "rig = \"rig.toml\"\nstate_folder = \"/var/lib/state/deep\"\n" +
            std::string("[modbus]\nport = 0\n") + rest +
            "\n[[view]]\nname = \"v\"\nwidth = 64\nheight = 48\n[[view.source]]\ncamera = \"c\"\n" +
            "\n[[camera]]\nname = \"c\"\n" + camera);
    return gather(sources, tree / "site/site.toml");
  }

  Facts with_usb_camera(const std::string& rest = "") {
    return of("back_end = \"v4l2\"\n[camera.v4l2]\ndevice = \"/dev/v4l/by-id/usb-cam\"\n", rest);
  }
  Facts with_libcamera(const std::string& name = "imx296") {
    return of("back_end = \"libcamera\"\n[camera.libcamera]\ncamera = \"" + name + "\"\n");
  }

  MadeUpTree tree;
  Sources sources;
  Result<std::vector<hal::CameraEntry>> module_cameras;
  Result<> video_module;
};

TEST_F(Gather, BoardAndKernel) {
  const Facts facts = with_libcamera();
  EXPECT_EQ(facts.configuration.error, "");
  EXPECT_EQ(facts.board.model, "Raspberry Pi 5 Model B Rev 1.0");
  ASSERT_TRUE(facts.board.known);
  EXPECT_EQ(facts.board.known->name, "Raspberry Pi 5");
  EXPECT_EQ(facts.kernel.release, "6.12.25+rpt-rpi-2712");
  ASSERT_EQ(facts.kernel.drivers.size(), 2U);
  EXPECT_TRUE(facts.kernel.drivers[0].is_there) << "built in";
  EXPECT_TRUE(facts.kernel.drivers[1].is_there) << "a module, whose file has a hyphen";
}

TEST_F(Gather, ADriverIsThereWhenItIsLoaded) {
  EXPECT_FALSE(with_usb_camera().kernel.drivers.at(1).is_there);
  tree.make_folder("sys/module/uvcvideo");
  const Facts facts = with_usb_camera();
  EXPECT_EQ(facts.kernel.drivers.at(1).name, "uvcvideo");
  EXPECT_TRUE(facts.kernel.drivers.at(1).is_there);
  EXPECT_TRUE(facts.kernel.lists_drivers);
  tree.remove("lib");
  EXPECT_FALSE(with_usb_camera().kernel.lists_drivers);
}

TEST_F(Gather, APcByItsFirmware) {
  tree.remove("proc/device-tree");
  tree.write("sys/class/dmi/id/sys_vendor", "Acme\n");
  tree.write("sys/class/dmi/id/product_name", "Box 7\n");
  sources.architecture = "x86_64";
  const Facts facts = with_usb_camera();
  EXPECT_EQ(facts.board.model, "Acme Box 7");
  EXPECT_EQ(facts.board.known->name, "any x86 PC");
}

TEST_F(Gather, ConfigurationThatIsWrongOrMissing) {
  const Facts wrong = of("back_end = \"v4l2\"\n[camera.v4l2]\ndevice = \"/dev/video0\"\n",
                         "[threads]\nrealtime = 7\n");
  EXPECT_THAT(wrong.configuration.error, HasSubstr("realtime"));
  tree.write("site/rig.toml", "nonsense");
  const Facts rig = gather(sources, tree / "site/site.toml");
  EXPECT_FALSE(rig.configuration.error.empty());
  const Facts none = gather(sources, tree / "site/none.toml");
  EXPECT_FALSE(none.configuration.exists);
  EXPECT_FALSE(none.site);
  const Facts folder = gather(sources, tree / "site");
  EXPECT_THAT(folder.configuration.error, HasSubstr("is not a file"));
}

TEST_F(Gather, OfAWrongRigTheCamerasAreStillLookedFor) {
  with_usb_camera();
  tree.write("site/rig.toml", "nonsense");
  const Facts facts = gather(sources, tree / "site/site.toml");
  EXPECT_FALSE(facts.configuration.error.empty());
  EXPECT_EQ(facts.cameras.size(), 1U);
}

TEST_F(Gather, V4l2CamerasByPath) {
  const Facts missing = with_usb_camera();
  EXPECT_EQ(missing.cameras.at(0).presence, Presence::Missing);
  EXPECT_EQ(missing.cameras.at(0).address, "/dev/v4l/by-id/usb-cam");
  tree.write("dev/v4l/by-id/usb-cam", "no device");
  const Facts wrong = with_usb_camera();
  EXPECT_EQ(wrong.cameras.at(0).presence, Presence::Missing);
  EXPECT_THAT(wrong.cameras.at(0).error, HasSubstr("is not a V4L2 device"));
}

hal::CameraEntry named(const std::string& id, const std::string& model) {
  hal::CameraEntry entry;
  entry.id = id;
  entry.model = model;
  return entry;
}

TEST_F(Gather, ModuleCameras) {
  module_cameras = fail("not installed");
  EXPECT_EQ(with_libcamera().cameras.at(0).presence, Presence::NoModule);
  EXPECT_EQ(with_libcamera().cameras.at(0).module, "libcamera");
  module_cameras = std::vector{named("/base/i2c@1/imx296@1a", "imx296"),
                               named("/base/i2c@2/imx219@10", "imx219")};
  EXPECT_EQ(with_libcamera().cameras.at(0).presence, Presence::There);
  const Facts missing = with_libcamera("imx708");
  EXPECT_EQ(missing.cameras.at(0).presence, Presence::Missing);
  EXPECT_THAT(missing.cameras.at(0).others, Contains("/base/i2c@1/imx296@1a"));
  EXPECT_THAT(with_libcamera("imx2").cameras.at(0).error, HasSubstr("several"));
  module_cameras->front().problem = "libcamera cannot start";
  EXPECT_THAT(with_libcamera("imx708").cameras.at(0).error, HasSubstr("cannot start"));
}

TEST_F(Gather, AVideoNeedsItsModule) {
  tree.write("run.mp4", "");
  tree.write("still.png", "");
  const auto camera = [this](const std::string& file) {
    return of("back_end = \"replay\"\n[camera.replay]\nsource = \"" + (tree / file).string() +
              "\"\n")
        .cameras.at(0);
  };
  EXPECT_EQ(camera("run.mp4").presence, Presence::There);
  video_module = fail("not installed");
  EXPECT_EQ(camera("run.mp4").presence, Presence::NoModule);
  EXPECT_EQ(camera("run.mp4").module, "video");
  EXPECT_EQ(camera("still.png").presence, Presence::There);
}

TEST_F(Gather, GenicamCamerasByAnyOfTheirNames) {
  const auto presence = [this](const std::string& name) {
    return of("back_end = \"genicam\"\n[camera.genicam]\ncamera = \"" + name + "\"\n")
        .cameras.at(0)
        .presence;
  };
  hal::CameraEntry camera = named("Maker-Thermal-24512", "Thermal");
  camera.paths = {"24512", "192.168.7.20", "left"};
  // This is the state while orbwatchd controls it.
  camera.problem = "is under the control of another host or program";
  module_cameras = std::vector{camera};
  for (const char* name : {"Maker-Thermal-24512", "24512", "192.168.7.20", "left"}) {
    EXPECT_EQ(presence(name), Presence::There) << name;
  }
  EXPECT_EQ(presence("245"), Presence::Missing);
}

TEST_F(Gather, HeapsBatteryClockAndWatchdog) {
  const Facts without = with_usb_camera();
  EXPECT_THAT(without.heaps, IsEmpty());
  EXPECT_FALSE(without.has_battery_clock);
  EXPECT_FALSE(without.watchdog.is_there);
  tree.write("dev/dma_heap/system", "");
  tree.write("dev/dma_heap/linux,cma", "");
  tree.write("dev/rtc0", "");
  tree.write("dev/watchdog", "");
  tree.write("sys/class/watchdog/watchdog0/state", "active\n");
  const Facts facts = with_usb_camera();
  ASSERT_EQ(facts.heaps.size(), 2U);
  EXPECT_EQ(facts.heaps.front().path, "/dev/dma_heap/linux,cma");
  EXPECT_EQ(facts.heaps.front().error, "");
  EXPECT_TRUE(facts.has_battery_clock);
  EXPECT_TRUE(facts.watchdog.is_there);
  EXPECT_EQ(facts.watchdog.state, "active");
}

TEST_F(Gather, ChipsAreReadForLinesOnly) {
  int asked = 0;
  sources.chips = [&asked] {
    ++asked;
    return std::vector<hal::ChipInfo>{{.path = "/dev/gpiochip0", .label = "chip"}};
  };
  with_usb_camera();
  EXPECT_EQ(asked, 0);
  const Facts facts =
      with_usb_camera("[[line]]\nname = \"ok\"\nuse = \"process_ok\"\nline_name = \"GPIO17\"\n");
  EXPECT_EQ(asked, 1) << facts.configuration.error;
  EXPECT_EQ(facts.chips.size(), 1U);
}

TEST_F(Gather, LimitsOfTheServiceOrOfThisProgram) {
  process("self", "orbwatch", 5);
  const Facts service = with_usb_camera();
  EXPECT_TRUE(service.limits.of_service);
  EXPECT_EQ(service.limits.realtime_priority, 48U);
  EXPECT_EQ(service.limits.locked_memory, std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(service.limits.realtime_runtime, 950000);
  EXPECT_FALSE(service.limits.may_set_priority);
  tree.remove("proc/7");
  tree.write("proc/self/status", "CapEff:\t000001ffffffffff\n");
  const Facts own = with_usb_camera();
  EXPECT_FALSE(own.limits.of_service);
  EXPECT_EQ(own.limits.realtime_priority, 5U);
  EXPECT_TRUE(own.limits.may_set_priority);
  EXPECT_TRUE(own.limits.may_lock_memory);
}

TEST_F(Gather, CoresThatAreNotThere) {
  EXPECT_THAT(with_usb_camera("[threads]\ncores = [1023]\n").limits.cores_error,
              HasSubstr("no core 1023"));
}

TEST_F(Gather, Network) {
  const Facts facts = with_usb_camera();
  EXPECT_EQ(facts.network.largest_receive_buffer, 212992);
  EXPECT_EQ(facts.network.first_free_port, 1024);
  EXPECT_FALSE(facts.network.has_unit);
  EXPECT_THAT(facts.ports, IsEmpty()) << "port 0 is any free one";
  tree.write("usr/lib/sysctl.d/60-orbwatch-dds.conf", "");
  tree.write("lib/systemd/system/orbwatch.service", "");
  const Facts installed = with_usb_camera();
  EXPECT_TRUE(installed.network.has_sysctl_file);
  EXPECT_TRUE(installed.network.has_unit);
}

TEST_F(Gather, APortThatIsTakenAndByWhom) {
  const hal::FileDescriptor socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t length = sizeof(address);
  auto* const any = reinterpret_cast<sockaddr*>(&address);
  ASSERT_EQ(::bind(socket.get(), any, length), 0);
  ASSERT_EQ(::listen(socket.get(), 1), 0);
  ASSERT_EQ(::getsockname(socket.get(), any, &length), 0);
  const std::string web =
      "[web]\nenabled = true\nport = " + std::to_string(ntohs(address.sin_port)) + "\n";
  const Facts facts = with_usb_camera(web);
  ASSERT_EQ(facts.ports.size(), 1U) << facts.configuration.error;
  EXPECT_EQ(facts.ports.front().error, EADDRINUSE);
  EXPECT_EQ(facts.ports.front().holder, "") << "not in this tree";
  EXPECT_TRUE(facts.ports.front().service_runs);
  std::ostringstream row;
  row << "0: 0100007F:" << std::hex << ntohs(address.sin_port) << " 0:0 0A 0:0 00:0 0 0 0 42 1\n";
  tree.write("proc/net/tcp", row.str());
  tree.link("proc/7/fd/5", "socket:[42]");
  const auto port = [&](const std::string& arguments) {
    tree.write("proc/7/cmdline", arguments);
    return with_usb_camera(web).ports.at(0);
  };
  tree.link("same.toml", tree / "site/site.toml");
  const std::string option("orbwatchd\0--config\0", 19);
  EXPECT_EQ(port("orbwatchd").holder, "orbwatchd");
  EXPECT_EQ(port("orbwatchd").other_configuration, "") << "its environment cannot be read";
  EXPECT_EQ(port(option + (tree / "same.toml").string()).other_configuration, "");
  EXPECT_EQ(port(option + "/etc/orbwatch/two.toml").other_configuration, "/etc/orbwatch/two.toml");
}

TEST_F(Gather, WhoListens) {
  const std::string head = "  sl  local_address rem_address   st tx_queue rx_queue tr tm->when\n";
  tree.write("proc/net/tcp", head + "   0: 0100007F:05DE 00000000:0000 01 0:0 00:0 0 0 0 41 1\n" +
                                 "   1: 00000000:05DE 00000000:0000 0A 0:0 00:0 0 0 0 42 1\n");
  tree.write("proc/net/tcp6", head +
                                  "   0: 00000000000000000000000000000000:1F90 "
                                  "00000000000000000000000000000000:0000 0A 0:0 00:0 0 0 0 43 1\n");
  process("8", "other", 0);
  process("9", "web", 0);
  tree.link("proc/8/fd/3", "socket:[41]");
  tree.link("proc/7/fd/5", "socket:[42]");
  tree.link("proc/9/fd/0", "socket:[43]");
  const auto service = listener_on(tree / "proc", 1502);
  ASSERT_TRUE(service);
  EXPECT_EQ(service->name, "orbwatchd");
  EXPECT_EQ(service->process, tree / "proc/7");
  EXPECT_EQ(listener_on(tree / "proc", 8080).value_or(Listener{}).name, "web");
  EXPECT_FALSE(listener_on(tree / "proc", 502));
  tree.remove("proc/7/fd");
  EXPECT_FALSE(listener_on(tree / "proc", 1502)) << "not this user's to see";
}

/// Text of procfs: each word ends with a NUL.
std::string with_nuls(std::string words) {
  std::ranges::replace(words, ' ', '\0');
  return words + '\0';
}

TEST_F(Gather, ConfigurationOfAnOrbwatchd) {
  const auto process = tree / "proc/7";
  EXPECT_FALSE(configuration_of(process));
  tree.write("proc/7/cmdline", with_nuls("/usr/sbin/orbwatchd"));
  EXPECT_FALSE(configuration_of(process)) << "the environment cannot be read";
  tree.write("proc/7/environ", with_nuls("LANG=C"));
  EXPECT_EQ(configuration_of(process), "/etc/orbwatch/site.toml");
  tree.write("proc/7/environ", with_nuls("LANG=C ORBWATCH_CONFIG=/etc/orbwatch/two/site.toml"));
  EXPECT_EQ(configuration_of(process), "/etc/orbwatch/two/site.toml");
  tree.write("proc/7/cmdline", with_nuls("orbwatchd --config=/a.toml"));
  EXPECT_EQ(configuration_of(process), "/a.toml");
  tree.write("proc/7/cmdline", with_nuls("orbwatchd --config b.toml"));
  EXPECT_FALSE(configuration_of(process)) << "its working folder is unknown";
  tree.link("proc/7/cwd", "/srv");
  EXPECT_EQ(configuration_of(process), "/srv/b.toml");
}

TEST_F(Gather, ASerialLine) {
  const std::string rtu = "[modbus.serial]\ndevice = \"/dev/ttyUSB7\"\n";
  EXPECT_EQ(with_usb_camera(rtu).missing_serial_line, "/dev/ttyUSB7");
  tree.write("dev/ttyUSB7", "");
  EXPECT_FALSE(with_usb_camera(rtu).missing_serial_line);
}

TEST_F(Gather, FoldersByTheNearestOneThatIsThere) {
  const Facts facts = with_usb_camera("[snapshot]\nfolder = \"/data/pictures\"\n");
  ASSERT_EQ(facts.folders.size(), 2U) << facts.configuration.error;
  EXPECT_EQ(facts.folders[0].path, "/var/lib/state/deep");
  EXPECT_TRUE(facts.folders[0].free && facts.folders[0].free_share);
  EXPECT_EQ(facts.folders[1].use, "snapshots");
  EXPECT_FALSE(facts.folders[1].read_only);
}

/// Writes a program of the synthetic board.
void write_program(MadeUpTree& tree, const std::string& name, const std::string& script) {
  tree.write(name, "#!/bin/sh\n" + script + "\n");
  ASSERT_EQ(::chmod((tree / name).c_str(), 0700), 0);
}

TEST_F(Gather, FoldersThatTheServiceCanWrite) {
  write_program(
      tree, "usr/bin/systemctl",
      "cat <<END\nId=orbwatch@site.service\nEnvironment=ORBWATCH_CONFIG=/etc/site.toml\n\n"
      "Id=orbwatch.service\nMainPID=7\nEnvironment=LANG=C ORBWATCH_CONFIG=" +
          (tree / "site/site.toml").string() +
          "\nProtectSystem=strict\nReadWritePaths=-/etc/orbwatch -/mnt/ssd\n"
          "StateDirectory=state\nConfigurationDirectory=orbwatch\nEND");
  Facts facts;
  const auto access = [&] {
    facts = with_usb_camera(
        "[snapshot]\nfolder = \"/mnt/ssd/pictures\"\n[recorder]\nfolder = \"/mnt/disk/events\"\n");
    std::vector<Access> found;
    for (const FolderFacts& folder : facts.folders) found.push_back(folder.access);
    return found;
  };
  EXPECT_THAT(access(), ElementsAre(Access::Unknown, Access::Unknown, Access::ReadOnly));
  EXPECT_EQ(facts.folders.back().use, "recordings") << facts.configuration.error;
  EXPECT_EQ(facts.folders.back().unit, "orbwatch");
  tree.link("proc/7/root", "/");  // From here on this user may see the service's mounts.
  EXPECT_THAT(access(), ElementsAre(Access::Write, Access::Write, Access::Write));
  tree.write("proc/7/status", "Uid:\t4000000000\nGid:\t4000000000\nGroups:\t4000000001 \n");
  tree.make_folder("mnt/disk/events");
  std::filesystem::permissions(tree / "mnt/disk/events", std::filesystem::perms::all);
  EXPECT_THAT(access(), ElementsAre(Access::Denied, Access::Denied, Access::Write));
}

TEST_F(Gather, WhatProgramsSay) {
  write_program(tree, "usr/bin/systemctl", "echo RuntimeWatchdogUSec=14s");
  write_program(tree, "usr/sbin/nft", R"(echo '{"nftables": []}')");
  const Facts facts = with_usb_camera();
  EXPECT_EQ(facts.watchdog.systemd_timeout, 14);
  EXPECT_TRUE(facts.firewall.has_nft);
  EXPECT_EQ(facts.firewall.ruleset, "{\"nftables\": []}\n");
  write_program(tree, "usr/bin/systemctl", "echo no bus >&2; exit 1");
  write_program(tree, "usr/sbin/nft", "exit 1");
  tree.write("proc/net/ip_tables_names", "filter\n");
  const Facts failing = with_usb_camera();
  EXPECT_FALSE(failing.watchdog.systemd_timeout);
  EXPECT_FALSE(failing.firewall.ruleset);
  EXPECT_TRUE(failing.firewall.has_iptables);
}

TEST(TimeSpan, IsAsSystemdPrintsIt) {
  EXPECT_EQ(parse_time_span("14s\n"), 14);
  EXPECT_EQ(parse_time_span("1min 30s"), 90);
  EXPECT_EQ(parse_time_span("500ms"), 0.5);
  EXPECT_EQ(parse_time_span("1h"), 3600);
  EXPECT_EQ(parse_time_span("0"), 0);
  EXPECT_EQ(parse_time_span("infinity"), std::numeric_limits<double>::infinity());
  for (const char* text : {"", "\n", "s", "14", "14 s", "14parsecs", "-3s", "1min x", "nan"}) {
    EXPECT_FALSE(parse_time_span(text)) << text;
  }
}

/// Any contents and kinds of files must give a diagnosis with valid JSON.
TEST_F(Gather, BearsHostileContents) {
  write_program(tree, "usr/bin/systemctl", "head -c 3000 /dev/urandom");
  write_program(tree, "usr/sbin/nft", "head -c 3000 /dev/urandom");
  tree.write("proc/net/tcp", "");
  tree.write("sys/class/thermal/thermal_zone0/temp", "48000\n");
  tree.write("sys/class/watchdog/watchdog0/state", "active\n");
  tree.link("proc/8/fd/3", "socket:[41]");
  with_libcamera();
  std::vector<std::filesystem::path> files;
  for (const char* folder : {"proc", "sys", "lib"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(tree / folder)) {
      if (entry.is_regular_file()) files.push_back(entry.path().lexically_relative(tree.path()));
    }
  }
  std::mt19937 random(11);
  const std::vector<std::string> words{
      "\n", "\t",   "-1",        "../..",       "9223372036854775807", "0A",
      ":",  "\xff", "unlimited", "kernel/a.ko", std::string(1, '\0')};
  for (int i = 0; i < 30; ++i) {
    for (const auto& file : files) {
      std::string text;
      for (unsigned count = random() % 200; count > 0; --count) {
        text += words[random() % words.size()];
        if (random() % 3 == 0) text += ' ';
      }
      tree.write(file.string(), text);
    }
    const Diagnoses found = diagnose(gather(sources, tree / "site/site.toml"));
    EXPECT_FALSE(found.empty());
    EXPECT_FALSE(doctor_json(found).empty());
  }
}

/// Pipes without a writer, loops of links, folders in place of files.
TEST_F(Gather, WaitsForNoFileThatNeverEnds) {
  with_libcamera();
  const auto replace = [&](const std::string& name) {
    tree.remove(name);
    std::filesystem::create_directories((tree / name).parent_path());
    ASSERT_EQ(::mkfifo((tree / name).c_str(), 0600), 0) << name;
  };
  for (const char* name :
       {"proc/device-tree/model", "proc/sys/kernel/osrelease", "proc/net/tcp", "proc/7/comm",
        "proc/7/limits", "sys/class/watchdog/watchdog0/state", "dev/dma_heap/system",
        "dev/watchdog", "dev/rtc0", "dev/v4l/by-id/usb-cam", "dev/video0"}) {
    replace(name);
  }
  tree.link("sys/class/thermal", tree / "sys/class/thermal");
  tree.remove("proc/sys/net/core/rmem_max");
  tree.make_folder("proc/sys/net/core/rmem_max");
  EXPECT_FALSE(diagnose(gather(sources, tree / "site/site.toml")).empty());
  EXPECT_FALSE(diagnose(with_usb_camera()).empty());
  sources.boards = tree / "boards";
  replace("boards/a.toml");
  EXPECT_FALSE(diagnose(with_usb_camera()).empty());
}

}  // namespace
}  // namespace orbwatch::app::cli::doctor

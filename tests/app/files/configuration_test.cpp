// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "app/files/recipe/recipe_file.h"
#include "app/files/rig/rig_file.h"
#include "tests/app/files/machine_files.h"
#include "tests/app/files/refusal.h"

namespace orbwatch::app::files {
namespace {

TEST_F(ConfigurationFile, IsReadAndTheRestIsByDefault) {
  const auto c = parse(kValid);
  ASSERT_TRUE(c) << c.error().message;
  const auto& replay = std::get<hal::ReplaySettings>(c->site.cameras[0].back_end);
  EXPECT_EQ(replay.source, folder / "pictures") << "from the file's folder";
  ASSERT_EQ(c->rig.cameras.size(), 2u) << "it may have more cameras than the configuration";
  EXPECT_EQ(c->rig.cameras[0].alpha, 340);
  EXPECT_EQ(c->site.views[0].kind, optics::ViewKind::Perspective);
  EXPECT_EQ(c->site.views[0].sources[0].weight, 1);
  EXPECT_EQ(std::get<ModbusSettings>(c->site.sinks).port, 1502);
  EXPECT_TRUE(c->recipes.empty());
}

TEST_F(ConfigurationFile, SaysWhoIsServedOverModbus) {
  const auto c = parse(kValid + R"([modbus]
readers = ["10.0.0.0/24", "fd00::/8"]
writers = ["10.0.0.7"]
unit_ids = [7]
[modbus.serial]
device = "/dev/ttyS0"
baud_rate = 9600
parity = "none"
stop_bits = 2
unit_id = 17
may_write = false
)");
  ASSERT_TRUE(c) << c.error().message;
  const auto& modbus = std::get<ModbusSettings>(c->site.sinks);
  EXPECT_EQ(modbus.readers.size(), 2u);
  EXPECT_EQ(modbus.writers.size(), 1u);
  EXPECT_EQ(modbus.unit_ids, std::vector{7});
  ASSERT_TRUE(modbus.serial);
  EXPECT_EQ(modbus.serial->baud_rate, 9600);
  EXPECT_EQ(modbus.serial->parity, Parity::None);
  EXPECT_EQ(modbus.serial->stop_bits, 2);
  EXPECT_EQ(modbus.serial->unit_id, 17);
  EXPECT_FALSE(modbus.serial->may_write);
}

TEST_F(ConfigurationFile, SaysWhereThePageIsServed) {
  const auto web_of = [&](const std::string& more) {
    const auto c = parse(kValid + "[web]\nenabled = true\n" + more);
    EXPECT_TRUE(c) << c.error().message;
    return c ? std::get<WebSettings>(c->site.sinks) : WebSettings{};
  };
  EXPECT_EQ(https_port_of(web_of("")), std::nullopt) << "on this computer only";
  EXPECT_EQ(https_port_of(web_of("https_port = 443\n")), 443);
  EXPECT_EQ(https_port_of(web_of("address = \"0.0.0.0\"\n")), 8443);
  EXPECT_EQ(https_port_of(web_of("address = \"::\"\nport = 80\nhttps_port = 443\n")), 443);
  const WebSettings own = web_of("certificate = \"own.pem\"\nkey = \"own.key\"\n");
  EXPECT_EQ(own.certificate, folder / "own.pem") << "from the file's folder";
  EXPECT_EQ(https_port_of(own), 8443);
}

TEST_F(ConfigurationFile, AnEmptyPathNamesNothing) {
  const auto c = parse("state_folder = \"\"\n" + kValid +
                       "[simulation]\nconnected = \"\"\n[recorder]\nfolder = \"\"\n"
                       "[snapshot]\nfolder = \"\"\n[dds]\nprofile = \"\"\n"
                       "[web]\ncertificate = \"\"\nkey = \"\"\n");
  ASSERT_TRUE(c) << c.error().message;
  const auto& web = std::get<WebSettings>(c->site.sinks);
  for (const std::filesystem::path& path :
       {c->site.state_folder, c->site.simulation.connected,
        std::get<RecorderSettings>(c->site.sinks).folder,
        std::get<SnapshotSettings>(c->site.sinks).folder,
        std::get<DdsSettings>(c->site.sinks).profile, web.certificate, web.key}) {
    EXPECT_EQ(path, "");
  }
}

TEST_F(ConfigurationFile, MayRepeatTheSizeThatTheRigStates) {
  const auto c = parse(replaced("name = \"a\"", "name = \"a\"\nwidth = 100\nheight = 80"));
  ASSERT_TRUE(c) << c.error().message;
  EXPECT_EQ(c->site.cameras[0].stream.height, 80);
}

const std::string kV4l2 = replaced("back_end = \"replay\"\n[camera.replay]\nsource = \"pictures\"",
                                   "back_end = \"v4l2\"\n[camera.v4l2]\ndevice = \"usb-1\"\n");

TEST_F(ConfigurationFile, SaysWhatACameraIsSetTo) {
  const auto c = parse(replaced("\"usb-1\"", R"("usb-1"
pixel_format = "rggb10p"
colour = false
[[camera.control]]
name = "ExposureAuto"
value = 1
[[camera.control]]
name = "ExposureTime"
value = 8000)",
                                kV4l2));
  ASSERT_TRUE(c) << c.error().message;
  const auto& part = std::get<hal::V4l2Settings>(c->site.cameras[0].back_end);
  EXPECT_EQ(part.device, "usb-1");
  EXPECT_EQ(part.pixel_format, "rggb10p");
  EXPECT_FALSE(part.colour);
  const auto& controls = c->site.cameras[0].controls;
  ASSERT_EQ(controls.size(), 2U);
  EXPECT_EQ(controls[0].name, "ExposureAuto");
  EXPECT_EQ(controls[1].value, 8000);
}

TEST_F(ConfigurationFile, SaysWhichRowsOfAFrameAreThePicture) {
  const auto c = parse(replaced("\"usb-1\"", "\"usb-1\"\nframe_height = 160\nfirst_row = 80",
                                replaced("name = \"a\"",
                                         "name = \"a\"\nheight = 80\nkelvin_per_count = 0.1\n"
                                         "kelvin_offset = 273.15",
                                         kV4l2)));
  ASSERT_TRUE(c) << c.error().message;
  const auto& part = std::get<hal::V4l2Settings>(c->site.cameras[0].back_end);
  EXPECT_EQ(part.frame_height, 160);
  EXPECT_EQ(part.first_row, 80);
  EXPECT_EQ(c->site.cameras[0].radiometry.kelvin_offset, 273.15);
}

std::string triggered(const std::string& keys, const std::string& lines = kLines) {
  return replaced("name = \"a\"", "name = \"a\"\n" + keys) + lines;
}

TEST_F(ConfigurationFile, HasLinesAndTriggers) {
  const auto c =
      parse(triggered("trigger_mode = \"line\"\ntrigger_source = \"start\"\n"
                      "trigger_activation = \"any_edge\""));
  ASSERT_TRUE(c) << c.error().message;
  ASSERT_EQ(c->site.lines.size(), 2U);
  EXPECT_EQ(c->site.lines[0].use, LineUse::TriggerIn);
  EXPECT_EQ(c->site.lines[0].wire.debounce, std::chrono::microseconds(50));
  EXPECT_EQ(c->site.lines[1].wire.address.offset, 4u);
  EXPECT_EQ(c->site.lines[1].source, "start");
  EXPECT_EQ(c->site.cameras[0].trigger.mode, hal::TriggerMode::Line);
  EXPECT_EQ(c->site.cameras[0].trigger.activation, hal::TriggerActivation::AnyEdge);
}

TEST_F(ConfigurationFile, ACameraMayBeTriggeredByCommandsOnly) {
  const auto c = parse(triggered("trigger_mode = \"software\"\ntrigger_source = \"software\"", ""));
  ASSERT_TRUE(c) << c.error().message;
  EXPECT_EQ(c->site.cameras[0].trigger_source, kSoftwareSource);
}

/// Configuration of two triggered cameras, with the trigger keys of each.
std::string both_triggered(const std::string& first, const std::string& second) {
  const std::string other =
      "[[line]]\nname = \"layer\"\nuse = \"trigger_in\"\nline_name = \"LAYER\"\n";
  return triggered("trigger_mode = \"line\"\n" + first) + other +
         "[[camera]]\nname = \"spare\"\nback_end = \"replay\"\ntrigger_mode = \"line\"\n" + second +
         "\n[camera.replay]\nsource = \"pictures\"\n";
}

const std::string kByStart = "trigger_source = \"start\"";

TEST_F(ConfigurationFile, SeveralCamerasMayHaveTheSameTriggers) {
  const std::string keys = kByStart + "\ntrigger_activation = \"falling_edge\"";
  const auto c = parse(both_triggered(keys, keys + "\ntrigger_delay_us = 100"));
  ASSERT_TRUE(c) << c.error().message;
  EXPECT_EQ(c->site.cameras[1].trigger_source, "start");
}

TEST_F(ConfigurationFile, AddressesMayNameAnInterfaceThatIsPluggedInLater) {
  const auto c = parse(
      kValid + "[modbus]\naddress = \"fe80::1%none0\"\n[web]\naddress = " + "\"fe80::1%none0\"\n");
  ASSERT_TRUE(c) << c.error().message;
}

TEST_F(ConfigurationFile, AServerThatIsOffMayHaveAnyAddress) {
  const auto c = parse(kValid + "[modbus]\nenabled = false\naddress = \"localhost\"\n");
  ASSERT_TRUE(c) << c.error().message;
}

class ConfigurationRefusal : public ConfigurationFile,
                             public testing::WithParamInterface<Refusal> {};

TEST_P(ConfigurationRefusal, SaysFileLineKeyAndWhatIsAllowed) {
  const auto c = parse(GetParam().text);
  ASSERT_FALSE(c);
  expect_said(GetParam(), c.error());
}

INSTANTIATE_TEST_SUITE_P(
    All, ConfigurationRefusal,
    testing::Values(
        Refusal{"TriggerWithoutSource",
                triggered("trigger_mode = \"line\""),
                {"camera.trigger_mode", "trigger_source"}},
        Refusal{"TriggerFromAnOutput",
                triggered("trigger_mode = \"line\"\ntrigger_source = \"flash\""),
                {"camera.trigger_source", "\"flash\"", "trigger_in", "start, flash"}},
        Refusal{"TriggersFromTwoLines",
                both_triggered(kByStart, "trigger_source = \"layer\""),
                {"site.toml:34:", "camera.trigger_source", "\"layer\", but camera \"a\"",
                 "\"start\"", "must be the same"}},
        Refusal{"TriggersFromALineAndFromCommands",
                both_triggered(kByStart, "trigger_source = \"software\""),
                {"camera.trigger_source", "\"software\", but camera \"a\"", "\"start\""}},
        Refusal{"TriggersAtTwoActivations",
                both_triggered(kByStart, kByStart + "\ntrigger_activation = \"any_edge\""),
                {"camera.trigger_activation", "\"any_edge\", but camera \"a\"", "\"rising_edge\"",
                 "must be the same"}},
        Refusal{"StrobeWithoutSource",
                triggered("", replaced("source = \"start\"", "", kLines)),
                {"line.source", "strobe"}},
        Refusal{"StrobeAtARate",
                triggered("", replaced("source = \"start\"", "rate = 5", kLines)),
                {"line.rate", "trigger_out"}},
        Refusal{"LineTwice",
                triggered("", replaced("\"flash\"", "\"start\"", kLines)),
                {"line.name", "there twice"}},
        Refusal{"LineWithoutAddress",
                triggered("", replaced("chip = \"pinctrl\"", "", kLines)),
                {"line.line_name", "chip and offset"}},
        Refusal{"DebouncedOutput",
                triggered("", replaced("width_us = 200", "debounce_us = 200", kLines)),
                {"line.debounce_us", "inputs"}},
        Refusal{"PulseLongerThanThePeriod",
                triggered("", kLines + "[[line]]\nname = \"out\"\nuse = \"trigger_out\"\n"
                                       "line_name = \"OUT\"\nrate = 100\nwidth_us = 10000\n"),
                {"line.width_us", "period"}},
        Refusal{"ModbusOnAName",
                kValid + "[modbus]\naddress = \"localhost\"\n",
                {"site.toml:16: modbus.address", "not a numeric address", "0.0.0.0"}},
        Refusal{"PageOnAName",
                kValid + "[web]\naddress = \"ball.example\"\n",
                {"web.address", "not a numeric address", "0.0.0.0"}},
        Refusal{"CertificateWithoutKey",
                kValid + "[web]\ncertificate = \"own.pem\"\n",
                {"web.certificate", "or neither", "`key`"}},
        Refusal{"HttpsOnThePortOfHttp",
                kValid + "[web]\nport = 8443\naddress = \"0.0.0.0\"\n",
                {"web", "the HTTP port"}},
        Refusal{"ProxyThatIsAName",
                kValid + "[web]\ntrusted_proxies = ['10.0.0.7', 'proxy.example']\n",
                {"web.trusted_proxies", "'proxy.example'", "10.0.0.0/24"}},
        Refusal{"ProxyThatIsEverybody",
                kValid + "[web]\ntrusted_proxies = ['0.0.0.0/0']\n",
                {"web.trusted_proxies", "'0.0.0.0/0' is every address", "10.0.0.7"}},
        Refusal{"UnknownKey",
                replaced("width = 64", "width = 64\nwidht = 3"),
                {"site.toml:12:", "view.widht", "width"}},
        Refusal{"UnknownTable", kValid + "[bogus]\n", {"site.toml:15:", "bogus", "modbus"}},
        Refusal{"WrongType",
                replaced("width = 64", "width = 64\nyaw = \"left\""),
                {"site.toml:12:", "view.yaw", "any number"}},
        Refusal{"OutOfRange",
                replaced("width = 64", "width = 64\nh_fov = 0"),
                {"site.toml:12:", "view.h_fov", "above 0, at most 360"}},
        Refusal{"NotANumber",
                replaced("width = 64", "width = 64\nyaw = nan"),
                {"site.toml:12:", "view.yaw", "nan"}},
        Refusal{"Infinite",
                replaced("width = 64", "width = 64\nyaw = -inf"),
                {"site.toml:12:", "view.yaw", "-inf"}},
        Refusal{"FractionForWhole",
                replaced("width = 64", "width = 64.5"),
                {"view.width", "whole number, 1 to 16384"}},
        Refusal{"HugeSize", replaced("width = 64", "width = 16385"), {"view.width", "16384"}},
        Refusal{"ListTooShort",
                replaced("camera = \"a\"", "camera = \"a\"\nrange = [9]"),
                {"site.toml:15:", "view.source.range", "2 numbers"}},
        Refusal{
            "RigNotNamed", replaced("rig = \"rig.toml\"\n", ""), {"site.toml:1: rig: is missing"}},
        Refusal{"RigFileMissing",
                replaced("rig.toml", "nowhere.toml"),
                {"site.toml:2: rig: ", "/nowhere.toml: cannot be read"}},
        Refusal{"RigNamedByNothing",
                replaced("\"rig.toml\"", "\"\""),
                {"site.toml:2: rig: is empty; it must name a file"}},
        Refusal{"ReplayOfNothing",
                replaced("\"pictures\"", "\"\""),
                {"site.toml:5: camera.back_end", "source is empty", "it must name pictures"}},
        Refusal{"KeysInNoFolder",
                kValid + "[dds.security]\nfolder = \"\"\n",
                {"site.toml:16: dds.security.folder: is empty", "keys/enclaves/appliance"}},
        Refusal{"RigBroken",
                replaced("rig.toml", "broken.toml"),
                {"site.toml:2: rig: ", "/broken.toml:9: camera.outline.alpha: ", "above 180"}},
        Refusal{"RigIsNoFile", replaced("\"rig.toml\"", "7"), {"site.toml:2: rig: "}},
        Refusal{"CameraNotInTheRig",
                replaced("name = \"a\"", "name = \"b\""),
                {"site.toml:3: camera.name: ", "no camera \"b\"", "it has: a, spare"}},
        Refusal{"WidthOfOtherPictures",
                replaced("name = \"a\"", "name = \"a\"\nwidth = 640"),
                {"site.toml:3: camera.width: 640", "the rig is for 100x80 pictures"}},
        Refusal{"HeightOfOtherPictures",
                replaced("name = \"a\"", "name = \"a\"\nwidth = 100\nheight = 81"),
                {"site.toml:3: camera.height: 81", "the rig is for 100x80 pictures"}},
        Refusal{"BallInTheConfiguration",
                replaced("[camera.replay]",
                         "[camera.ball]\ncentre = [50, 40]\nradius = 30\n[camera.replay]"),
                {"site.toml:6: camera.ball: is not a key"}},
        Refusal{"UnknownWord",
                replaced("\"replay\"", "\"webcam\""),
                {"site.toml:5:", "back_end", "webcam", "simulated, replay, v4l2"}},
        Refusal{"BackEndWithoutTable",
                replaced("\"replay\"", "\"v4l2\""),
                {"back_end", "[camera.v4l2]"}},
        Refusal{"UnknownPixelFormat",
                replaced("\"usb-1\"", "\"usb-1\"\npixel_format = \"h264\"", kV4l2),
                {"site.toml:8: camera.v4l2.pixel_format", "h264", "auto, yuyv, uyvy, nv12"}},
        Refusal{"RowsBeyondTheFrame",
                replaced("\"usb-1\"", "\"usb-1\"\nframe_height = 160\nfirst_row = 81",
                         replaced("name = \"a\"", "name = \"a\"\nheight = 80", kV4l2)),
                {"site.toml:5: camera.height", "must not exceed frame_height"}},
        Refusal{"RowWithoutAFrame",
                replaced("\"usb-1\"", "\"usb-1\"\nfirst_row = 80", kV4l2),
                {"site.toml:8: camera.v4l2.first_row", "needs a frame_height"}},
        Refusal{"NoSuchCamera",
                replaced("camera = \"a\"", "camera = \"b\""),
                {"site.toml:13:", "\"b\"", "there are: a"}},
        Refusal{"BadName", replaced("\"front\"", "\"front door\""), {"view.name", "front door"}},
        Refusal{"ReservedName", replaced("\"front\"", "\"selected\""), {"view.name", "selected"}},
        Refusal{
            "NoCamera", "rig = \"rig.toml\"\n[console]\nenabled = true\n", {"camera", "1 to 4"}},
        Refusal{
            "WideView",
            kValid +
                "[[view]]\nname='w'\nh_fov=200\nwidth=9\nheight=9\n[[view.source]]\ncamera='a'\n",
            {"site.toml:15:", "h_fov", "below 180"}},
        Refusal{"TwiceTheSameView",
                kValid + "[[view]]\nname='front'\nwidth=9\nheight=9\n[[view.source]]\ncamera='a'\n",
                {"site.toml:15:", "twice"}},
        Refusal{"RangeUpsideDown",
                replaced("camera = \"a\"", "camera = \"a\"\nrange = [9, 3]"),
                {"view.source.range", "below"}},
        Refusal{
            "PortOutOfRange", kValid + "[modbus]\nport = 70000\n", {"site.toml:16:", "0 to 65535"}},
        Refusal{"PrefixThatIsAMachine",
                kValid + "[modbus]\nreaders = ['10.0.0.0/24']\nwriters = ['10.0.0.7/24']\n",
                {"site.toml:17: modbus.writers", "'10.0.0.7/24'", "after its first 24"}},
        Refusal{"UnitOutOfRange",
                kValid + "[modbus]\nunit_ids = [1, 256]\n",
                {"site.toml:16:", "unit_ids", "0 to 255"}},
        Refusal{"NoUnit", kValid + "[modbus]\nunit_ids = []\n", {"site.toml:16:", "no request"}},
        Refusal{"SerialLineWithoutDevice",
                kValid + "[modbus.serial]\nunit_id = 2\n",
                {"site.toml:15:", "modbus.serial.device", "must be given"}},
        Refusal{"BaudRate",
                kValid + "[modbus.serial]\ndevice = '/dev/ttyS0'\nbaud_rate = 19201\n",
                {"site.toml:17: modbus.serial.baud_rate", "19200"}},
        Refusal{"ALineCalledSoftware",
                triggered("", replaced("\"flash\"", "\"software\"", kLines)),
                {"line.name", "\"software\""}},
        Refusal{"NotToml", "[[camera\n", {"site.toml:1:", "not valid TOML"}},
        Refusal{"NameOfATableThatIsNone", "[[$recipe]]\n", {"site.toml:1:", "not valid TOML"}},
        Refusal{
            "TableExpected", "rig = \"rig.toml\"\ncamera = 3\n", {"site.toml:2:", "[[camera]]"}}),
    [](const auto& refusal) { return refusal.param.name; });

TEST(Configuration, MissingFileIsRefusedByName) {
  const auto c = resolve("/nonexistent/site.toml");
  ASSERT_FALSE(c);
  EXPECT_NE(c.error().message.find("/nonexistent/site.toml"), std::string::npos);
}

const std::filesystem::path kShipped =
    std::filesystem::path(ORBWATCH_SOURCE_DIR) / "platform/config";

TEST(Configuration, ShippedFilesAreValidAndServeThePageToThisComputer) {
  int configurations = 0, rigs = 0, recipes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kShipped)) {
    if (entry.path().extension() != ".toml") continue;
    if (entry.path().stem().string().ends_with("-rig")) {
      const auto rig = load_rig(entry.path());
      EXPECT_TRUE(rig) << rig.error().message;
      ++rigs;
    } else if (entry.path().stem().string().ends_with("-recipe")) {
      TextFiles files;
      const auto recipe = load_recipe(entry.path(), files);
      EXPECT_TRUE(recipe) << recipe.error().message;
      ++recipes;
    } else {
      const auto c = resolve(entry.path());
      ASSERT_TRUE(c) << c.error().message;
      const auto& web = std::get<WebSettings>(c->site.sinks);
      EXPECT_TRUE(web.enabled) << entry.path() << " takes the page away from its users";
      EXPECT_EQ(http_addresses_of(web), std::vector<std::string>{"127.0.0.1"}) << entry.path();
      EXPECT_EQ(https_port_of(web), std::nullopt) << entry.path();
      ++configurations;
    }
  }
  EXPECT_GE(configurations, 2);
  EXPECT_GE(rigs, 2);
  EXPECT_GE(recipes, 2);
}

TEST(Configuration, SurvivesEveryTruncation) {
  // Any truncation must give a value or one line with the reason, never a crash.
  std::ifstream in(kShipped / "demo.toml");
  std::stringstream whole;
  whole << in.rdbuf();
  const std::string text = whole.str();
  for (std::size_t length = 0; length < text.size(); length += 7) {
    const auto c = resolve_text(text.substr(0, length), "site.toml", kShipped);
    if (!c) {
      EXPECT_EQ(c.error().message.find('\n'), std::string::npos) << c.error().message;
    }
  }
}

TEST(ConfigurationManual, IsWhatIsCommitted) {
  std::ifstream in(std::filesystem::path(ORBWATCH_SOURCE_DIR) / "app/files/MANUAL.md");
  std::stringstream committed;
  committed << in.rdbuf();
  EXPECT_EQ(committed.str(), configuration_manual())
      << "regenerate it: orbwatch describe config > app/files/MANUAL.md";
}

}  // namespace
}  // namespace orbwatch::app::files

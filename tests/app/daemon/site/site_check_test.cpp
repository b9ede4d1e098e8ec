// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/site/site_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <tuple>

#include "tests/app/daemon/demo_site.h"

namespace orbwatch::app::daemon {
namespace {

TEST(SiteCheck, WhatIsShippedCanRunAndTheReferenceMachine) {
  for (const char* file : {"demo.toml", "usb-camera.toml", "gige-camera.toml",
                           "../../tests/bench/reference/site.toml"}) {
    const auto checked =
        files::resolve(kShippedFolder / file).and_then([](const files::Resolved& site) {
          return check_site(site, Dates::Checked);
        });
    EXPECT_TRUE(checked) << checked.error().message;
  }
}

/// What a change makes of the demonstration.
template <class Change>
std::string refusal(const Change& change) {
  files::Resolved site = demo();
  change(site);
  const auto checked = check_site(site, Dates::Checked);
  return checked ? "none" : checked.error().message;
}

TEST(SiteCheck, FindsRegionsOutsideOfTheirView) {
  const std::string said = refusal([](files::Resolved& site) {
    first(site).regions[0].points.clear();
    first(site).regions[0].directions = {{60, 40}, {70, 40}, {60, 50}};
  });
  EXPECT_NE(said.find("demo-recipe.toml: region pool: "), std::string::npos) << said;
  EXPECT_NE(said.find("no pixel"), std::string::npos) << said;
}

TEST(SiteCheck, FindsThresholdsThatNothingReaches) {
  const auto hotter_than_the_scale = [](files::Resolved& site) {
    first(site).regions[0].hot_spot_threshold = 9000;
  };
  EXPECT_THAT(refusal(hotter_than_the_scale),
              testing::HasSubstr("region pool: hot_spot_threshold is 9000.0 degC; the camera's "
                                 "counts end at "));
  const auto above_full_scale = [](files::Resolved& site) {
    site.site.cameras[kThermalCamera].radiometry.kelvin_per_count = 0;
    for (pipeline::RegionOfInterest& region : first(site).regions) region.alarms.clear();
    first(site).regions[1].spatter_threshold.reset();
    first(site).regions[0].plume_threshold.reset();
    first(site).regions[0].hot_spot_threshold = 101;
    first(site).regions[1].hot_spot_threshold = 99;
  };
  EXPECT_THAT(refusal(above_full_scale),
              testing::HasSubstr("region pool: hot_spot_threshold is 101.0; it must be above 0 and "
                                 "at most 100 percent"));
  EXPECT_EQ(refusal([&](files::Resolved& site) {
              above_full_scale(site);
              first(site).regions[0].hot_spot_threshold = 99;
            }),
            "none");
}

TEST(SiteCheck, FindsARingThatDoesNotHoldAnEvent) {
  const auto with_ring = [](int mebibytes) {
    return refusal([mebibytes](files::Resolved& site) {
      for (files::CameraSettings& camera : site.site.cameras) camera.stream.frame_rate = 30;
      auto& recorder = std::get<RecorderSettings>(site.site.sinks);
      recorder.folder = "recordings";
      recorder.events.emplace().ring_mib = mebibytes;
    });
  };
  EXPECT_THAT(with_ring(1), testing::HasSubstr("recorder.events.ring_mib is 1; before_s and "
                                               "after_s together need "));
  EXPECT_EQ(with_ring(4096), "none");
}

TEST(SiteCheck, FindsModbusAndThePageOnOnePort) {
  const auto on = [](int port, std::optional<int> https, const char* page, const char* plc) {
    return refusal([=](files::Resolved& site) {
      auto& web = std::get<WebSettings>(site.site.sinks);
      auto& modbus = std::get<ModbusSettings>(site.site.sinks);
      web.enabled = modbus.enabled = true;
      web.port = port;
      web.https_port = https;
      web.address = page;
      modbus.port = 1502;
      modbus.address = plc;
    });
  };
  EXPECT_EQ(on(8080, 8443, "0.0.0.0", "0.0.0.0"), "none");
  EXPECT_NE(on(1502, {}, "127.0.0.1", "0.0.0.0").find("[web] port and [modbus] port are both 1502"),
            std::string::npos);
  EXPECT_NE(on(8080, 1502, "10.0.0.5", "::").find("[web] https_port"), std::string::npos);
  EXPECT_EQ(on(1502, 8443, "127.0.0.1", "10.0.0.5"), "none") << "two networks";
  EXPECT_EQ(on(8080, 1502, "10.0.0.5", "10.1.0.5"), "none");
}

TEST(SiteCheck, FindsWhatDdsDoesNotStartWith) {
  const auto with = [](bool enabled, const char* prefix, const char* profile) {
    return refusal([=](files::Resolved& site) {
      auto& dds = std::get<DdsSettings>(site.site.sinks);
      dds.enabled = enabled;
      dds.prefix = prefix;
      dds.profile = profile;
    });
  };
  EXPECT_EQ(with(true, "plant/cell_7", ""), "none");
  for (const char* prefix : {"cell-7", "7a", "a//b", ""}) {
    EXPECT_THAT(with(true, prefix, ""),
                testing::AllOf(testing::HasSubstr("DDS: prefix \""),
                               testing::HasSubstr("it must be letters, digits and '_'")));
    EXPECT_EQ(with(false, prefix, ""), "none");
  }
  EXPECT_EQ(with(true, "orbwatch", "/nowhere/lan.xml"),
            "DDS profile /nowhere/lan.xml: no such file");
}

TEST(SiteCheck, FindsAMachineWhoseInterfaceIsNotEnabled) {
  const auto from = [](MachineSource source, bool enabled) {
    return refusal([=](files::Resolved& site) {
      site.site.machine.source = source;
      std::get<ModbusSettings>(site.site.sinks).enabled = enabled;
      std::get<DdsSettings>(site.site.sinks).enabled = enabled;
      std::get<WebSettings>(site.site.sinks).enabled = enabled;
    });
  };
  EXPECT_EQ(from(MachineSource::Modbus, false),
            "machine.source is modbus, but [modbus] is not enabled; set enabled = true in "
            "[modbus], or another source");
  EXPECT_THAT(from(MachineSource::Dds, false), testing::HasSubstr("dds, but [dds] is not"));
  EXPECT_THAT(from(MachineSource::Http, false), testing::HasSubstr("http, but [web] is not"));
  for (const auto source : {MachineSource::Modbus, MachineSource::Dds, MachineSource::Http}) {
    EXPECT_EQ(from(source, true), "none");
  }
  EXPECT_EQ(from(MachineSource::None, false), "none");
  EXPECT_EQ(from(MachineSource::Simulation, false), "none");
}

TEST(SiteCheck, FindsACameraThatIsUsedTwice) {
  const auto with = [](const files::BackEndSettings& colour,
                       const files::BackEndSettings& thermal) {
    return refusal([&](files::Resolved& site) {
      site.site.cameras[0].back_end = colour;
      site.site.cameras[kThermalCamera].back_end = thermal;
    });
  };
  const auto video = [](const char* device) { return hal::V4l2Settings::at(device); };
  EXPECT_EQ(with(video("/dev/video0"), video("/dev/video0")),
            "cameras colour and thermal are both /dev/video0; give each one of its own");
  EXPECT_EQ(with(video("/dev/video0"), video("/dev/video2")), "none");
  EXPECT_THAT(with(hal::GenicamSettings::at("10.0.0.9"), hal::GenicamSettings::at("10.0.0.9")),
              testing::HasSubstr("are both 10.0.0.9"));
  EXPECT_EQ(with(hal::LibcameraSettings::at(""), hal::LibcameraSettings::at("")), "none");
  EXPECT_EQ(with(hal::ReplaySettings::at("run.mcap"), hal::ReplaySettings::at("run.mcap")), "none");
}

TEST(SiteCheck, FindsALineThatIsUsedTwice) {
  const auto with = [](LineKind kind, const hal::LineAddress& first,
                       const hal::LineAddress& second) {
    return refusal([&](files::Resolved& site) {
      site.site.lines.resize(2);
      site.site.lines[0].name = "start";
      site.site.lines[1].name = "flash";
      site.site.lines[1].use = LineUse::TriggerOut;
      site.site.lines[0].wire.address = first;
      site.site.lines[1].wire.address = second;
      for (LineSettings& line : site.site.lines) line.back_end = kind;
    });
  };
  const hal::LineAddress four{.chip = "pinctrl", .offset = 4}, five{.chip = "pinctrl", .offset = 5};
  EXPECT_EQ(with(LineKind::Gpio, four, four),
            "lines start and flash are both pinctrl line 4; give each one of its own");
  EXPECT_EQ(with(LineKind::Gpio, {.name = "GPIO17"}, {.name = "GPIO17"}),
            "lines start and flash are both GPIO17; give each one of its own");
  EXPECT_EQ(with(LineKind::Gpio, four, five), "none");
  EXPECT_EQ(with(LineKind::Gpio, four, {.name = "GPIO17"}), "none");
  EXPECT_EQ(with(LineKind::Simulated, {.name = "WIRE"}, {.name = "WIRE"}), "none");
}

TEST(ListeningPorts, AreThoseOfAllEnabledInterfaces) {
  files::SinkSettings sinks;
  auto& web = std::get<WebSettings>(sinks);
  web.enabled = true;
  web.address = "10.0.0.5";
  std::string said;
  for (const ListeningPort& port : listening_ports(sinks)) {
    said += std::string(port.interface) + "." + std::string(port.key) + " " + port.address + ":" +
            std::to_string(port.port) + "\n";
  }
  EXPECT_EQ(said,
            "modbus.port 0.0.0.0:1502\n"
            "web.port 10.0.0.5:8080\n"
            "web.port 127.0.0.1:8080\n"
            "web.https_port 10.0.0.5:8443\n");
  std::get<ModbusSettings>(sinks).port = 0;
  web.enabled = false;
  EXPECT_TRUE(listening_ports(sinks).empty()) << "any free port";
}

TEST(SiteCheck, AnUnregisteredCameraDoesNotMeasure) {
  files::Resolved site = demo();
  site.rig.cameras[site.rig_cameras[kThermalCamera]].is_registered = false;
  const auto measuring = check_site(site, Dates::Ignored);
  ASSERT_FALSE(measuring);
  EXPECT_THAT(measuring.error().message, testing::AllOf(testing::HasSubstr("is not registered"),
                                                        testing::HasSubstr("orbwatch register")));
}

}  // namespace
}  // namespace orbwatch::app::daemon

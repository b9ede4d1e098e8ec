// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "tests/app/ports/modbus/map/registers.h"

namespace orbwatch::app::modbus {

/// All registers without mirrors, and their names; a "?" marks bits, because words may have the
/// same names.
struct Registers {
  std::vector<std::string> names;
  std::vector<const Row*> rows;

  Registers() {
    std::set<std::string> known;
    for (const Row& row : registers().rows()) {
      if (is_mirror(row) || !row.read) continue;
      rows.push_back(&row);
      names.push_back(row.name + (row.table == Table::Discrete ? "?" : ""));
      EXPECT_TRUE(known.insert(names.back()).second) << names.back();
    }
  }

  std::vector<std::uint32_t> contents(const ProcessImage& image) const {
    std::vector<std::uint32_t> codes;
    codes.reserve(rows.size());
    for (const Row* row : rows) codes.push_back(row->read(image));
    return codes;
  }
};

inline void measure_something(StampedStatus& stamped, double share) {
  stamped.utc = std::chrono::microseconds(1'700'000'000'000'100);
  Status& status = stamped.status;
  status.result = 3;
  status.frame_set = 30;
  status.trigger = 4;
  status.recipe = 2;
  status.configuration_checksum = 77;
  status.process_active = true;
  status.region_count = signals::kMaxRegions;
  for (RegionStatus& region : status.regions) {
    region.quality = Quality::Good;
    for (const auto& signal : signals::kSignals) {
      region.signals.*signal.member = signal.minimum + share * (signal.maximum - signal.minimum);
    }
    region.signals.hot_spot_present = 1;
  }
  MachineStatus& machine = status.machine;
  machine.quality = MachineQuality::Good;
  machine.part = *PartName::make(std::string(PartName::kMost, 'x'));
  for (const MachineValue& value : kMachineValues) {
    machine.values.*value.get = std::ceil(value.minimum + share * (value.maximum - value.minimum));
  }
  machine.vx = machine.vy = machine.vz = 10;
}

/// An image in which everything is present and works.
inline ProcessImage full_image() {
  ProcessImage image;
  image.now = hal::TimePoint{} + std::chrono::hours(100);
  image.server.uptime = 9 * 3600;
  measure_something(image.live, 0.5);
  measure_something(image.result, 0.25);
  for (StampedStatus* stamped : {&image.live, &image.result}) {
    stamped->status.machine.state = image.now - std::chrono::milliseconds(70);
  }
  image.results.count = 2;
  image.plc.heartbeat = image.now - std::chrono::milliseconds(20);
  Status& status = image.live.status;
  status.state = SystemState::Running;
  status.stamp = image.now - std::chrono::milliseconds(50);
  status.camera_count = kMaxCameras;
  status.view_count = kMaxViews;
  status.alarm_count = signals::kMaxAlarms;
  for (CameraStatus& camera : status.cameras)
    camera.last_frame = image.now - std::chrono::milliseconds(40);
  for (AlarmStatus& alarm : status.alarms) {
    alarm.value = 0;
    alarm.since = image.now - std::chrono::milliseconds(5000);
  }
  for (const HealthField& figure : kHealthFigures) {
    status.health.*figure.get = (figure.minimum + figure.maximum) / 2;
  }
  status.health.throttling = 0;
  status.health.clock_synchronised = status.health.commands_recorded = 1;
  return image;
}

}  // namespace orbwatch::app::modbus

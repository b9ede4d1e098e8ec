#pragma once

#include <gtest/gtest.h>

#include <tuple>

#include "app/pipeline/status_report.h"

/// Whether a status came through whole. Every member is named here, so that one that is added has
/// to be dealt with: else this does not compile. Moments are left out: they travel as StatusTimes.
namespace orbwatch::app::tests {

template <class Values, class Infos>
void expect_same_values(const Values& actual, const Values& expected, const Infos& infos) {
  for (const auto& info : infos) {
    EXPECT_EQ(actual.*info.member, expected.*info.member) << info.name;
  }
}

inline auto figures(const CameraStatus& camera) {
  const auto& [fault, frames, lost, dropped, unmatched, rate, p50, p99, triggers, missed, last] =
      camera;
  return std::tie(fault, frames, lost, dropped, unmatched, rate, p50, p99, triggers, missed);
}

inline auto figures(const ViewStatus& view) {
  const auto& [published, skipped, rate, p50, p99, superseded] = view;
  return std::tie(published, skipped, rate, p50, p99, superseded);
}

inline auto figures(const AlarmStatus& status) {
  const auto& [alarm, region, signal, value, since] = status;
  const auto& [state, level, announced, measurement_lost] = alarm;
  return std::tie(state, level, announced, measurement_lost, region, signal, value);
}

inline auto figures(const Status& status) {
  const auto& [state, heartbeat, frame_set, stamp, trigger, result, recipe, checksum, refused,
               active, overruns, unmatched, skew, load, inputs, selected, camera_count, view_count,
               cameras, region_count, alarm_count, views, alarms, health, regions] = status;
  return std::tie(state, heartbeat, frame_set, trigger, result, recipe, checksum, refused, active,
                  overruns, unmatched, skew, load, inputs, selected, camera_count, view_count,
                  region_count, alarm_count);
}

inline void expect_same(const Status& actual, const Status& expected) {
  ASSERT_EQ(figures(actual), figures(expected));
  for (std::size_t i = 0; i < expected.camera_count; ++i) {
    EXPECT_EQ(figures(actual.cameras[i]), figures(expected.cameras[i])) << "camera " << i;
  }
  for (std::size_t i = 0; i < expected.view_count; ++i) {
    EXPECT_EQ(figures(actual.views[i]), figures(expected.views[i])) << "view " << i;
  }
  for (std::size_t i = 0; i < expected.alarm_count; ++i) {
    EXPECT_EQ(figures(actual.alarms[i]), figures(expected.alarms[i])) << "alarm " << i;
  }
  for (std::size_t i = 0; i < expected.region_count; ++i) {
    const auto& [quality, signals] = actual.regions[i];
    EXPECT_EQ(quality, expected.regions[i].quality) << "region " << i;
    expect_same_values(signals, expected.regions[i].signals, signals::kSignals);
  }
  expect_same_values(actual.health, expected.health, kHealthFigures);
}

}  // namespace orbwatch::app::tests

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/files/camera_settings.h"
#include "hal/camera.h"

namespace orbwatch::tests {

/// Settings of the suite: see README.md.
struct ComplianceSettings {
  std::vector<app::files::CameraSettings> cameras;
  std::size_t most_frames = 89;
  bool counts_all = true;
  std::string unplug;
  std::string replug;
};

/// Camera that the suite is run on, one per process.
class CameraUnderTest {
 public:
  /// Reads the file of settings. The error states file, line and key.
  static Result<> load(const std::filesystem::path& file);
  static const CameraUnderTest& get();

  std::unique_ptr<hal::Camera> make() const { return make(settings_.cameras.front()); }
  hal::StreamRequest request() const { return request(settings_.cameras.front()); }

  bool has_another() const { return settings_.cameras.size() > 1; }
  std::unique_ptr<hal::Camera> make_another() const { return make(settings_.cameras.back()); }
  hal::StreamRequest another_request() const { return request(settings_.cameras.back()); }

  /// Returns `count`, or the largest number of frames that a case may use with this camera.
  std::size_t limited(std::size_t count) const { return std::min(count, settings_.most_frames); }

  /// True if the sequence counts frames for which there was no buffer.
  bool counts_all() const { return settings_.counts_all; }

  bool can_be_unplugged() const { return is_scripted() || !settings_.unplug.empty(); }
  /// Makes a camera that is unplugged and replugged after its first frames.
  std::unique_ptr<hal::Camera> make_unpluggable() const;
  void unplug() const;
  void replug() const;

 private:
  explicit CameraUnderTest(ComplianceSettings settings) : settings_(std::move(settings)) {}

  static std::unique_ptr<hal::Camera> make(const app::files::CameraSettings& settings);
  static hal::StreamRequest request(const app::files::CameraSettings& settings);
  /// True if its faults are scripted by exposure number.
  bool is_scripted() const;

  static std::optional<CameraUnderTest> instance_;
  ComplianceSettings settings_;
};

}  // namespace orbwatch::tests

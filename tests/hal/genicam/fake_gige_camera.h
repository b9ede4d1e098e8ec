// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <condition_variable>
#include <cstdint>
#include <fstream>
#include <functional>
#include <iterator>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hal/camera.h"
#include "hal/genicam/device/aravis.h"
#include "hal/genicam/device/gige_identity.h"
#include "hal/genicam/genicam_settings.h"
#include "proc/image/picture.h"
#include "tests/support/comes_true.h"
#include "tests/support/network_namespace.h"
#include "tests/support/reference_data.h"
#include "tests/support/subprocess.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::tests {

/// Description of Aravis' fake camera.
inline std::string standard_description() {
  // This call links the library that contains the resource.
  EXPECT_EQ(arv_get_major_version(), 0U);
  GBytes* const standard = g_resources_lookup_data("/org/aravis/arv-fake-camera.xml",
                                                   G_RESOURCE_LOOKUP_FLAGS_NONE, nullptr);
  std::size_t size = 0;
  const char* const characters = static_cast<const char*>(g_bytes_get_data(standard, &size));
  std::string text(characters, size);
  g_bytes_unref(standard);
  return text;
}

/// Description of Aravis' fake camera and the features of a thermal one.
inline std::string thermal_description() {
  std::string text = standard_description();
  std::ifstream file(std::string(ORBWATCH_SOURCE_DIR) + "/tests/hal/genicam/thermal_features.xml");
  const std::string features{std::istreambuf_iterator<char>(file), {}};
  const std::string root = "<Category Name=\"Root\" NameSpace=\"Standard\">";
  text.insert(text.find(root) + root.size(), "<pFeature>ThermalControl</pFeature>");
  return text.insert(text.rfind("</RegisterDescription>"), features);
}

/// Aravis' fake GigE Vision camera: a program that listens on an interface of the calling thread's
/// network. Each network has one.
class FakeGigeCamera {
 public:
  static constexpr const char* kAddress = "127.0.0.1";
  static constexpr const char* kSerial = "FAKE7";

  struct Options {
    double lost_per_thousand = 0;  ///< lost packets per thousand
    std::string interface = "lo";
    std::string address = kAddress;       ///< address of that interface
    bool is_thermal = false;              ///< has the features of thermal_description()
    std::vector<std::string> lacks = {};  ///< names of features that it does not have
  };

  explicit FakeGigeCamera(Options options) : options_(std::move(options)) { start(); }

  void kill() { program_.reset(); }

  void start() {
    std::vector<std::string> arguments{
        "/usr/bin/arv-fake-gv-camera-0.8",         "-i", options_.interface, "-s", kSerial, "-r",
        std::to_string(options_.lost_per_thousand)};
    if (options_.is_thermal || !options_.lacks.empty()) {
      const auto file = folder_ / "features.xml";
      std::ofstream(file) << description();
      arguments.insert(arguments.end(), {"-g", file.string()});
    }
    program_.emplace(arguments, folder_ / "fake.log");
    ASSERT_TRUE(
        comes_true([this] { return hal::read_gige_identity(options_.address).has_value(); }));
  }

  /// Starts it again after its interface was given another address.
  void move_to(const std::string& address) {
    kill();
    options_.address = address;
    start();
  }

 private:
  std::string description() const {
    std::string text = options_.is_thermal ? thermal_description() : standard_description();
    for (const std::string& feature : options_.lacks) {
      const std::string name = "Name=\"" + feature + "\"";
      text.replace(text.find(name), name.size(), "Name=\"No" + feature + "\"");
    }
    return text;
  }

  TemporaryFolder folder_;
  Options options_;
  std::optional<Subprocess> program_;
};

/// Samples of the fake camera's frame `id` of 16 bits, computed like its source does for its
/// factory settings (arvfakecamera.c, arv_fake_camera_diagonal_ramp).
inline std::uint16_t fake_sample_16(std::uint64_t id, int x, int y) {
  return static_cast<std::uint16_t>(
      (256 * static_cast<std::uint64_t>(x) + 256 * id + 256 * static_cast<std::uint64_t>(y)) %
      65535);
}
inline std::uint8_t fake_sample_8(std::uint64_t id, int x, int y) {
  return static_cast<std::uint8_t>(
      (static_cast<std::uint64_t>(x) + id + static_cast<std::uint64_t>(y)) % 255);
}

/// Receives a camera's frames and faults, and keeps the part of each frame that a test needs. Its
/// end stops the camera, which outlives it.
template <class Kept>
class Receiver {
 public:
  using Keep = std::function<Kept(const hal::FrameBuffer&)>;

  explicit Receiver(Keep keep) : keep_(std::move(keep)) {}
  Receiver(const Receiver&) = delete;
  Receiver& operator=(const Receiver&) = delete;
  ~Receiver() {
    if (camera_ != nullptr) camera_->stop();
  }

  void start(hal::Camera& camera) {
    camera_ = &camera;
    const auto started =
        camera.start([this](const hal::Frame& frame) { add(kept_, keep_(*frame)); },
                     [this](const hal::FaultReport& fault) { add(faults_, fault); });
    ASSERT_TRUE(started) << started.error().message;
  }

  std::vector<Kept> wait_for(std::size_t count) {
    return wait(kept_, [count](const auto& list) { return list.size() >= count; });
  }
  std::vector<hal::FaultReport> wait_for_faults(std::size_t count) {
    return wait(faults_, [count](const auto& list) { return list.size() >= count; });
  }
  /// Waits until the camera delivers again after one or more faults beyond the first `seen`
  /// reports; returns all reports.
  std::vector<hal::FaultReport> wait_for_return(std::size_t seen) {
    return wait(faults_, [seen](const auto& list) {
      return list.size() > seen + 1 && list.back().fault == hal::Fault::None;
    });
  }
  std::size_t count() const {
    const std::lock_guard lock(mutex_);
    return kept_.size();
  }

 private:
  template <class T>
  void add(std::vector<T>& list, T value) {
    {
      const std::lock_guard lock(mutex_);
      list.push_back(std::move(value));
    }
    changed_.notify_all();
  }
  template <class T, class Condition>
  std::vector<T> wait(const std::vector<T>& list, const Condition& condition) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, std::chrono::minutes(1), [&] { return condition(list); }))
        << "there are " << list.size();
    return list;
  }

  const Keep keep_;
  hal::Camera* camera_ = nullptr;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Kept> kept_;
  std::vector<hal::FaultReport> faults_;
};

}  // namespace orbwatch::tests

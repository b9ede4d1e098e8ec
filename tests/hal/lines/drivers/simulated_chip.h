// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <string>
#include <vector>

#include "hal/lines/gpio/gpio_lines.h"
#include "tests/support/comes_true.h"

namespace orbwatch::hal {

/// External side of the wires of the kernel's simulated chip, which the scenario made. It has 8
/// lines and the label "orbwatch"; lines 2 and 3 are named TRIGGER_IN and TRIGGER_OUT.
class SimulatedChip : public testing::Test {
 protected:
  static constexpr unsigned kInput = 2, kOutput = 3, kUnnamed = 5;

  void SetUp() override {
    for (const unsigned line : {kInput, kOutput, kUnnamed}) pull(line, false);
  }

  /// Folder of the chip in configfs.
  static std::string config() {
    const char* value = std::getenv("GPIO_SIM_CONFIG");
    EXPECT_TRUE(value) << "GPIO_SIM_CONFIG must be set, as tests/hil does";
    return value ? value : "";
  }
  static std::string first_word(const std::string& file) {
    std::string word;
    std::ifstream(file) >> word;
    return word;
  }
  /// Path of a file of the chip; device and chip have new numbers each time the chip is made.
  static std::string file_of(unsigned line, const std::string& name) {
    return "/sys/devices/platform/" + first_word(config() + "/dev_name") + "/" +
           first_word(config() + "/bank/chip_name") + "/sim_gpio" + std::to_string(line) + "/" +
           name;
  }
  /// Drives the wire like another device: an edge, if the line is an input and the level differs.
  static void pull(unsigned line, bool up) {
    std::ofstream file(file_of(line, "pull"));
    file << (up ? "pull-up" : "pull-down") << std::flush;
    ASSERT_TRUE(file.good()) << file_of(line, "pull");
  }
  static bool level(unsigned line) {
    int value = -1;
    std::ifstream(file_of(line, "value")) >> value;
    EXPECT_NE(value, -1) << file_of(line, "value");
    return value == 1;
  }
  static void set_live(bool live) {
    std::ofstream file(config() + "/live");
    file << (live ? 1 : 0) << std::flush;
    ASSERT_TRUE(file.good());
  }

  GpioLines lines;
};

using tests::comes_true;

/// Events received on the line thread.
template <class T>
class Heard {
 public:
  void add(T item) {
    const std::lock_guard lock(mutex_);
    items_.push_back(item);
    changed_.notify_all();
  }
  std::vector<T> items() const {
    const std::lock_guard lock(mutex_);
    return items_;
  }
  bool wait_for(std::size_t count) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::seconds(60),
                             [&] { return items_.size() >= count; });
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<T> items_;
};

}  // namespace orbwatch::hal

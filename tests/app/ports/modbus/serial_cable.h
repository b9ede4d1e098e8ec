// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

#include "hal/thread/file_descriptor.h"
#include "tests/app/ports/modbus/clients.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::tests {

/// Two serial ports and the cable between them, by pseudo-terminals. Each end has a path that stays
/// the same when the cable is plugged in again, like in /dev/serial/by-id. They have no parity.
class SerialCable {
 public:
  SerialCable();
  ~SerialCable();
  SerialCable(const SerialCable&) = delete;
  SerialCable& operator=(const SerialCable&) = delete;

  std::string device() const { return folder_ / "device"; }
  std::string master() const { return folder_ / "master"; }

  /// Removes both ends: an open one hangs up, and opening fails.
  void unplug();
  void plug_in();

 private:
  void carry();
  void stop_carrying();

  orbwatch::tests::TemporaryFolder folder_;
  std::array<hal::FileDescriptor, 2> ports_;  ///< the terminals' other sides
  std::array<hal::FileDescriptor, 2> ends_;   ///< keeps the terminals alive without users
  hal::FileDescriptor stop_;
  std::thread carrier_;
};

/// A master that sends any bytes over a serial line, valid or not.
class RawMaster {
 public:
  explicit RawMaster(const std::string& path);

  /// Sends bytes; waits while the line is full.
  void send(const Bytes& bytes);
  /// Receives `count` bytes, or fewer if one does not arrive within `longest`.
  Bytes receive(std::size_t count, std::chrono::milliseconds longest = std::chrono::minutes(1));

 private:
  hal::FileDescriptor port_;
};

}  // namespace orbwatch::app::tests

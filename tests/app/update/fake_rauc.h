// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemd/sd-bus.h>

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "hal/thread/file_descriptor.h"

namespace orbwatch::app::update::tests {

/// System bus with RAUC's service alone, as far as Installer uses them. A bundle is a text file:
/// "bundle KIND VERSION", "foreign" for one of another key; other ones are not bundles. An
/// installation reports 40 % and then waits for finish(). Thread-safe.
class FakeRauc {
 public:
  /// The bus is the socket `bus` of the folder, the device of kind `compatible`.
  explicit FakeRauc(const std::filesystem::path& folder, std::string compatible = "orbwatch-amd64");
  FakeRauc(const FakeRauc&) = delete;
  FakeRauc& operator=(const FakeRauc&) = delete;
  ~FakeRauc();

  /// For DBUS_SYSTEM_BUS_ADDRESS.
  std::string address() const;

  /// Ends the present installation, or the next one. Empty: it succeeds.
  void finish(const std::string& error = "");

  /// Bundles whose installation was asked for.
  std::vector<std::filesystem::path> installed() const;

 private:
  struct Close {
    void operator()(sd_bus* bus) const { sd_bus_flush_close_unref(bus); }
  };
  using Bus = std::unique_ptr<sd_bus, Close>;

  void run();
  Bus accept() const;
  void serve(sd_bus* bus);
  void end_installation(sd_bus* bus);
  static int on_message(sd_bus_message* message, void* rauc, sd_bus_error* error);
  int answer(sd_bus_message* call);
  int answer_info(sd_bus_message* call);
  int answer_install(sd_bus_message* call);
  int answer_property(sd_bus_message* call);
  void signal_progress(sd_bus* bus);

  const std::filesystem::path socket_;
  const std::string compatible_;
  hal::FileDescriptor listener_;
  hal::EventFd woken_;
  mutable std::mutex mutex_;  ///< of what follows
  bool is_ended_ = false, is_installing_ = false;
  int percent_ = 0;
  std::string last_error_;
  std::optional<std::string> result_;
  std::vector<std::filesystem::path> installed_;
  std::thread thread_;
};

}  // namespace orbwatch::app::update::tests

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "proc/image/result.h"

struct sd_bus;

namespace orbwatch::app::update {

/// Label of a bundle whose signature is right.
struct BundleLabel {
  std::string version;
  std::string compatible;
};

/// Client of RAUC's service on the system bus. Thread-bound apart from
/// cancel(); each call waits for the service.
class Installer {
 public:
  /// Error: no system bus.
  static Result<Installer> connect();

  /// Ends a call under way, and later ones, with an error; RAUC completes an installation by
  /// itself. On any thread, as long as this object exists.
  void cancel();

  /// Kind of this device, from RAUC's configuration. Error: RAUC's service does not start.
  Result<std::string> compatible();

  /// Checks the signature and returns the label. Error: RAUC's message.
  Result<BundleLabel> inspect(const std::filesystem::path& bundle);

  /// Writes the bundle into the other slot, which the next start tries once. `on_progress` is
  /// called with percent and step. Error: RAUC's message; the running slot stays as it is.
  Result<> install(const std::filesystem::path& bundle,
                   const std::function<void(int percent, const std::string& step)>& on_progress);

 private:
  struct Close {
    void operator()(sd_bus* bus) const;
  };
  using Bus = std::unique_ptr<sd_bus, Close>;

  explicit Installer(Bus bus) : bus_(std::move(bus)) {}
  Result<std::string> text_property(const char* name);

  Bus bus_;
};

}  // namespace orbwatch::app::update

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "app/ports/web/api/json_form.h"
#include "hal/clock.h"

namespace orbwatch::app::web {

/// Events of alarms of processes before, in the form in which they are sent: recipes and names may
/// be others now. Thread rule: write() on one thread at a time, the rest on any.
class KeptEvents {
 public:
  /// Not more often, because each time the whole file is written.
  static constexpr std::chrono::seconds kPeriod{30};

  /// Reads `file`; logs why it cannot be read. Empty: nothing is kept.
  explicit KeptEvents(std::filesystem::path file);

  const std::vector<Json>& before() const { return before_; }
  /// Number of the newest one; 0: there is none.
  std::uint64_t newest_number() const { return newest_number_; }

  /// Replaces the file by all events, those before included; logs an error.
  void write(const std::vector<Json>& events) const;

 private:
  const std::filesystem::path file_;
  std::vector<Json> before_;
  std::uint64_t newest_number_ = 0;
};

}  // namespace orbwatch::app::web

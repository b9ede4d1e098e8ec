// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string_view>
#include <type_traits>
#include <vector>

#include "app/model/sink/interface_metric.h"
#include "app/model/sink/sink.h"
#include "app/model/status/field.h"
#include "app/model/status/status_report.h"
#include "app/ports/console/console_settings.h"
#include "app/ports/console/waitless_output.h"
#include "hal/thread/priority_mutex.h"
#include "hal/thread/thread.h"

namespace orbwatch::app {

#define ORBWATCH_CONSOLE_FIGURES(FIELD) \
  FIELD(std::uint64_t, dropped, kCount, "Prints dropped because standard output was not read")

/// Counters of a console.
struct ConsoleCounts {
  ORBWATCH_CONSOLE_FIGURES(ORBWATCH_FIELD_MEMBER)
};

template <class Visit>
constexpr void for_each_field(std::type_identity<ConsoleCounts>, Visit&& visit) {
  using Part = ConsoleCounts;
  ORBWATCH_CONSOLE_FIGURES(ORBWATCH_VISIT_FIELD)
}

/// Prints every component of the status with its values, once a period and when it stops. A print
/// is dropped if the reader of standard output does not keep up: neither the sink nor stop() waits
/// for it.
class ConsoleSink final : public Sink {
 public:
  /// `file` is open for writing and outlives the sink.
  ConsoleSink(ConsoleSettings settings, StatusNames names, int file);
  ~ConsoleSink() override;

  Result<> start() override;
  void stop() override;
  std::chrono::nanoseconds cpu_time() const override { return thread_.cpu_time(); }
  std::vector<InterfaceMetric> metrics() const override;
  void accept(const ViewPtr&) override {}
  void accept(const Status& status) override;

 private:
  void print(std::string_view heading, hal::TimePoint now);

  ConsoleSettings settings_;
  StatusNames names_;
  WaitlessOutput out_;  ///< used by the thread while it runs, else by the owner
  std::atomic<std::uint64_t> dropped_{0};
  hal::TimePoint started_;
  hal::PriorityMutex mutex_;
  Status status_;
  hal::Thread thread_;
};

}  // namespace orbwatch::app

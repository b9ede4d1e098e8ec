// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "app/daemon/process/attempts.h"
#include "app/daemon/site/site_plan.h"
#include "app/files/resolve.h"
#include "app/model/command/command_path.h"
#include "app/model/configuration/program.h"
#include "app/model/machine/machine_state.h"
#include "app/model/sink/sink.h"
#include "hal/thread/shared_threads.h"

namespace orbwatch::app {
class AlignmentSource;
}

namespace orbwatch::app::daemon {

/// Clients that may command this appliance, in one line. Reentrant.
std::string commanders_text(const files::SinkSettings& sinks);

/// Names of the interfaces by bit of Interfaces::faults().
inline constexpr auto kInterfaceNames = []<class... Settings>(const std::tuple<Settings...>*) {
  return std::array{Settings::kName...};
}(static_cast<const files::SinkSettings*>(nullptr));

/// The interfaces of a site to the outside, each started by itself: one that cannot be opened is
/// tried again while the others work. Thread rule: one owner, apart from faults().
class Interfaces {
 public:
  /// Makes the enabled ones. `commands` go to the appliance, states of the machine to `machine`;
  /// `background` encodes; `alignment` is the caller's and outlives this; null: none.
  Interfaces(const files::Resolved& site, const SitePlan& plan, CommandPath commands,
             MachinePath machine, std::shared_ptr<hal::SharedThreads> background,
             AlignmentSource* alignment = nullptr, Program program = {});

  /// The interface of this type; null: it is not enabled.
  template <class Wanted>
  Wanted* find() const {
    for (const auto& sink : all_) {
      if (auto* const found = dynamic_cast<Wanted*>(sink.get())) return found;
    }
    return nullptr;
  }

  /// Starts them, with those that cannot be opened among the `attempts`.
  void start(Attempts& attempts, hal::TimePoint now);
  void stop();

  /// Sinks of the pipeline.
  std::vector<Sink*> sinks() const;

  /// Their own tables and counts. On any thread, once this is made.
  std::vector<InterfaceTable> tables() const;
  std::vector<InterfaceMetric> metrics() const;

  /// As the figure interface_faults of SystemStatus. On any thread.
  std::uint32_t faults() const;

 private:
  /// Sinks in the order of the bits of faults(); null: not enabled.
  std::array<std::unique_ptr<Sink>, kInterfaceNames.size()> all_;
  std::atomic<std::uint32_t> started_{0};  ///< bit n: all_[n]
};

}  // namespace orbwatch::app::daemon
